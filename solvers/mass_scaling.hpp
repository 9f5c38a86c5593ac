// *FIXED MASS SCALING and *VARIABLE MASS SCALING in an explicit step.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis.hpp"

namespace balocco {

/// Of the undeformed elements' increment: an element whose own one falls below is about to invert, and ends the run. It is not
/// scaled.
constexpr double collapsing = 1e-4;

/// Keeps State::mass_scale, which makes the masses and rotary inertias of deformable elements, and with them their stable
/// increments and bulk viscosity, but no load: gravity acts on the original mass. MASS and ROTARYI elements and what rigid bodies
/// carry stay as they are. What mass brings along when it is added to moving nodes counts as NodalWork::mass_scaling.
class MassScalingOfStep {
 public:
  /// When a step starts afresh: applies its fixed definitions to the original masses, then the variable ones, where the elements
  /// are now. Collective.
  MassScalingOfStep(Analysis& analysis, const Step& step);

  /// Whether variable definitions are due at the end of the increment that led to the state from `previous_time`; alike on all
  /// ranks.
  bool find_due(const State& state, double previous_time);
  /// Applies what is due to elements whose increments have been recorded. Collective. @return whether any masses changed.
  bool adapt(Analysis& analysis);

  /// As a step starts, when groups know what springs and contact add to elements (ElementGroup::set_added_bounds): reaches the targets
  /// with that too. Collective. @return whether any masses changed.
  bool allow_for_added_bounds(Analysis& analysis);

  bool exists() const { return exists_; }
  /// Mass added to all elements, as a part of the model's mass.
  double added_part() const { return added_part_; }
  /// Lines that tell what each definition added, and all of them. Collective.
  std::vector<std::string> report(const Analysis& analysis) const;

 private:
  using Definitions = std::vector<MassScaling>;
  /// Definition that governs each element of each group; -1: none.
  using Governing = std::vector<std::vector<std::int32_t>>;

  Governing governing(const Analysis& analysis, const Definitions& definitions) const;
  void scale(Analysis& analysis, const Definitions& definitions, const Governing& governing);
  void start(Analysis& analysis);
  void scale_afresh(Analysis& analysis);
  bool apply(Analysis& analysis, const std::vector<std::vector<double>>& before, bool moving);
  void sum_added_mass(const Analysis& analysis);

  const Step& step_;
  const ExplicitProcedure& procedure_;
  Governing fixed_, variable_;
  std::vector<bool> due_;                    // of the definitions at hand
  std::vector<double> smallest_;             // increments of what each of them governs
  std::vector<std::vector<double>> before_;  // mass scales before a change
  LumpedInertia inertia_before_;
  bool exists_ = false;
  double model_mass_ = 0.0, added_part_ = 0.0;
};

}  // namespace balocco
