// What handlers build with: the Model so far, names and ids with their scopes, and messages that are told once.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "deck/diagnostics.hpp"
#include "deck/distributions.hpp"
#include "deck/step_draft.hpp"
#include "deck/tokens.hpp"
#include "elements/shells/shell_normals.hpp"
#include "model/model.hpp"

namespace balocco::deck {

/// Rows of a table of the Model by name. Names inside an instance are "INSTANCE.NAME".
struct Names {
  std::string kind;  // "node set", for messages
  std::map<std::string, std::int32_t, std::less<>> rows;
};

/// Whose names and ids a block speaks of: the whole deck, or an instance, whose ids are shifted to be unique.
struct Scope {
  std::string prefix;                                       // "" or "INSTANCE."
  std::int32_t instance = -1;                               // row of Model::instances
  std::int32_t node_set = -1, element_set = -1;             // *INSTANCE, NSET=, ELSET=: sets of all that it holds
  std::optional<std::int64_t> node_offset, element_offset;  // set when the first node or element is defined
  std::int64_t largest_node = 0, largest_element = 0;       // before the shift
  std::array<Point, 3> rotation{
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // x -> rotation (x + translation - centre) + centre
  Point translation{}, centre{};

  Point place(const Point& local) const;
  Point turn(const Point& direction) const;
};

/// *SECTION CONTROLS.
struct SectionControls {
  HourglassControl hourglass = HourglassControl::enhanced;
  double hourglass_scale = 1.0;
  bool pointwise_dilatation = false;
};

/// Elements of one *ELEMENT block.
struct ElementRange {
  const Block* block;
  std::int32_t table, first, last;  // rows first .. last - 1
};

/// An *ORIENTATION whose axes are those of each element that has it.
struct ElementDirections {
  std::array<int, 3> corner{-1, -1, -1};  // OFFSET TO NODES: nodes a, b and c of the element, from 0
  std::string distribution;               // else the name of a *DISTRIBUTION
};

/// A coordinate system for nodes: *SYSTEM or *NODE, SYSTEM=.
struct NodeSystem {
  Point origin{};
  std::array<Point, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};

class Builder {
 public:
  explicit Builder(Diagnostics& diagnostics_to_fill) : diagnostics(diagnostics_to_fill) {}

  Model model;
  Diagnostics& diagnostics;

  Names node_sets{"node set", {}}, element_sets{"element set", {}}, surfaces{"surface", {}}, materials{"material", {}},
      orientations{"orientation", {}}, amplitudes{"amplitude", {}}, interactions{"surface interaction", {}};
  std::map<std::string, SectionControls> section_controls;
  std::map<std::string, Connector> connector_behaviors;  // of which only the components and matrices are said
  Connector* connector_behavior = nullptr;               // the last
  std::map<std::string, double> fastener_radius;
  std::map<std::string, std::vector<double>> time_points;
  std::unordered_map<std::int64_t, ElementRef> element_of_id;
  std::set<std::string> spellings_told;        // element types that are computed as others
  std::vector<ElementRange> locking_hybrids;  // element_spellings.hpp
  std::vector<std::array<std::int32_t, 4>> sorted_solid_faces;  // filled when a surface first asks for free faces
  std::set<std::int32_t> unsorted_node_sets;
  std::set<std::int32_t> absolute_amplitudes;  // *AMPLITUDE, VALUE=ABSOLUTE: magnitudes that refer to them become 1
  NodeSystem node_system;
  GivenNormals normals;  // of shells
  std::set<std::size_t> without_field, without_history;                   // steps that asked for no output, FREQUENCY=0
  std::map<std::string, std::set<std::int32_t>> contact_pair_sets;        // *CONTACT PAIR, CPSET=
  std::map<std::int32_t, double> slip_tolerance;                          // interaction -> *FRICTION, SLIP TOLERANCE
  std::vector<std::pair<std::string, Location>> asked_element_variables;  // by name, to be checked against the elements
  std::unordered_map<std::int32_t, std::int32_t> body_of_reference;       // reference node -> Model::rigid_bodies
  std::vector<BoundaryCondition> initial_boundary;                        // *BOUNDARY before the first step
  std::optional<std::int32_t> checkpoint_frequency, checkpoint_number_interval;  // *RESTART there
  bool keeps_checkpoints = false;
  bool checkpoints_by_procedure = false;                                         // the last *RESTART, WRITE says not when

  std::deque<Scope> scopes{1};  // the first is the whole deck's
  Scope* scope = &scopes.front();
  StepDraft draft;                       // the step being read
  const Block* coupling = nullptr;       // the last *COUPLING
  std::set<const Block*> refused_steps;  // *STEP blocks in which something was refused
  bool in_step = false;
  bool first_pass = false;       // nodes and elements phases: what refers to things defined further down is put off
  bool put_off = false;          // set by a handler that wants to be called again
  // Something that defines nodes, elements or anything was refused: what may be undefined for that is not told.
  bool nodes_incomplete = false, elements_incomplete = false, text_incomplete = false;

  void error(const Block& block, Location location, std::string text);
  void warning(const Block& block, Location location, std::string text);
  /// Marks everything that a refused block would have defined.
  void poison(const Block& block);

  /// Row of a name as the current scope sees it; nothing is told.
  std::optional<std::int32_t> find(const Names& names, std::string_view name) const;
  /// The same, and an error once per name that is not defined.
  std::optional<std::int32_t> require(const Names& names, std::string_view name, const Block& block, Location location);
  /// Registers a new name in the current scope; an error if it is taken. Returns the full name.
  std::optional<std::string> define(Names& names, std::string_view name, std::int32_t row, const Block& block);

  std::optional<std::int32_t> node(std::int64_t id) const;
  std::optional<ElementRef> element(std::int64_t id) const;
  std::optional<std::int32_t> require_node(std::int64_t id, const Block& block, Location location);

  /// What TIME POINTS= of a block names; null if it is undefined (told).
  const std::vector<double>* require_time_points(const Block& block);
  /// A node id, "INSTANCE.id" or node set. @return false if it is undefined (told).
  bool nodes_of(std::string_view field, const Block& block, Location location, std::vector<std::int32_t>& rows);
  bool elements_of(std::string_view field, const Block& block, Location location, std::vector<ElementRef>& elements);

  /// Set of that name in the current scope, made if it does not exist yet.
  std::int32_t node_set_row(std::string_view name);
  std::int32_t element_set_row(std::string_view name);
  /// Members, sorted and without repetition unless UNSORTED.
  const std::vector<std::int32_t>& nodes_in(std::int32_t set);
  const std::vector<ElementRef>& elements_in(std::int32_t set);
  void add_to_node_set(std::int32_t set, std::int32_t row);
  /// An id that no node has: tables of the set list it.
  void add_absent_node(std::int32_t set, std::int64_t id);
  void add_to_element_set(std::int32_t set, ElementRef element);
  void normalize_sets();

  std::int64_t element_id(ElementRef element) const { return model.elements[element.table].id[element.row]; }
  /// True if a refused block would have defined that name, or the instance in front of it.
  bool is_poisoned(std::string_view name) const;

 private:
  static std::string squeezed(std::string_view name);
  const Scope* scope_of_instance(std::string_view name) const;
  void tell_undefined(const std::string& what, const std::string& cure, const Block& block, Location location);

  std::set<std::string> poisoned_;
  std::set<std::string> told_undefined_;
  std::vector<bool> node_set_dirty_, element_set_dirty_;

 public:
  std::set<std::int32_t> ground_nodes;                   // of connectors to the ground: made for them, held in every step
  std::map<std::int32_t, ElementDirections> element_directions;  // by row of Model::orientations
  std::map<std::string, std::vector<std::string>> distribution_tables;
  Names distributions{"distribution", {}};  // rows of:
  std::vector<Distribution> distribution;
  /// Rotations about `along` of a joint's second node, which it holds if the node turns; hold_rotations() finds out.
  struct HeldRotation {
    std::int32_t joint = -1;  // row of Model::constraints
    std::array<bool, 3> along{true, true, true};
  };
  std::vector<HeldRotation> held_rotations;
  struct JointAngle {
    std::int32_t guide = -1;  // row of Model::constraints
    int row = 0;              // of it
  };
  std::map<std::int32_t, JointAngle> joint_angles;       // nodes whose freedom 6 is the angle of an *MPC REVOLUTE or UNIVERSAL
  std::vector<ConnectorMotion> initial_angles;           // *BOUNDARY on them before the first step
  Guide::Friction* connector_friction = nullptr;         // the last, until a *SURFACE INTERACTION: what *FRICTION speaks of
  std::map<std::string, std::vector<std::array<double, 6>>> derived_components;  // of the last behavior: Guide::Friction::terms
};

/// One data line split into fields, with checked access. A field that cannot be read is told, and ok() turns false.
class Row {
 public:
  Row(Builder& builder, const Block& block, const DataLine& line);
  int size() const { return static_cast<int>(fields_.size()); }
  bool has(int field) const { return field < size() && !fields_[field].empty(); }
  std::string_view text(int field) const { return field < size() ? fields_[field] : std::string_view{}; }
  std::string name(int field) const;
  double real(int field, const char* what);
  double real_or(int field, double otherwise, const char* what) { return has(field) ? real(field, what) : otherwise; }
  /// Coordinates in fields `first`..; one that is left out is zero.
  Point point(int first, const char* what) {
    return {real_or(first, 0.0, what), real_or(first + 1, 0.0, what), real_or(first + 2, 0.0, what)};
  }
  std::int64_t integer(int field, const char* what);
  std::int64_t integer_or(int field, std::int64_t otherwise, const char* what) {
    return has(field) ? integer(field, what) : otherwise;
  }
  bool ok() const { return ok_; }
  void error(std::string text);
  /// Tells that there are more fields than the keyword knows.
  void at_most(int fields);
  Location location() const { return line_.location; }

 private:
  std::string missing_or_bad(int field, const char* what, const char* kind) const;

  Builder& builder_;
  const Block& block_;
  const DataLine& line_;
  std::vector<std::string_view> fields_;
  bool ok_ = true;
};

inline Step& current_step(Builder& builder) {
  return builder.model.steps.back();
}

}  // namespace balocco::deck
