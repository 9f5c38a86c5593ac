#include "consistent_mass.hpp"

#include <algorithm>

#include "elements/element_type.hpp"
#include "elements/solids/nodal_shapes.hpp"
#include "loads/body_load.hpp"

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

bool loads_are_consistent(const Analysis& analysis) {
  const auto& steps = analysis.model.steps;
  const auto step = static_cast<std::size_t>(analysis.current.step);
  return step >= steps.size() || !std::holds_alternative<ExplicitProcedure>(steps[step].procedure);
}

void add_centrifugal_coupling(const Analysis& analysis, const BodyLoad& load, double magnitude, const double* position,
                              double* force) {
  const auto& model = analysis.model;
  for (const auto& group : analysis.element_groups) {
    ConsistentMass mass(model, *group);
    if (!mass.exists()) continue;
    const auto count = static_cast<std::size_t>(group->nodes_per_element());
    std::vector<Vector3<double>> acceleration(count);
    for (std::int32_t element = 0; element < group->size(); ++element) {
      if (!acts_on(model, load, {group->table(), group->row(element)})) continue;
      const auto nodes = group->nodes(element);
      for (std::size_t i = 0; i < count; ++i)
        acceleration[i] =
            body_force(load, magnitude, group->density(), position + 4 * static_cast<std::ptrdiff_t>(nodes[i]));
      const auto products = mass.products(element);
      for (std::size_t i = 0; i < count; ++i) {
        double* const sum = force + 4 * static_cast<std::ptrdiff_t>(nodes[i]);
        for (std::size_t j = 0; j < count; ++j) {
          const auto addend = products[count * i + j] * (acceleration[j] - acceleration[i]);
          for (int k = 0; k < 3; ++k) sum[k] += rounded(addend[k], sum[3]);
        }
      }
    }
  }
}

}  // namespace balocco
