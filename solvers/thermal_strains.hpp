// What temperatures make of elements, a function of the deck and the time: thermal strains (materials/expanding.hpp) and elastic constants
// (materials/elastic_by_temperature.hpp), which the solvers write into the history of the laws before they compute forces.
#pragma once

#include <span>
#include <vector>

#include "analysis.hpp"

namespace balocco {

/// Temperature of each local node at an instant of a step: as the step's *TEMPERATURE says, elsewhere the initial one.
void find_nodal_temperatures(const Analysis& analysis, const Step& step, double step_time, double total_time, std::span<double> temperature);

class ThermalStrains {
 public:
  explicit ThermalStrains(const Analysis& analysis);

  /// Whether they change with the temperatures of a step while its explicit increments go on: only amplitudes do that.
  bool move_in(const Step& step) const;
  /// Writes the thermal strains of that instant; of first order in a state that is (State::linear). Collective.
  /// @throws AnalysisError on all ranks where nothing would be left of an element.
  void set(Analysis& analysis, const Step& step, double step_time, double total_time);
  /// Of a state as it begins: constants of the initial temperatures, at which there are no thermal strains.
  void start(Analysis& analysis);
  /// What steps of first order left counts as finite from now on.
  void leave_first_order(Analysis& analysis) const;

 private:
  struct Group {
    std::size_t index = 0;
    const Material* material = nullptr;
    std::vector<int> rows;         // of thermal strains in the history, a point; none where the material does not expand
    std::vector<int> of_constants;  // of elastic constants, likewise
    std::vector<double> weights;   // of the nodes, point after point
  };
  /// Of a point, now and before the first step.
  struct Temperatures {
    double now = 0.0, initial = 0.0;
  };

  void write(Analysis& analysis, const Group& heated) const;
  Temperatures at_point(const Analysis& analysis, const Group& heated, std::int32_t lane, std::size_t point) const;
  void write_strain(Analysis& analysis, const Group& heated, std::int32_t lane, std::size_t point, Temperatures temperatures) const;

  bool acts_ = false;  // a material follows its temperature, and a step has temperatures, in the model of all ranks
  std::vector<Group> groups_;
  std::vector<double> temperature_;  // a local node
};

}  // namespace balocco
