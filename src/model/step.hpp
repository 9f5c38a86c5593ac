// A step of the analysis: its procedure and everything that acts during it, fully resolved (OP=MOD and OP=NEW are the
// reader's business): each step lists all boundary conditions and loads that hold in it, also those propagated from before.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "model/element_ref.hpp"
#include "model/interaction.hpp"

namespace balocco {

/// Degrees of freedom count from 0: 0-2 translations, 3-5 rotations, in the node's *TRANSFORM directions where it has any.
struct BoundaryCondition {
  enum class Kind { displacement, velocity, acceleration } kind = Kind::displacement;
  std::int32_t node = -1;
  std::int32_t dof = 0;
  double magnitude = 0.0;
  std::int32_t amplitude = -1;  // row of Model::amplitudes; -1: the procedure's default (static: ramp, explicit: at once)
  bool propagated = false;      // said in an earlier step: a displacement stays at the value it has reached
  bool fixed = false;           // *BOUNDARY, FIXED: hold where the node is when the step starts
  std::int32_t file = -1, line = 0;
};

/// A concentrated force (dof 0-2) or moment (dof 3-5).
struct ConcentratedLoad {
  std::int32_t node = -1;
  std::int32_t dof = 0;
  double magnitude = 0.0;
  double previous = 0.0;        // magnitude reached at the end of the previous step: where a static ramp starts
  bool follower = false;        // *CLOAD, FOLLOWER: it turns with the node
  bool imaginary = false;       // of harmonic loads the imaginary part: a quarter of a cycle ahead of the real one
  std::int32_t amplitude = -1;
  std::int32_t file = -1, line = 0;
};

/// *CONNECTOR MOTION: the relative motion of a row of a guide (model/constraint.hpp).
struct ConnectorMotion {
  std::int32_t guide = -1;   // row of Model::constraints
  int row = 0;               // of it
  BoundaryCondition course;  // its node and dof say nothing
};

/// *CONNECTOR LOAD: a force (or moment) along a component, which turns with the connector; positive where it drives the motion on.
struct ConnectorLoad {
  std::int32_t guide = -1;
  int row = 0;
  double magnitude = 0.0;
  double previous = 0.0;
  std::int32_t amplitude = -1;
  std::int32_t file = -1, line = 0;
};

/// A load spread over the faces of a surface, by area, or over its edges, by length.
struct SurfaceLoad {
  enum class Kind {
    pressure,         // against the normal
    traction,         // along `direction`
    shear,            // along `direction` without its part along the normal of the reference
    edge_traction,    // along `direction`
    edge_normal,      // in the sheet, into it
    edge_shear,       // along the edge, from corner to corner as the element has them
    edge_transverse   // against the sheet's normal
  } kind = Kind::pressure;
  std::int32_t surface = -1;    // row of Model::surfaces
  std::array<double, 3> direction{};  // unit
  bool follows = true;         // `direction` turns with the surface
  bool of_reference = false;   // by the area or length of the reference, not by those of now
  bool imaginary = false;      // as of ConcentratedLoad
  double magnitude = 0.0;
  double previous = 0.0;
  std::int32_t amplitude = -1;
  std::int32_t file = -1, line = 0;
};

constexpr bool acts_on_edges(SurfaceLoad::Kind kind) { return kind >= SurfaceLoad::Kind::edge_traction; }

/// Whether two loads differ in magnitude alone.
inline bool acts_alike(const SurfaceLoad& a, const SurfaceLoad& b) {
  return a.kind == b.kind && a.surface == b.surface && a.direction == b.direction && a.follows == b.follows && a.of_reference == b.of_reference &&
         a.imaginary == b.imaginary;
}

/// A force on all matter of an element set (-1: the whole model).
struct BodyLoad {
  enum class Kind {
    gravity,      // acceleration `magnitude` along `direction`
    centrifugal,  // of a model that turns with an angular velocity of square `magnitude` about an axis
    volume_force  // force `magnitude` by reference volume along `direction`
  } kind = Kind::gravity;
  std::int32_t element_set = -1;
  double magnitude = 0.0;
  double previous = 0.0;
  std::array<double, 3> direction{};  // unit; centrifugal: of the axis
  std::array<double, 3> point{};      // centrifugal: on the axis
  bool imaginary = false;             // as of ConcentratedLoad
  std::int32_t amplitude = -1;
  std::int32_t file = -1, line = 0;
};

/// *TEMPERATURE of a node. Nodes that a step has none for are at their initial temperature (Model::initial_temperature).
struct NodalTemperature {
  std::int32_t node = -1;
  double magnitude = 0.0;
  double previous = 0.0;  // reached at the end of the previous step: where a static ramp starts
  std::int32_t amplitude = -1;
  std::int32_t file = -1, line = 0;
};

/// Nodes fixed to a rigid body, or released from it, where they stand when the step starts.
struct RigidAttachment {
  std::int32_t rigid_body = -1;  // row of Model::rigid_bodies
  std::vector<std::int32_t> nodes;
  bool tie = true;               // false: pin
  bool release = false;
};

/// *OUTPUT, FIELD: when a frame is written and what it holds. Exactly one of the four marks is set. Requests of one *OUTPUT
/// for different sets are entries of their own, with the same marks.
struct FieldOutput {
  std::optional<std::int32_t> frequency;        // every n increments
  std::optional<std::int32_t> number_interval;  // n equal intervals of the step
  std::optional<double> time_interval;
  std::vector<double> time_points;
  std::vector<std::string> node_variables;      // U, V, A, RF, ...
  std::vector<std::string> element_variables;   // S, LE, MISES, ...
  std::vector<std::string> integration_point_variables;  // written as <VAR>_IP
  std::vector<std::string> contact_variables;   // CPRESS, CSHEAR, COPEN, CSLIP
  bool single_precision = true;
  std::int32_t node_set = -1;     // rows of Model::node_sets and element_sets that the nodal variables and the element variables
  std::int32_t element_set = -1;  // are written for, not a number elsewhere; -1: the whole model
};

/// *OUTPUT, HISTORY: when a row of history is written and of what.
struct HistoryOutput {
  struct Nodes {
    std::int32_t set = -1;
    std::vector<std::string> variables;  // U1, V3, RF2, UR2, VR2, AR2 ... or whole vectors U, V, A, RF, UR, VR, AR
  };
  struct Elements {
    std::int32_t set = -1;
    std::vector<std::string> variables;
  };
  std::optional<std::int32_t> frequency;
  std::optional<double> time_interval;
  std::vector<Nodes> nodes;
  std::vector<Elements> elements;
  std::vector<std::string> energies;         // ALLKE ... ETOTAL; empty: none
  std::vector<std::int32_t> contact_pairs;   // rows: resultant force CFN, CFT, CAREA, centre of pressure XN
};

/// *NODE PRINT, *EL PRINT, *SECTION PRINT: tables in JOB.dat, each of one set and one variable.
struct PrintOutput {
  enum class Kind { nodes, elements, section, contact } kind = Kind::nodes;
  enum class Totals { none, also, only };  // sums over the set: not printed, behind the table, in its place
  std::int32_t set = -1;        // row of Model::node_sets (also of contact), element_sets or surfaces
  std::string set_name;         // as the deck says it
  std::string section_name;     // *SECTION PRINT, NAME=
  std::vector<std::string> variables;
  Totals totals = Totals::none;
  bool global_directions = true;  // of nodes; false: those of *TRANSFORM
  std::int32_t frequency = 1;     // every n increments, and the last of a step
  std::vector<double> time_points;  // of the step, in place of `frequency`, and the end of it
};

/// Convergence controls of *CONTROLS (Abaqus's meanings and defaults).
struct ImplicitControls {
  double residual_tolerance = 5e-3;    // largest residual / average force
  double correction_tolerance = 1e-2;  // largest correction / largest increment of displacement
  std::int32_t maximum_iterations = 16;
  bool line_search = false;
};

// A procedure is one struct of its settings here, one solver that registers itself (solvers/procedures.hpp) and one deck
// keyword. What others ask of every procedure are its constants: they reach them through Step.

/// How the procedures that solve equations advance in time, and what they make of displacements.
struct ImplicitIncrements {
  double initial_increment = 1.0, duration = 1.0, minimum_increment = 1e-5, maximum_increment = 1.0;
  bool direct = false;  // fixed increments
  bool nonlinear_geometry = false;
  std::int32_t maximum_increments = 100;
  ImplicitControls controls;
};

struct StaticProcedure : ImplicitIncrements {
  static constexpr std::string_view name = "static";
  static constexpr bool ramps_loads = true;     // loads without an amplitude grow linearly over the step
  static constexpr bool needs_mass = false;
  static constexpr bool has_few_increments = true;  // each is told, and written where a deck does not say when
  static constexpr bool is_perturbation = false;    // about the state, which it leaves as it is
  static constexpr bool is_dynamic = false;         // velocities go on from step to step
  static constexpr bool seeks_modes = false;        // and tells nothing else
  static constexpr bool is_harmonic = false;        // tells complex responses at frequencies, not states at times

  bool stabilize = false;
  double dissipated_energy_fraction = 2e-4;
};

/// The alpha method of Hilber, Hughes & Taylor (1977).
struct DynamicProcedure : ImplicitIncrements {
  static constexpr std::string_view name = "implicit dynamics";
  static constexpr bool ramps_loads = false;
  static constexpr bool needs_mass = true;
  static constexpr bool has_few_increments = true;
  static constexpr bool is_perturbation = false;
  static constexpr bool is_dynamic = true;
  static constexpr bool seeks_modes = false;
  static constexpr bool is_harmonic = false;

  double alpha = -0.05;  // -1/3 (most damping of the highest frequencies) to 0 (none)
  /// False (INITIAL=NO): the step starts with the accelerations of a dynamic step just before it, or none, whatever its loads are.
  bool finds_initial_accelerations = true;
};

/// *FIXED MASS SCALING, *VARIABLE MASS SCALING: how many times their mass the elements of a set have.
struct MassScaling {
  /// What their stable increments become: those below `increment` are raised to it, the smallest one becomes it by one factor for
  /// all, or each becomes it.
  enum class Target { none, below_minimum, uniform, equal } target = Target::none;
  double increment = 0.0;
  double factor = 1.0;              // fixed: of the mass that materials and sections give, before the target
  std::int32_t element_set = -1;    // row of Model::element_sets; -1: the whole model, but for what other definitions name
  // Variable: when; exactly one is set.
  std::optional<std::int32_t> frequency;        // at the start and every n increments
  std::optional<std::int32_t> number_interval;  // at the start and at the end of each of n equal intervals of the step
};

struct ExplicitProcedure {
  static constexpr std::string_view name = "explicit dynamics";
  static constexpr bool ramps_loads = false;
  static constexpr bool needs_mass = true;
  static constexpr bool has_few_increments = false;
  static constexpr bool is_perturbation = false;
  static constexpr bool is_dynamic = true;
  static constexpr bool seeks_modes = false;
  static constexpr bool is_harmonic = false;

  double duration = 0.0;
  std::optional<double> fixed_increment;  // *DYNAMIC, EXPLICIT, DIRECT USER CONTROL
  double scale_factor = 1.0;
  double linear_bulk_viscosity = 0.06, quadratic_bulk_viscosity = 1.2;
  double energy_error_limit = 0.1;  // of the largest energy of the step: beyond it the run ends
  std::vector<MassScaling> fixed_mass_scaling;     // at the start of the step, of original masses; none: masses stay as they are
  std::vector<MassScaling> variable_mass_scaling;  // during the step, also those that go on from steps before
};

/// Response of first order to loads and motions beside those of the state, with the stiffness that it has there. Loads of the step are
/// those of the state (`previous`) and the perturbation together; prescribed motions are the perturbation alone.
struct StaticPerturbationProcedure {
  static constexpr std::string_view name = "static perturbation";
  static constexpr bool ramps_loads = false;
  static constexpr bool needs_mass = false;
  static constexpr bool has_few_increments = true;
  static constexpr bool is_perturbation = true;
  static constexpr bool is_dynamic = false;
  static constexpr bool seeks_modes = false;
  static constexpr bool is_harmonic = false;

  double duration = 1.0;
};

/// Natural frequencies and modes of the structure as it is loaded. At least one of `number` and `upper` is set.
struct FrequencyProcedure {
  static constexpr std::string_view name = "frequency";
  static constexpr bool ramps_loads = true;
  static constexpr bool needs_mass = true;
  static constexpr bool has_few_increments = true;
  static constexpr bool is_perturbation = true;
  static constexpr bool is_dynamic = false;
  static constexpr bool seeks_modes = true;
  static constexpr bool is_harmonic = false;
  static constexpr double duration = 0.0;

  enum class Normalization { displacement, mass };  // of modes: largest displacement 1, or generalised mass 1
  std::optional<std::int32_t> number;
  std::optional<double> lower, upper;  // frequencies, cycles per time
  double shift = 0.0;                  // cycles per time, squared: modes are looked for around it
  Normalization normalization = Normalization::displacement;
};

/// Load factors at which the structure, as it is loaded, has a second equilibrium beside: K + factor * (what the step's loads add to K).
struct BuckleProcedure {
  static constexpr std::string_view name = "buckle";
  static constexpr bool ramps_loads = false;
  static constexpr bool needs_mass = false;
  static constexpr bool has_few_increments = true;
  static constexpr bool is_perturbation = true;
  static constexpr bool is_dynamic = false;
  static constexpr bool seeks_modes = true;
  static constexpr bool is_harmonic = false;
  static constexpr double duration = 0.0;

  std::int32_t number = 1;
};

/// *MODAL DAMPING of modes first <= number <= last: a fraction of critical damping, Rayleigh's alpha and beta, and the structural damping
/// factor, by which the modal stiffness has an imaginary part (harmonic responses alone).
struct ModalDamping {
  std::int32_t first = 1, last = 1;
  double fraction = 0.0, alpha = 0.0, beta = 0.0, structural = 0.0;
};

/// Response to the step's loads as a sum of the modes that the last frequency step found, from rest.
struct ModalDynamicProcedure {
  static constexpr std::string_view name = "modal dynamics";
  static constexpr bool ramps_loads = false;
  static constexpr bool needs_mass = true;
  static constexpr bool has_few_increments = true;
  static constexpr bool is_perturbation = true;
  static constexpr bool is_dynamic = false;
  static constexpr bool seeks_modes = false;
  static constexpr bool is_harmonic = false;

  double increment = 1.0, duration = 1.0;
  /// DIRECT=NO: increments grow from the first one as long as no load changes by more than this in one; none: all are alike.
  std::optional<double> largest_load_change;
  std::int32_t maximum_increments = 100;
  std::vector<ModalDamping> damping;
};

/// *BASE MOTION: all held freedoms move as one rigid body, along a global axis (dof 0-2) or about one through `centre` (3-5, radians), by
/// `scale` times the amplitude at the frequency (none: 1).
struct BaseMotion {
  int dof = 0;
  BoundaryCondition::Kind kind = BoundaryCondition::Kind::acceleration;  // of which quantity `scale` and the amplitude tell
  double scale = 1.0;
  std::array<double, 3> centre{};
  bool imaginary = false;
  std::int32_t amplitude = -1;
  std::int32_t file = -1, line = 0;
};

/// Complex response to harmonic loads, frequency by frequency, as a sum of the modes that the last frequency step found. Amplitudes of its
/// loads are functions of the frequency.
struct SteadyStateProcedure {
  static constexpr std::string_view name = "steady-state dynamics";
  static constexpr bool ramps_loads = false;
  static constexpr bool needs_mass = true;
  static constexpr bool has_few_increments = true;
  static constexpr bool is_perturbation = true;
  static constexpr bool is_dynamic = false;
  static constexpr bool seeks_modes = false;
  static constexpr bool is_harmonic = true;
  static constexpr double duration = 0.0;

  /// Where the frequencies of the ranges lie: between the ends of a range, or also between eigenfrequencies within it.
  enum class Interval { eigenfrequency, range } interval = Interval::eigenfrequency;
  bool logarithmic = true;
  struct Range {
    double lower = 0.0, upper = 0.0;  // cycles per time; equal: one frequency
    std::int32_t points = 20;         // of each interval, with its ends
    double bias = 3.0;                // 1: evenly spaced; more: towards the ends of the interval
    double scale = 1.0;               // of all frequencies but the ends of the range
  };
  std::vector<Range> ranges;  // rising
  std::vector<ModalDamping> damping;
  std::vector<BaseMotion> base_motions;
};

using Procedure = std::variant<StaticProcedure, ExplicitProcedure, FrequencyProcedure, DynamicProcedure, BuckleProcedure, ModalDynamicProcedure,
                               StaticPerturbationProcedure, SteadyStateProcedure>;

struct Step {
  std::string name;
  Procedure procedure;

  std::vector<BoundaryCondition> boundary;
  std::vector<ConcentratedLoad> concentrated_loads;
  std::vector<SurfaceLoad> surface_loads;
  std::vector<BodyLoad> body_loads;
  std::vector<NodalTemperature> temperatures;  // one a node
  std::vector<ConnectorMotion> connector_motions;
  std::vector<ConnectorLoad> connector_loads;
  std::vector<std::int32_t> active_contact_pairs;  // rows of Model::contact_pairs, after *MODEL CHANGE
  std::vector<ChangedInteraction> changed_interactions;  // of this step and of those before it
  std::vector<ElementRef> removed_elements;        // sorted: out of the model in this step, after *MODEL CHANGE
  std::vector<std::int32_t> removed_constraints;   // sorted rows of Model::constraints that hold no more, after *EQUATION, REMOVE
  std::vector<RigidAttachment> attachments;
  std::vector<FieldOutput> field_outputs;
  std::vector<HistoryOutput> history_outputs;
  std::vector<PrintOutput> print_outputs;
  std::optional<std::int32_t> checkpoint_frequency;       // *RESTART, WRITE, FREQUENCY (increments)
  std::optional<std::int32_t> checkpoint_number_interval;  // *RESTART, WRITE, NUMBER INTERVAL
  bool keeps_checkpoints = false;                          // without OVERLAY: all of them

  double duration() const { return std::visit([](const auto& kind) { return kind.duration; }, procedure); }
  std::string_view procedure_name() const { return std::visit([](const auto& kind) { return kind.name; }, procedure); }
  bool ramps_loads() const { return std::visit([](const auto& kind) { return kind.ramps_loads; }, procedure); }
  bool needs_mass() const { return std::visit([](const auto& kind) { return kind.needs_mass; }, procedure); }
  bool has_few_increments() const { return std::visit([](const auto& kind) { return kind.has_few_increments; }, procedure); }
  bool is_perturbation() const { return std::visit([](const auto& kind) { return kind.is_perturbation; }, procedure); }
  bool is_dynamic() const { return std::visit([](const auto& kind) { return kind.is_dynamic; }, procedure); }
  bool seeks_modes() const { return std::visit([](const auto& kind) { return kind.seeks_modes; }, procedure); }
  bool is_harmonic() const { return std::visit([](const auto& kind) { return kind.is_harmonic; }, procedure); }
  /// Null where the procedure solves no equations of motion or rest.
  const ImplicitIncrements* implicit_increments() const;
};

}  // namespace balocco
