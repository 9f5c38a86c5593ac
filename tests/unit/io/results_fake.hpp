// A model of bricks and membranes in a row, and an analysis of it whose every number follows from rows and time: what results
// and checkpoints have to bring back is known, on any number of ranks.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

#include "checkpoint.hpp"
#include "domain.hpp"
#include "elements/element_type.hpp"
#include "job_observer.hpp"
#include "model/results.hpp"
#include "local_places.hpp"

namespace balocco::fake {

/// Pads to 4 and carries a history of 2 (bricks) or 1 (membranes) doubles.
class Group : public ElementGroup {
 public:
  Group(const GroupInput& input, int history_size) : ElementGroup(input), history_size_(history_size) {}
  int history_size() const override { return history_size_; }
  void initialize_history(std::span<double> history) const override { std::fill(history.begin(), history.end(), 0.0); }
  void lumped_volume(std::int32_t, std::span<double> volume) const override { std::fill(volume.begin(), volume.end(), 1.0); }
  double density() const override { return 1.0; }
  StableIncrement add_forces(std::span<const PackRun>, const ExplicitCycle&, std::span<double>) const override { return {}; }
  bool linearize(std::int32_t, const NodalMotion&, std::span<const double>, std::span<double>, std::span<double>,
                 std::span<double>) const override {
    return true;
  }
  ElementEnergies energies(std::int32_t, const NodalMotion&, std::span<const double>) const override { return {}; }
  int point_components(std::string_view variable) const override {
    if (variable == "S") return 6;
    return variable == "STH" && history_size_ == 1 ? 1 : 0;
  }
  /// S: first history value + 10 x point + component.
  void point_output(std::string_view variable, std::int32_t, int point, const NodalMotion&, std::span<const double> history,
                    std::span<double> values) const override {
    for (std::size_t c = 0; c < values.size(); ++c) {
      values[c] = history[0] + (variable == "S" ? 10.0 * point + static_cast<double>(c) : 0.25);
    }
  }
  int integration_points() const override { return 2; }
  std::size_t bytes_per_element() const override { return 0; }

 private:
  int history_size_;
};

template <int history_size>
std::unique_ptr<ElementGroup> make(const GroupInput& input) {
  return std::make_unique<Group>(input, history_size);
}

const ElementType& brick();
const ElementType& membrane();

/// `cells` bricks in a row along x, each with a membrane on its lower side; one loose node; a rigid body whose reference node
/// stands apart; contact of the membranes with it; a static and an explicit step.
Model model(std::int32_t cells);

/// An "analysis" that moves nodes by a law. `advance` runs a step with fixed increments.
class Analysis : public ResultSource {
 public:
  Analysis(const Model& model, const Communicator& communicator);

  const State& state() const override { return current; }
  std::span<const std::unique_ptr<ElementGroup>> groups() const override { return element_groups; }
  int nodal_components(std::string_view variable) const override;
  void nodal(std::string_view variable, std::span<double> values) const override;
  void element(std::size_t group, std::string_view variable, std::int32_t element, int integration_point,
               std::span<double> values) const override;
  EnergyBalance energies() const override;
  ContactResultant contact(std::int32_t pair) const override;

  /// One increment: every number changes by a function of its row and of its own value.
  void increment(double time_increment);
  /// Runs steps from where the state stands. Stops silently after `last_increment` of the explicit step (a crash).
  /// @return false if the observer asked to stop.
  bool run(Observer& observer, std::int64_t last_increment = 1 << 30);

  const Model& model;
  const Communicator& communicator;
  Domain domain;
  std::vector<std::unique_ptr<ElementGroup>> element_groups;
  State current;
};

/// A fresh folder for a test, the same on every rank, and no other program's; and its removal with all others.
std::string folder(const std::string& name);
void remove_folders();

}  // namespace balocco::fake
