// Revolves the section of a tyre into nodes, elements, sections, sets and surfaces of a model.
#pragma once

#include <string>
#include <vector>

#include "builders/tyre_section.hpp"
#include "builders/tyre_spec.hpp"
#include "model/model.hpp"

namespace balocco {

/// Where the parts of the tyre ended up in the model.
struct TyreMesh {
  std::vector<double>
      angles;  // of the sectors' first meridians, from the foot of the wheel forwards (towards +x), ascending
  std::int32_t nodes_per_meridian = 0;
  std::int32_t tread_surface = -1, liner_surface = -1;   // rows of Model::surfaces
  std::int32_t strike_surface = -1;                      // likewise; -1: the tyre cannot strike its rim
  std::int32_t membranes = -1, solids = -1, wires = -1;  // rows of Model::elements

  int sectors() const { return static_cast<int>(angles.size()); }
  /// Row of a section node on a meridian; the last sector closes on the first.
  std::int32_t node(int sector, int section_node) const {
    return (sector % sectors()) * nodes_per_meridian + section_node;
  }
};

/// Meridians: equal sectors in models 1 and 2, a refined arc in model 3.
std::vector<double> sector_angles(const TyreSpec& spec);

/// Adds the tyre to an empty model. Element sets CARCASS_*, CARCASS, BELT, TREAD_BASE, TREAD_CAP, TREAD_SOLID,
/// SIDEWALL_SOLID, APEX, RIM_STRIP, BEAD_SOLID, TURN_UP, BEAD_WIRE; node sets TYRE, BEAD_LEFT (y > 0), BEAD_RIGHT,
/// CROWN_TOP, SIDE_LEFT, SIDE_RIGHT; surfaces TREAD and LINER, and STRIKE where the inside may strike the rim.
TyreMesh add_tyre(const TyreSpec& spec, const TyreSection& section, Model& model);

/// Table of an element type that the model does not have yet. @return its row.
std::int32_t add_element_table(Model& model, const std::string& type_name);
/// Appends an element with the next free id. @return its row in the table.
std::int32_t add_element(Model& model, std::int32_t table, const std::vector<std::int32_t>& nodes,
                         std::int32_t section);
/// Appends a node with the next free id. @return its row.
std::int32_t add_node(Model& model, const Point& coordinates);
void add_node_set(Model& model, const std::string& name, std::vector<std::int32_t> nodes);
void add_element_set(Model& model, const std::string& name, std::vector<ElementRef> elements);

}  // namespace balocco
