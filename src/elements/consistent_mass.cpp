#include "elements/consistent_mass.hpp"

#include "elements/element_type.hpp"
#include "elements/solids/nodal_shapes.hpp"

namespace balocco {

namespace {

/// The C3D20R of CalculiX finds its mass, too, at the eight points of its stiffness; Abaqus's at 27.
struct ReducedMass : SerendipityShape<2> {
  static constexpr auto mass_stations() { return stations(); }
};

}  // namespace

ConsistentMass::ConsistentMass(const Model& model, const ElementGroup& group)
    : model_(model), group_(group), shape_products_(model.elements[group.table()].type->shape_products) {
  if (model.sections[group.section()].pointwise_dilatation)
    shape_products_ = group.nodes_per_element() == 8 ? shape_products<TrilinearValues> : shape_products<ReducedMass>;
  if (!exists()) return;
  const auto nodes = static_cast<std::size_t>(group.nodes_per_element());
  nodes_.resize(nodes);
  products_.resize(nodes * nodes);
  sums_.resize(nodes);
}

std::span<const double> ConsistentMass::products(std::int32_t element) {
  const auto& connectivity = model_.elements[group_.table()].connectivity;
  const std::size_t first = static_cast<std::size_t>(group_.row(element)) * nodes_.size();
  for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i] = model_.nodes.coordinates[connectivity[first + i]];
  shape_products_(nodes_, products_);
  return products_;
}

std::span<const double> ConsistentMass::row_sums(std::int32_t element) {
  products(element);
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    sums_[i] = 0.0;
    for (std::size_t j = 0; j < sums_.size(); ++j) sums_[i] += products_[sums_.size() * i + j];
  }
  return sums_;
}

}  // namespace balocco
