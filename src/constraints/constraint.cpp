#include "constraints/constraint.hpp"

#include <algorithm>
#include <cmath>

#include "constraints/distributing_coupling.hpp"
#include "constraints/joint.hpp"
#include "constraints/linear_equation.hpp"
#include "constraints/tie.hpp"

namespace balocco {

namespace {

/// Diagonal of the box around all nodes.
double size_of(const Model& model) {
  if (model.nodes.size() == 0) return 1.0;
  Point low = model.nodes.coordinates.front(), high = low;
  for (const auto& point : model.nodes.coordinates)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], point[i]);
      high[i] = std::max(high[i], point[i]);
    }
  const double size = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  return size > 0.0 ? size : 1.0;
}

struct Make {
  const Model& model;
  double model_size;

  std::unique_ptr<Constraint> operator()(const LinearEquation& kind) const {
    return std::make_unique<EquationConstraint>(model, kind);
  }
  std::unique_ptr<Constraint> operator()(const Joint& kind) const {
    return std::make_unique<JointConstraint>(model, kind, model_size);
  }
  std::unique_ptr<Constraint> operator()(const DistributingCoupling& kind) const {
    return std::make_unique<DistributingConstraint>(model, kind);
  }
  std::unique_ptr<Constraint> operator()(const Tie& kind) const { return std::make_unique<TieConstraint>(model, kind, model_size); }
};

}  // namespace

std::vector<std::unique_ptr<Constraint>> make_constraints(const Model& model) {
  std::vector<std::unique_ptr<Constraint>> constraints;
  if (model.constraints.empty()) return constraints;
  const Make make{model, size_of(model)};
  for (const auto& definition : model.constraints) constraints.push_back(std::visit(make, definition.kind));
  return constraints;
}

}  // namespace balocco
