// What the reader asks of the groups of handlers beside running them.
#pragma once

#include "deck/builder.hpp"

namespace balocco::deck {

/// Registers a keyword for every law of the material register (materials.cpp). Safe to call again.
void register_material_laws();

/// Fills in what steps ask for by default and checks output variables, once every step is read (output.cpp).
void finish_output(Builder& builder);

/// Face of an element type named S1..S6, SPOS or SNEG; negative if it has none such (surfaces.cpp).
int face_of_label(const ElementType& type, std::string_view label);

/// Edge E1 .. E4 of a sheet from 0 on, or -1.
int edge_of_label(const ElementType& type, std::string_view label);

/// To what wants nodes, a coupling say, a surface of edges is one of their nodes.
void settle_edges(const Model& model, Surface& surface);

}  // namespace balocco::deck
