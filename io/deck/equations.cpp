// *EQUATION *MPC.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "deck/builder.hpp"
#include "deck/geometry.hpp"
#include "deck/register.hpp"
#include "deck/text.hpp"
#include "elements/turning_nodes.hpp"

namespace balocco::deck {

namespace {

/// The fields of a block one after another, however they are spread over its lines.
class Fields {
 public:
  Fields(Builder& builder, const Block& block) : block_(block) {
    for (const auto& line : block.lines) rows_.emplace_back(builder, block, line);
    skip_ends();
  }
  bool done() const { return line_ >= rows_.size(); }
  Row& row() { return rows_[line_]; }
  int field() const { return field_; }
  Location location() const { return done() ? block_.lines.back().location : rows_[line_].location(); }
  void next() {
    ++field_;
    skip_ends();
  }
  /// A comma at the end of a line leaves an empty field that means nothing.
  void skip_ends() {
    while (line_ < rows_.size() && (field_ >= rows_[line_].size() || (field_ + 1 == rows_[line_].size() && !rows_[line_].has(field_)))) {
      ++line_;
      field_ = 0;
    }
  }

 private:
  const Block& block_;
  std::deque<Row> rows_;
  std::size_t line_ = 0;
  int field_ = 0;
};

void add_constraint(Builder& builder, ConstraintKind kind, std::string keyword, Location location) {
  builder.model.constraints.push_back({std::move(kind), std::move(keyword), location.file, location.line});
}

/// A term as the deck says it: a node or a set of nodes, each of which makes an equation of its own.
struct TermOfSet {
  std::vector<std::int32_t> nodes;
  std::int32_t dof = 0;
  double coefficient = 0.0;
};

std::optional<TermOfSet> read_term(Builder& builder, const Block& block, Fields& fields) {
  TermOfSet term;
  constexpr std::array what{"node or set", "degree of freedom", "coefficient"};
  for (int part = 0; part < 3; ++part) {
    if (fields.done()) {
      builder.error(block, fields.location(), fmt::format("a {} is missing; a term is: node or set, degree of freedom, coefficient", what[part]));
      return std::nullopt;
    }
    Row& row = fields.row();
    if (part == 0 && !builder.nodes_of(row.text(fields.field()), block, row.location(), term.nodes)) return std::nullopt;
    if (part == 1) term.dof = static_cast<std::int32_t>(row.integer(fields.field(), what[part])) - 1;
    if (part == 2) term.coefficient = row.real(fields.field(), what[part]);
    if (!row.ok()) return std::nullopt;
    if (part == 1 && (term.dof < 0 || term.dof > 5)) {
      row.error(fmt::format("degree of freedom {} is out of range; displacements are 1 to 3, rotations 4 to 6", term.dof + 1));
      return std::nullopt;
    }
    fields.next();
  }
  return term;
}

/// Rows of the equations whose first term speaks of a degree of freedom of one of the nodes.
std::vector<std::int32_t> equations_of(const Model& model, const std::vector<std::int32_t>& nodes, std::int64_t dof) {
  std::vector<std::int32_t> rows;
  for (std::size_t row = 0; row < model.constraints.size(); ++row) {
    const auto* equation = std::get_if<LinearEquation>(&model.constraints[row].kind);
    if (equation == nullptr || model.constraints[row].keyword != "*EQUATION") continue;
    const auto& term = equation->terms.front();
    if (term.dof == dof && std::ranges::count(nodes, term.node) > 0) rows.push_back(static_cast<std::int32_t>(row));
  }
  return rows;
}

/// REMOVE: lines "node or set, degree of freedom" of first terms; REMOVE ALL: every equation.
void remove_equations(Builder& builder, const Block& block) {
  if (!builder.in_step) return builder.error(block, block.location, "REMOVE takes equations out of a step; move it into one");
  auto& removed = builder.model.steps.back().removed_constraints;
  const bool all = block.has("REMOVE ALL");
  for (std::int32_t row = 0; all && row < std::ssize(builder.model.constraints); ++row)
    if (builder.model.constraints[row].keyword == "*EQUATION") removed.push_back(row);
  if (all && !block.lines.empty()) builder.error(block, block.lines.front().location, "REMOVE ALL takes no lines; remove them");
  if (!all && block.lines.empty())
    builder.error(block, block.location, "which equations is not said; add lines: node or set, degree of freedom");
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    std::vector<std::int32_t> nodes;
    const auto dof = row.integer(1, "degree of freedom");
    row.at_most(2);
    if (all || !row.ok() || !builder.nodes_of(row.text(0), block, line.location, nodes)) continue;
    const auto rows = equations_of(builder.model, nodes, dof - 1);
    if (rows.empty())
      row.error(fmt::format("no *EQUATION has degree of freedom {} of {} as its first term; correct the line", dof, row.text(0)));
    removed.insert(removed.end(), rows.begin(), rows.end());
  }
  std::ranges::sort(removed);
  removed.erase(std::unique(removed.begin(), removed.end()), removed.end());
}

void read_equation(Builder& builder, const Block& block) {
  if (block.has("REMOVE") || block.has("REMOVE ALL")) return remove_equations(builder, block);
  if (builder.in_step)
    return builder.error(block, block.location,
                         "equations hold from the start; move it before the first *STEP, or take equations out with REMOVE");
  Fields fields(builder, block);
  if (fields.done()) return builder.error(block, block.location, "the number of terms is missing; add a data line with it");
  while (!fields.done()) {
    const auto location = fields.location();
    const auto count = fields.row().integer(fields.field(), "number of terms");
    if (!fields.row().ok()) return;
    if (count < 1) return fields.row().error(fmt::format("an equation of {} terms says nothing; give their number", count));
    fields.next();
    std::vector<TermOfSet> terms;
    std::size_t equations = 1;
    for (std::int64_t i = 0; i < count; ++i) {
      auto term = read_term(builder, block, fields);
      if (!term) return;
      if (i > 0 && term->nodes.size() > 1 && equations > 1 && term->nodes.size() != equations)
        return builder.error(block, location,
                             fmt::format("sets of {} and {} nodes cannot be paired in one equation; give sets of the same size, or single "
                                         "nodes",
                                         equations, term->nodes.size()));
      equations = std::max(equations, term->nodes.size());
      terms.push_back(std::move(*term));
    }
    if (terms.front().coefficient == 0.0)
      return builder.error(block, location, "the coefficient of the first term is zero; put a term first that the equation determines");
    for (std::size_t k = 0; k < equations; ++k) {
      LinearEquation equation;
      for (const auto& term : terms)
        equation.terms.push_back({term.nodes.size() > 1 ? term.nodes[k] : term.nodes[0], term.dof, term.coefficient});
      add_constraint(builder, std::move(equation), "*EQUATION", location);
    }
  }
}

void add_equal(Builder& builder, std::int32_t first, std::int32_t second, int freedoms, Location location) {
  for (std::int32_t dof = 0; dof < freedoms; ++dof)
    add_constraint(builder, LinearEquation{{{first, dof, 1.0}, {second, dof, -1.0}}}, "*MPC", location);
}

/// The nodes of a line from field 1 on: numbers or sets, in the order of the deck.
bool nodes_of_line(Builder& builder, const Block& block, Row& row, std::vector<std::int32_t>& nodes) {
  for (int field = 1; field < row.size(); ++field) {
    if (!row.has(field)) continue;
    std::vector<std::int32_t> rows;
    if (!builder.nodes_of(row.text(field), block, row.location(), rows)) return false;
    nodes.insert(nodes.end(), rows.begin(), rows.end());
  }
  return true;
}

/// PLANE and STRAIGHT: three or two nodes, and others that stay in their plane or on their line.
void read_alignment(Builder& builder, const Block& block, Row& row, std::vector<std::int32_t> nodes, bool plane) {
  const std::size_t base = plane ? 3 : 2;
  if (nodes.size() <= base) {
    return row.error(fmt::format("{} of {} nodes says nothing: the first {} make the {}; name more nodes", plane ? "PLANE" : "STRAIGHT",
                                 nodes.size(), base, plane ? "plane" : "line"));
  }
  const auto at = [&](std::size_t i) { return builder.model.nodes.coordinates[nodes[i]]; };
  const auto along = subtract(at(1), at(0));
  if (!(norm(along) > 0.0)) return row.error("the first two nodes are in one place; name others first");
  if (plane) {  // a set, whose nodes are sorted, may begin with three on a line
    std::size_t third = 2;
    const auto spans = [&](std::size_t i) { return norm(cross(along, subtract(at(i), at(0)))) > 1e-6 * norm(along) * norm(subtract(at(i), at(0))); };
    while (third < nodes.size() && !spans(third)) ++third;
    if (third == nodes.size()) return row.error("all nodes lie on one line, which makes no plane; name others");
    std::rotate(nodes.begin() + 2, nodes.begin() + static_cast<std::ptrdiff_t>(third), nodes.begin() + static_cast<std::ptrdiff_t>(third) + 1);
  }
  for (std::size_t i = base; i < nodes.size(); ++i) {
    Alignment alignment{{nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(base)}};
    alignment.nodes.push_back(nodes[i]);
    add_constraint(builder, std::move(alignment), "*MPC", row.location());
  }
}

/// DIST: a, a, a, b, b, b, c: nodes a and b get no farther apart than the first coordinate of c says, which *BOUNDARY holds.
void read_rope(Builder& builder, Row& row, const std::vector<std::int32_t>& nodes) {
  const bool fits = nodes.size() == 7 && nodes[0] == nodes[1] && nodes[0] == nodes[2] && nodes[3] == nodes[4] && nodes[3] == nodes[5] &&
                    nodes[0] != nodes[3];
  if (!fits) return row.error("DIST is followed by a, a, a, b, b, b, c: nodes a and b, and c whose first coordinate is their greatest distance");
  const double distance = builder.model.nodes.coordinates[nodes[6]][0];
  if (!(distance > 0.0))
    return row.error(fmt::format("the first coordinate of node {}, the greatest distance, is {}; give a positive one", builder.model.node_name(nodes[6]), distance));
  add_constraint(builder, GreatestDistance{{nodes[0], nodes[3]}, distance}, "*MPC", row.location());
}

/// Unit vector from a node to another; none where both are in one place.
std::optional<Point> direction_of(const Builder& builder, std::int32_t from, std::int32_t to) {
  Point line = subtract(builder.model.nodes.coordinates[to], builder.model.nodes.coordinates[from]);
  const double length = norm(line);
  if (!(length > 0.0)) return std::nullopt;
  for (double& component : line) component /= length;
  return line;
}

/// REVOLUTE a, b, c and UNIVERSAL a, b, c, d: a turns against b about the line from b to c, which b carries along; and then about that
/// from b to d, which a carries along. Displacements are free. Freedom 6 of c (and d) is the angle. Source: Abaqus Analysis User's
/// Guide, "General multi-point constraints".
void read_turning_joint(Builder& builder, const Block& block, Row& row, const std::string& type, const std::vector<bool>& turns) {
  const bool universal = type == "UNIVERSAL";
  const std::size_t count = universal ? 4 : 3;
  std::vector<std::int32_t> nodes;
  if (!nodes_of_line(builder, block, row, nodes)) return;
  if (nodes.size() != count || nodes[0] == nodes[1])
    return row.error(universal ? "UNIVERSAL is followed by nodes a, b, c, d: a turns against b about the lines from b to c and from b to d"
                               : "REVOLUTE is followed by nodes a, b, c: a turns against b about the line from b to c");
  const auto name = [&](std::size_t i) { return builder.model.node_name(nodes[i]); };
  for (std::size_t i = 0; i < count; ++i) {
    const bool joined = i < 2;
    if (turns[nodes[i]] || builder.body_of_reference.contains(nodes[i])) {
      if (!joined)
        return row.error(fmt::format("node {} shows an axis, and its degree of freedom 6 would be the angle: take a node of no element", name(i)));
    } else if (joined) {
      return row.error(fmt::format("node {} does not turn; join nodes of shells, beams and ROTARYI elements or reference nodes of rigid bodies", name(i)));
    } else if (builder.joint_angles.contains(nodes[i])) {
      return row.error(fmt::format("node {} shows the angle of another joint; give each angle a node of its own", name(i)));
    }
  }
  const auto first = direction_of(builder, nodes[1], nodes[2]), second = universal ? direction_of(builder, nodes[1], nodes[3]) : std::nullopt;
  if (universal && (!first || !second || std::abs(dot(*first, *second)) > 1e-3))
    return row.error(fmt::format("the lines from node {} to nodes {} and {} are not two axes at right angles; move nodes {} and {}", name(1), name(2),
                                 name(3), name(2), name(3)));
  const auto axis = first.value_or(Point{0.0, 0.0, 1.0});  // as Abaqus takes it
  const auto across = universal ? axes_of_points({}, axis, *second) : std::nullopt;
  const auto about = axes_about(axis);
  // Rows: the first axis first; of a universal joint the second one third.
  const std::array<Point, 3> axes = across ? std::array<Point, 3>{axis, cross((*across)[1], axis), (*across)[1]} : std::array<Point, 3>{axis, about[0], about[1]};
  add_constraint(builder,
                 Joint{.nodes = {nodes[1], nodes[0]},
                       .pieces = {{.part = universal ? Joint::Part::universal : Joint::Part::revolute}},
                       .axes = axes,
                       .second_axes = axes},
                 "*MPC", row.location());
  // Cardan angles from b to a: the first, and of a universal joint the third.
  Guide guide{.nodes = {nodes[1], nodes[0]}, .axes = axes, .second_axes = axes, .kind = {.rotation = RelativeMotionKind::Rotation::cardan}};
  for (std::size_t i = 2; i < count; ++i) {
    guide.rows.push_back({.component = i == 2 ? 3 : 5, .angle_node = nodes[i]});
    builder.joint_angles[nodes[i]] = {static_cast<std::int32_t>(builder.model.constraints.size()), static_cast<int>(i) - 2};
  }
  guide.joint = static_cast<std::int32_t>(builder.model.constraints.size()) - 1;
  add_constraint(builder, std::move(guide), "*MPC " + type, row.location());
}

/// MEANROT: a, a, a, b, b, b ... c: the mean angle by which nodes a, b ... turn about the direction that the coordinates of c say
/// is the first displacement of c.
void read_mean_rotation(Builder& builder, Row& row, std::vector<std::int32_t> nodes) {
  bool fits = nodes.size() >= 7 && nodes.size() % 3 == 1;
  for (std::size_t i = 0; fits && i + 1 < nodes.size(); i += 3)
    fits = nodes[i] == nodes[i + 1] && nodes[i] == nodes[i + 2] && nodes[i] != nodes.back();
  if (!fits)
    return row.error("MEANROT is followed by a, a, a, b, b, b ... c: each node three times, and c whose coordinates are the axis");
  MeanRotation rotation;
  rotation.angle_node = nodes.back();
  rotation.axis = builder.model.nodes.coordinates[rotation.angle_node];
  const double length = norm(rotation.axis);
  if (!(length > 0.0)) return row.error("the coordinates of the last node, which are the axis, are zero; give a direction");
  for (double& component : rotation.axis) component /= length;
  Point centre{};
  for (std::size_t i = 0; i + 1 < nodes.size(); i += 3) {
    rotation.nodes.push_back(nodes[i]);
    for (int k = 0; k < 3; ++k)
      centre[k] += 3.0 / static_cast<double>(nodes.size() - 1) * builder.model.nodes.coordinates[nodes[i]][k];
  }
  for (const auto node : rotation.nodes) {
    const auto arm = subtract(builder.model.nodes.coordinates[node], centre);
    if (!(norm(cross(rotation.axis, arm)) > 1e-6 * norm(arm)))
      return row.error(fmt::format("node {} lies on the axis through the centre of the nodes, where it has no angle; take it out",
                                   builder.model.node_name(node)));
  }
  add_constraint(builder, std::move(rotation), "*MPC", row.location());
}

void read_mpc(Builder& builder, const Block& block) {
  const auto turns = turning_nodes(builder.model);
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const auto type = squeeze(row.text(0));
    std::vector<std::int32_t> firsts, seconds;
    if (type == "PLANE" || type == "STRAIGHT" || type == "DIST" || type == "MEANROT") {
      std::vector<std::int32_t> nodes;
      if (!nodes_of_line(builder, block, row, nodes)) continue;
      if (type == "DIST")
        read_rope(builder, row, nodes);
      else if (type == "MEANROT")
        read_mean_rotation(builder, row, std::move(nodes));
      else
        read_alignment(builder, block, row, std::move(nodes), type == "PLANE");
      continue;
    }
    if (type == "REVOLUTE" || type == "UNIVERSAL") {
      read_turning_joint(builder, block, row, type, turns);
      continue;
    }
    if (type != "BEAM" && type != "PIN" && type != "TIE" && type != "LINK") {
      row.error(
          fmt::format("type {} is not known; there are BEAM, PIN, TIE, LINK, REVOLUTE, UNIVERSAL, PLANE, STRAIGHT, DIST and MEANROT; "
                      "other joints are connectors (*CONNECTOR SECTION)",
                      row.text(0)));
      continue;
    }
    if (!row.has(1) || !row.has(2)) {
      row.error(fmt::format("{} needs two nodes: dependent node or set, node", type));
      continue;
    }
    row.at_most(3);
    if (!row.ok() || !builder.nodes_of(row.text(1), block, line.location, firsts) || !builder.nodes_of(row.text(2), block, line.location, seconds))
      continue;
    if (seconds.size() != 1 && seconds.size() != firsts.size()) {
      row.error(fmt::format("{} and {} nodes cannot be paired; give one second node, or as many as there are first ones", firsts.size(), seconds.size()));
      continue;
    }
    for (std::size_t i = 0; i < firsts.size(); ++i) {
      const auto first = firsts[i], second = seconds[seconds.size() == 1 ? 0 : i];
      if (first == second) {
        row.error(fmt::format("node {} cannot be joined to itself; give two nodes", builder.model.node_name(first)));
        break;
      }
      if (type == "PIN" || type == "TIE") {
        add_equal(builder, first, second, type == "TIE" && turns[first] && turns[second] ? 6 : 3, line.location);
        continue;
      }
      const auto part = type == "LINK" ? Joint::Part::distance : Joint::Part::offset;
      if (type == "BEAM") builder.held_rotations.push_back({.joint = static_cast<std::int32_t>(builder.model.constraints.size())});
      add_constraint(builder, Joint{.nodes = {second, first}, .pieces = {{.part = part}}}, "*MPC", line.location);
    }
  }
}

const RegisterKeyword equation{
    {"EQUATION", Phase::constraints, Place::anywhere, {flag("REMOVE"), flag("REMOVE ALL")}, read_equation}};
const RegisterKeyword mpc{{"MPC", Phase::constraints, Place::model, {}, read_mpc}};

}  // namespace

}  // namespace balocco::deck
