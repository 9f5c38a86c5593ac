// The seam between solvers and whoever writes results. Solvers know no file: they call an Observer, which asks the
// ResultSource for what it wants to write. Both are plain interfaces so that `io` and `solvers` never see each other.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "elements/element_group.hpp"
#include "model/model.hpp"
#include "model/state.hpp"

namespace balocco {

/// Energies of the whole model (all ranks), Abaqus's names. total = kinetic + internal + viscous + friction - work - mass_scaling
/// stays constant.
struct EnergyBalance {
  double kinetic = 0.0;     // ALLKE
  double internal = 0.0;    // ALLIE = strain + hourglass + plastic + contact (penalty springs)
  double strain = 0.0;      // ALLSE
  double plastic = 0.0;     // ALLPD
  double viscous = 0.0;     // ALLVD: bulk viscosity and Rayleigh damping
  double hourglass = 0.0;   // ALLAE
  double friction = 0.0;    // ALLFD
  double contact = 0.0;     // ALLCW: stored in contact springs
  double work = 0.0;        // ALLWK: external
  double mass_scaling = 0.0;  // ALLMW: kinetic energy of mass when it was added to what moves
  double total = 0.0;       // ETOTAL

  /// What an error of the balance is measured by: the energy that is, or has come, into the model.
  double magnitude() const { return std::max(std::abs(kinetic) + std::abs(internal) + viscous + friction, std::abs(work)); }
};

/// Resultant of one contact pair on the slave surface, global directions.
struct ContactResultant {
  Point normal_force{};      // CFN
  Point friction_force{};    // CFT
  Point moment{};            // CM, about the global origin
  double area = 0.0;         // CAREA: tributary area of the nodes in contact
  Point center{};            // XN: centre of pressure
  double greatest_penetration = 0.0;
};

/// A place of a pair with a deformable master that is closed. Two directions across the normal n: along the global x axis (z, where n is
/// along x), and n x that.
struct ContactPlace {
  std::int64_t row = -1;  // elements/slave_places.hpp
  double gap = 0.0, pressure = 0.0, energy = 0.0;
  std::array<double, 2> displacement{}, shear{};  // of the slave relative to the master since it closed, and the stress that holds it
};

class ResultSource;

/// A part of what is told: all of it, without a suffix, or the real or the imaginary part of a complex response.
struct ResultPart {
  std::string_view suffix;  // "", "_REAL", "_IMAG": behind the names of variables in results files
  const ResultSource* source = nullptr;
};

/// What a running analysis can be asked for. Functions marked collective must be called by every rank.
class ResultSource {
 public:
  virtual ~ResultSource() = default;
  /// What is written is that of the parts, one after the other; which variables there are is the same for all.
  virtual std::vector<ResultPart> parts() const { return {{"", this}}; }
  virtual const State& state() const = 0;
  virtual std::span<const std::unique_ptr<ElementGroup>> groups() const = 0;
  /// Components of a nodal variable: U V A RF (3), UR VR AR RM (3, only reference nodes of rigid bodies are not zero),
  /// CPRESS COPEN (1), CSHEAR CSLIP (1), CNORMF CSHEARF (3); 0 where unknown.
  virtual int nodal_components(std::string_view variable) const = 0;
  /// Values on the local nodes, `components` a node, the same bits on every copy.
  virtual void nodal(std::string_view variable, std::span<double> values) const = 0;
  /// Values of an output variable of an element of groups()[group], as ElementGroup::output; of small strain after linear steps.
  virtual void element(std::size_t group, std::string_view variable, std::int32_t element, int integration_point,
                       std::span<double> values) const = 0;
  /// Their mean over the integration points.
  virtual void element_mean(std::size_t group, std::string_view variable, std::int32_t element, std::span<double> values) const {
    mean_of_points(values, groups()[group]->integration_points(),
                   [&](int point, std::span<double> at_point) { this->element(group, variable, element, point, at_point); });
  }
  virtual EnergyBalance energies() const = 0;                               // collective
  virtual ContactResultant contact(std::int32_t pair) const = 0;            // collective
  /// Of the places that this rank owns; none where the master is rigid.
  virtual std::vector<ContactPlace> contact_places(std::int32_t) const { return {}; }
};

/// Where a procedure stands after an increment.
struct Progress {
  std::int64_t increment = 0;          // in the step
  double step_time = 0.0, total_time = 0.0;
  double time_increment = 0.0;
  std::int64_t critical_element = -1;  // id of the element that governs the increment (explicit), else -1
  int iterations = 0;                  // Newton iterations of the increment (implicit)
  double largest_residual = 0.0;       // at convergence (implicit)
  double largest_penetration = 0.0;    // of all active contact pairs (explicit)
  std::int64_t deleted_elements = 0;   // by *SHEAR FAILURE, since the analysis began (explicit)
  double added_mass = 0.0;             // by mass scaling, as a part of the mass of the model (explicit)
  double negligible_energy = 0.0;      // what rounding makes (explicit)
  double frequency = 0.0;              // cycles per time (harmonic)
  double largest_displacement = 0.0;   // greatest over a cycle of a component of U, of any node (harmonic)
  bool step_finished = false;
};

/// An explicit procedure calls its observer at least in increments that are multiples of this, and checks its energies then.
constexpr std::int64_t regular_increments = 100;

/// A natural mode that a frequency step found; shapes on the local nodes, the same bits on every copy.
struct Mode {
  std::int32_t number = 0;        // from 1
  double eigenvalue = 0.0;        // circular frequency squared; negative: the state is unstable
  double frequency = 0.0;         // cycles per time; 0 where the eigenvalue is negative
  double generalized_mass = 0.0;  // shape * mass * shape
  /// Of motions along and turns about the global axes: shape * mass * motion / generalised mass; that squared times it.
  std::array<double, 6> participation{}, effective_mass{};
  std::vector<double> displacement, rotation;  // 3 a node
  std::vector<double> slots;                   // of this rank's equations and held freedoms, forces of constraints among them
};

class Observer {
 public:
  virtual ~Observer() = default;
  /// Before the first increment of a step (also when restarted in its middle): the source is complete and at rest. Collective.
  virtual void step_started(const ResultSource& source, std::int32_t step) = 0;
  /// Called by every rank after every static increment, after an explicit increment once step_time >= next_due(), in
  /// every regular increment and at the end of the step. @return false to stop the run (a checkpoint has been written). Collective.
  virtual bool advanced(const ResultSource& source, const Progress& progress) = 0;
  /// Step time at which the observer next wants to be called; explicit increments are not shortened for it.
  virtual double next_due() const = 0;
  /// A frequency step found a mode. Collective.
  virtual void mode_found(const Mode& mode) = 0;
  /// A line for the log and the terminal: convergence, warnings. The root rank writes it.
  virtual void log(const std::string& line) = 0;
};

}  // namespace balocco
