#include "constraints/constraint.hpp"

#include "constraints/alignment.hpp"
#include "constraints/distributing_coupling.hpp"
#include "constraints/greatest_distance.hpp"
#include "constraints/guide.hpp"
#include "constraints/joint.hpp"
#include "constraints/linear_equation.hpp"
#include "constraints/mean_rotation.hpp"
#include "constraints/tie.hpp"
#include "model/bounding_box.hpp"

namespace balocco {

namespace {

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
  std::unique_ptr<Constraint> operator()(const Alignment& kind) const { return std::make_unique<AlignmentConstraint>(model, kind); }
  std::unique_ptr<Constraint> operator()(const MeanRotation& kind) const {
    return std::make_unique<MeanRotationConstraint>(model, kind);
  }
  std::unique_ptr<Constraint> operator()(const GreatestDistance& kind) const {
    return std::make_unique<GreatestDistanceConstraint>(model, kind);
  }
  std::unique_ptr<Constraint> operator()(const Tie& kind) const { return std::make_unique<TieConstraint>(model, kind, model_size); }
  std::unique_ptr<Constraint> operator()(const Guide& kind) const { return std::make_unique<GuideConstraint>(model, kind, model_size); }
};

}  // namespace

std::vector<std::unique_ptr<Constraint>> make_constraints(const Model& model) {
  std::vector<std::unique_ptr<Constraint>> constraints;
  if (model.constraints.empty()) return constraints;
  const Make make{model, balocco::model_size(model)};
  for (const auto& definition : model.constraints) constraints.push_back(std::visit(make, definition.kind));
  return constraints;
}

}  // namespace balocco
