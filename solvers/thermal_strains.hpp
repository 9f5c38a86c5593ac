// Thermal strains of elements: a function of the deck and the time, which the solvers write into the history of the laws that expand
// (materials/expanding.hpp) before they compute forces.
#pragma once

#include <optional>
#include <vector>

#include "analysis.hpp"

namespace balocco {

/// Temperature of each local node at an instant of a step: as the step's *TEMPERATURE says, elsewhere the initial one.
std::vector<double> nodal_temperatures(const Analysis& analysis, const Step& step, double step_time, double total_time);

class ThermalStrains {
 public:
  /// `analysis` has groups whose material expands.
  explicit ThermalStrains(const Analysis& analysis);

  /// Writes the thermal strains of that instant; of first order in a state that is (State::linear).
  void set(Analysis& analysis, const Step& step, double step_time, double total_time) const;
  /// What steps of first order left counts as finite from now on.
  void leave_first_order(Analysis& analysis) const;

 private:
  struct Group {
    std::size_t index = 0;
    const ThermalExpansion* expansion = nullptr;
    std::vector<int> rows;        // of the history, a point
    std::vector<double> weights;  // of the nodes, point after point
  };
  std::vector<Group> groups_;
};

/// None where nothing of this rank expands.
std::optional<ThermalStrains> thermal_strains(const Analysis& analysis);

/// True if temperatures of the step change while its explicit increments go on: only amplitudes do that.
bool temperatures_move(const Step& step);

}  // namespace balocco
