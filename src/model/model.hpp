// What a deck says, as plain data in deck order: no MPI, no PETSc, no HDF5, no deck syntax. Rows (0-based indices into the
// tables) are used everywhere; the ids of the deck live only in the tables. Units are whatever the deck uses, consistently.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "model/connector.hpp"
#include "model/constraint.hpp"
#include "model/element_ref.hpp"
#include "model/interaction.hpp"
#include "model/location.hpp"
#include "model/step.hpp"
#include "model/thermal_expansion.hpp"

namespace balocco {

struct ElementType;  // elements/element_type.hpp

using Point = std::array<double, 3>;

/// *INSTANCE of a part. The ids of its nodes and elements are those of the part plus an offset, so that all ids differ.
struct Instance {
  std::string name, part;
  std::int64_t node_offset = 0, element_offset = 0;
};

struct NodeTable {
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> instance;  // row of Model::instances, -1: of the assembly; empty in a deck without instances
  std::vector<Point> coordinates;
  std::vector<Location> location;
  std::vector<double> thickness;  // *NODAL THICKNESS of shells, a value a node; empty: none given
  std::unordered_map<std::int64_t, std::int32_t> row_of_id;

  std::int32_t size() const { return static_cast<std::int32_t>(id.size()); }
};

/// All elements of one type. `connectivity` holds node rows, nodes_per_element at a time; `section` indexes Model::sections.
struct ElementTable {
  const ElementType* type = nullptr;
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> instance;  // as for nodes
  std::vector<std::int32_t> connectivity;
  std::vector<std::int32_t> section;
  std::vector<Location> location;
  std::vector<double> thickness;     // shells: by *DISTRIBUTION, as id; 0: the section's; empty: all have theirs
  std::vector<Point> corner_normal;  // shells: unit normals of the smooth surface, as connectivity; empty: those of the elements

  std::int32_t size() const { return static_cast<std::int32_t>(id.size()); }
};

struct NodeSet {
  std::string name;
  std::vector<std::int32_t> nodes;  // sorted rows without repetition, unless the deck said UNSORTED
  std::vector<std::int32_t> deck_order = {};  // the same as the deck lists them, for printed tables; empty: as `nodes`
  std::vector<std::int64_t> absent = {};      // ids that GENERATE made and no node has: deck_order has -1 - index for them
};

struct ElementSet {
  std::string name;
  std::vector<ElementRef> elements;  // sorted, without repetition
  std::vector<ElementRef> deck_order = {};  // as of node sets
};

/// A face of a solid (S1..S6: face 0..5), or a side of a membrane or shell (face 0: SPOS, 1: SNEG).
struct FaceRef {
  ElementRef element;
  std::int32_t face = 0;
};

/// One piece of the profile of an analytical rigid surface, in the profile plane (first, second local coordinate): a straight
/// line, or an arc of the given centre and of radius |start - centre|, turning left (counter-clockwise) or right.
struct ProfileSegment {
  enum class Kind { line, arc } kind = Kind::line;
  std::array<double, 2> start{}, end{}, centre{};
  bool counter_clockwise = false;
};

/// *SURFACE, TYPE=CYLINDER (profile extruded along the third axis), REVOLUTION (profile (r, z) revolved about the second axis) or
/// SEGMENTS (as CYLINDER in the global x, y plane). The outward normal is to the LEFT of the direction in which the profile runs.
struct AnalyticalSurface {
  enum class Kind { extruded, revolved } kind = Kind::extruded;
  Point origin{};
  std::array<Point, 3> axes{};  // orthonormal: first and second profile direction, and third
  std::vector<ProfileSegment> profile;  // connected; corners already rounded by FILLET RADIUS
};

struct Surface {
  enum class Kind { element_faces, nodes, analytical } kind = Kind::element_faces;
  std::string name;
  std::vector<FaceRef> faces;
  std::vector<std::int32_t> nodes;
  std::vector<FaceRef> edges;  // of sheets, edge i from corner i to the next; `nodes` are theirs then
  std::optional<AnalyticalSurface> analytical;
  Location location;
};

/// An option of a material beside its elastic law, as materials/material_option.hpp declares it.
struct MaterialOption {
  std::string name;                       // "plastic"
  std::vector<double> settings;           // numbers of the keyword line, in the declared order
  std::vector<std::vector<double>> rows;  // data lines
};

struct Material {
  std::string name;
  double density = 0.0;          // 0: not given
  double damping_alpha = 0.0;    // mass-proportional Rayleigh damping, 1/time
  double damping_beta = 0.0;     // stiffness-proportional Rayleigh damping, time
  std::string law;               // name in the register of materials/material_law.hpp; empty: none given
  std::vector<double> parameters;  // in the order in which the law declares them
  bool instantaneous = false;      // MODULI=INSTANTANEOUS: `parameters` hold before, not after *VISCOELASTIC has relaxed
  std::vector<MaterialOption> options;  // in deck order
  std::optional<ThermalExpansion> expansion;  // *EXPANSION
  Location location;
};

/// *ORIENTATION: local directions at a point. Rectangular: `axes` as they are. Cylindrical: radial, tangential, axial about the
/// line through `origin` along axes[2]. `additional_rotation` (radians) about local axis `rotation_axis` (0-based).
struct Orientation {
  enum class System { rectangular, cylindrical } system = System::rectangular;
  std::string name;
  Point origin{};
  std::array<Point, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  int rotation_axis = 0;  // membranes: the axis nearest the normal; the next axis (cyclic), projected, is local direction 1
  double additional_rotation = 0.0;
  std::vector<std::pair<ElementRef, std::array<Point, 3>>> of_element = {};  // axes of single elements, sorted, in place of `axes`

  /// As it is for one element.
  Orientation of(ElementRef element) const;
};

/// *TRANSFORM: nodal degrees of freedom of a set count along these directions (same meaning as in Orientation).
struct NodalTransform {
  std::vector<std::int32_t> nodes;
  Orientation directions;
};

/// One ply of a composite membrane or shell, from SNEG to SPOS: `angle` (radians) from the first local direction to the ply's own.
struct Ply {
  double thickness = 0.0;
  std::int32_t material = -1;
  double angle = 0.0;
  int points = 3;  // shells: integration points through its thickness
};

/// What only shells want to know of their section.
struct ShellOptions {
  int points = 5;                // through the thickness; composites: see Ply
  bool gauss = false;            // Gauss's quadrature through the thickness in place of Simpson's
  double offset = 0.0;           // from the middle surface to the nodes along the normal, relative to the thickness
  bool nodal_thickness = false;  // from NodeTable::thickness
  bool general = false;          // *SHELL GENERAL SECTION: integrated once, always elastic
  std::vector<double> stiffness;         // general: upper triangle, column by column, of (N11 N22 N12 M11 M22 M12) by (E11 E22 2E12 K11 K22 2K12)
  std::vector<double> transverse_shear;  // K11 K22 K12, force / length; empty: from the materials
  double mass_per_area = 0.0;            // general: beside that of the materials
};

/// Force of a spring over its relative displacement, of a dashpot over its relative velocity, and what it acts on.
struct SpringProperty {
  std::array<std::int32_t, 2> freedom{-1, -1};  // degrees of freedom of the first and second node; -1: along the line between them
  double slope = 0.0;                           // a straight line through the origin, where `table` is empty
  std::vector<std::array<double, 2>> table;     // (relative displacement or velocity, force), rising; constant beyond its ends
};

/// The cross-section of a beam; coordinates along n1 and n2 from the centroid, which the nodes are.
struct BeamProfile {
  /// Numbers in `dimensions`, as Abaqus orders them: general A I11 I12 I22 J; rectangle a b; circle r; pipe r t; box a b t1 t2 t3 t4;
  /// i_section l h b1 b2 t1 t2 t3.
  enum class Shape { general, rectangle, circle, pipe, box, i_section } shape = Shape::general;
  std::vector<double> dimensions;
  Point n1{0.0, 0.0, -1.0};
  std::optional<std::array<double, 2>> shear_stiffness;  // of shear along n1 and n2; none: from the material
  double youngs_modulus = 0.0, shear_modulus = 0.0, density = 0.0;  // general
};

enum class HourglassControl { enhanced, stiffness };

struct Section {
  enum class Kind { solid, membrane, shell, truss, beam, mass, rotary_inertia, spring, dashpot, connector, rigid } kind = Kind::solid;
  std::string element_set;
  std::int32_t material = -1;     // -1: none, or composite
  std::int32_t orientation = -1;  // row of Model::orientations, -1: the default directions
  double thickness = 1.0;         // membranes and shells: total thickness
  double area = 1.0;              // trusses
  BeamProfile beam;
  std::vector<Ply> plies;         // composite membranes and shells
  ShellOptions shell;
  HourglassControl hourglass = HourglassControl::enhanced;
  double hourglass_scale = 1.0;
  bool pointwise_dilatation = false;    // C3D8: volume changes at each point by its own, not by the mean of all
  double mass = 0.0;                    // MASS elements
  std::array<double, 6> inertia{};      // ROTARYI: I11 I22 I33 I12 I13 I23 about the node
  SpringProperty spring;                // springs and dashpots
  std::int32_t connector = -1;          // row of Model::connectors
  bool initially_stressed = false;      // an InitialField gives some of its elements a stress
  Location location;
};

/// *RIGID BODY. Node rows; elements of an element set contribute their nodes (to `tie_nodes`) and their mass.
struct RigidBody {
  std::string name;  // "RIGID-<reference node id>"
  std::int32_t reference_node = -1;
  bool at_center_of_mass = false;
  std::vector<std::int32_t> tie_nodes;
  std::vector<std::int32_t> pin_nodes;
  std::vector<ElementRef> elements;
  std::int32_t analytical_surface = -1;  // row of Model::surfaces
  Location location;
};

/// *AMPLITUDE. `value(t)` is a factor on the magnitude of whatever refers to it.
struct Amplitude {
  enum class Kind { tabular, smooth_step, periodic } kind = Kind::tabular;
  std::string name;
  bool total_time = false;
  std::vector<std::array<double, 2>> points;     // (time, value); tabular and smooth step
  double circular_frequency = 0.0, start = 0.0, initial = 0.0;  // periodic
  std::vector<std::array<double, 2>> harmonics;  // periodic: (A cos, B sin)

  double value(double time) const;
};

/// A contact pair: nodes of `slave` may not penetrate `master`.
struct ContactPair {
  std::int32_t slave = -1, master = -1;  // rows of Model::surfaces
  std::int32_t interaction = -1;
  std::int32_t first_step = 0;           // pairs declared inside a step begin there
  bool of_faces = false;                 // of a deformable master: kept from it are points of the slave's faces, not its nodes
  Location location;
};

/// *INITIAL CONDITIONS. They take effect when the first dynamic step starts, on the positions found by the steps before.
struct InitialVelocity {
  enum class Kind { translation, rotation } kind = Kind::translation;
  std::vector<std::int32_t> nodes;
  Point velocity{};            // translation: of component `dof` (0-2, global) alone; rotation: of the axis
  std::int32_t dof = -1;
  double angular_speed = 0.0;  // rotation about the axis through `axis_point` along `axis_direction` (unit)
  Point axis_point{}, axis_direction{};
  Location location;
};

/// *INITIAL CONDITIONS, TYPE=DISPLACEMENT: where nodes are when the analysis begins, from their coordinates.
struct InitialDisplacement {
  std::vector<std::int32_t> nodes;
  std::int32_t dof = 0;  // 0-2, global
  double value = 0.0;
  Location location;
};

/// *INITIAL CONDITIONS of elements: what a field of their law's history holds at their points when the analysis begins.
struct InitialField {
  std::string field;  // "S0": stress in the element's local directions (materials/initial_stress.hpp); "PEEQ": hardening
  int components = 1;
  std::vector<ElementRef> elements;  // sorted
  /// Of all points, or of one after the other: the integration points, of shells those through the thickness, from SNEG to SPOS.
  std::vector<double> values;
  Location location;
};

struct Units {
  std::string length, mass, time;  // empty: not declared
};

/// What goes on from nodes and elements of other numbers, which may stand elsewhere (ELEMENT SHIFT, SHIFT NODES of *IMPORT).
struct ImportedCopy {
  std::int64_t element_shift = 0, node_shift = 0;  // numbers here less numbers there
  std::vector<ElementRef> elements;                // sorted
  std::vector<std::int32_t> nodes;                 // rows, sorted
};

/// Which of the states that another job has kept; nothing said: the last one.
struct StateChoice {
  std::optional<std::int32_t> step;       // its number: the state at its end, if nothing else is said
  std::optional<std::int32_t> increment;  // of that step, or of the last one
  std::optional<std::int32_t> interval;   // the n-th state that is kept of the step
  bool operator==(const StateChoice&) const = default;
};

/// What starts from a state of another job (*IMPORT); everything else starts as the deck says.
struct StateImport {
  bool state = true;    // STATE: stresses and histories are imported, not the deformed mesh alone
  bool update = false;  // UPDATE: the imported positions become the reference configuration
  StateChoice choice;
  std::vector<ElementRef> elements;   // sorted
  std::vector<std::int32_t> nodes;    // rows, sorted: those of the elements among them
  std::vector<ImportedCopy> copies;   // of these, what has other numbers there; none is in two of them
  Location location;

  /// Copy that a node or element belongs to; null: it has the same number in both jobs.
  const ImportedCopy* copy_of(std::int32_t node_row) const;
  const ImportedCopy* copy_of(ElementRef element) const;
};

/// *RESTART, READ: the steps before are those of another job, which left its checkpoint when, or while, it did the last of them.
struct RestartRead {
  std::int32_t step = 0;  // number of that step
  bool end_step = false;  // it ends where the checkpoint stands
  StateChoice choice;
  Location location;
};

struct Model {
  std::string name;  // the job's name: the deck's file name without folder and extension
  std::string heading;
  std::string deck_sha256;
  Units units;
  std::vector<std::string> files;  // the deck and what it includes

  std::vector<Instance> instances;
  NodeTable nodes;
  std::vector<ElementTable> elements;
  std::vector<NodeSet> node_sets;
  std::vector<ElementSet> element_sets;
  std::vector<Surface> surfaces;
  std::vector<Material> materials;
  std::vector<Orientation> orientations;
  std::vector<NodalTransform> transforms;
  std::vector<Section> sections;
  std::vector<Connector> connectors;
  std::vector<RigidBody> rigid_bodies;
  std::vector<ConstraintDefinition> constraints;
  std::vector<Amplitude> amplitudes;
  std::vector<Interaction> interactions;
  std::vector<ContactPair> contact_pairs;
  std::vector<InitialVelocity> initial_velocities;
  std::vector<InitialField> initial_fields;
  std::vector<double> initial_temperature;  // a node row: at which matter is free of thermal strain; empty: 0 everywhere
  std::optional<StateImport> state_import;
  std::optional<RestartRead> restart_read;
  std::vector<Step> steps;
  std::vector<InitialDisplacement> initial_displacements;

  /// The last step before `step` that changed the state: what is not said anew goes on from it. -1: none.
  std::int32_t general_step_before(std::int32_t step) const;

  /// "FILE:LINE" for messages.
  std::string where(Location location) const;
  /// Ids as the deck says them: "27", or "INSTANCE.27".
  std::string node_name(std::int32_t row) const;
  std::string element_name(ElementRef element) const;
};

}  // namespace balocco
