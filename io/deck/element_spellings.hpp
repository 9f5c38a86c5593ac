// Element types of Abaqus that are computed as others: hybrids and modified ones.
#pragma once

#include <string>

#include "deck/builder.hpp"

namespace balocco::deck {

/// The name of the type that computes elements of type `name`, told in a note where they differ; `name` itself for all
/// others.
std::string computed_as(Builder& builder, const Block& block, const std::string& name);

/// A hybrid whose displacement form locks where the material hardly changes its volume.
bool can_lock(const std::string& name);
/// Refuses such hybrids (Builder::locking_hybrids) with such a material.
void check_hybrids(Builder& builder);

}  // namespace balocco::deck
