// What is known of the step being read, beside the Step itself.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace balocco::deck {

struct StepDraft {
  Location location;
  bool has_procedure = false;
  // Said by *STEP and by keywords that may stand before the procedure's own; the procedure takes what is its own.
  bool nonlinear_geometry = false;
  bool asks_linear_geometry = false;  // NLGEOM=NO
  std::int32_t maximum_increments = 100;
  bool perturbation = false;
  ImplicitControls controls;  // go on from step to step, like NLGEOM
  std::optional<std::array<double, 2>> bulk_viscosity;  // linear, quadratic
  Location bulk_viscosity_location;
  std::optional<std::vector<MassScaling>> fixed_mass_scaling, variable_mass_scaling;
  Location mass_scaling_location;  // of the first of them
  std::string amplitude;  // *STEP, AMPLITUDE=
  std::int32_t changed_interaction = -1;  // row of Step::changed_interactions: what *FRICTION and *SURFACE BEHAVIOR speak of
  bool faulty = false;  // a block of it was refused: what that leaves missing is not told
  bool boundary_renewed = false, concentrated_renewed = false, distributed_renewed = false, temperature_renewed = false;  // OP=NEW seen
  std::unordered_map<std::int64_t, std::size_t> boundary_of;      // node * 6 + dof -> row of Step::boundary
  std::unordered_map<std::int64_t, std::size_t> concentrated_of;  // key_of() -> row of Step::concentrated_loads
  std::unordered_map<std::int32_t, std::size_t> temperature_of;   // node -> row of Step::temperatures
  static std::int64_t key_of(std::int32_t node, std::int32_t dof, bool follower, bool imaginary) {
    return std::int64_t{node} * 24 + dof + (follower ? 6 : 0) + (imaginary ? 12 : 0);
  }
  bool field_replaced = false, history_replaced = false;  // an *OUTPUT of this step took the place of earlier ones
  std::set<PrintOutput::Kind> prints_replaced;  // kinds of *... PRINT that took the place of those of earlier steps
  enum class Output { none, field, history } output = Output::none;  // what the latest *OUTPUT asked for
  std::size_t first_field = 0;  // row of Step::field_outputs that the latest *OUTPUT, FIELD began

  /// An error to be told if the step turns out to be of another kind.
  struct Note {
    Location location;
    std::string keyword, text;
  };
  std::vector<Note> harmonic, timed;  // of what harmonic steps alone have, and what they alone have not

  /// True if a load was said (again) in this step.
  template <class Load>
  bool said_here(const Load& load) const {
    return said.contains({load.file, load.line});
  }
  std::set<std::pair<std::int32_t, std::int32_t>> said;  // places of the data lines of loads read in this step
};

class Builder;
struct Block;

/// What every procedure's keyword does first. @return false, told, if the step has one already.
bool begin_procedure(Builder& builder, const Block& block);

}  // namespace balocco::deck
