#include "constraints/linear_equation.hpp"

#include <algorithm>

#include "constraints/nodal_directions.hpp"

namespace balocco {

EquationConstraint::EquationConstraint(const Model& model, const LinearEquation& equation) {
  rows_ = 1;
  const NodalDirections directions(model);
  for (const auto& [row, dof, coefficient] : equation.terms) {
    auto at = static_cast<std::size_t>(std::ranges::find(nodes_, row) - nodes_.begin());
    if (at == nodes_.size()) {
      nodes_.push_back(row);
      reference_.push_back(model.nodes.coordinates[row]);
      turns_.push_back(false);
      uses_.push_back({});
      gradient_.resize(6 * nodes_.size(), 0.0);
    }
    const auto direction = directions.direction(row, dof % 3);
    for (int c = 0; c < 3; ++c) gradient_[6 * at + (dof < 3 ? c : 3 + c)] += coefficient * direction[c];
    if (dof >= 3) turns_[at] = true;
    uses_[at][dof] = true;
  }
}

void EquationConstraint::gaps(std::span<const NodePlace> places, std::span<double> g) const {
  g[0] = 0.0;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    for (int c = 0; c < 3; ++c)
      g[0] += gradient_[6 * i + c] * (places[i].position[c] - reference_[i][c]) + gradient_[6 * i + 3 + c] * places[i].turn[c];
}

void EquationConstraint::gradient(std::span<const NodePlace>, std::span<double> dg) const {
  std::ranges::copy(gradient_, dg.begin());
}

}  // namespace balocco
