// *EQUATION *MPC.
#include <fmt/format.h>

#include <algorithm>

#include "deck/builder.hpp"
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

void add(Builder& builder, ConstraintKind kind, std::string keyword, Location location) {
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

void read_equation(Builder& builder, const Block& block) {
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
      add(builder, std::move(equation), "*EQUATION", location);
    }
  }
}

void add_equal(Builder& builder, std::int32_t first, std::int32_t second, int freedoms, Location location) {
  for (std::int32_t dof = 0; dof < freedoms; ++dof)
    add(builder, LinearEquation{{{first, dof, 1.0}, {second, dof, -1.0}}}, "*MPC", location);
}

void read_mpc(Builder& builder, const Block& block) {
  const auto turns = turning_nodes(builder.model);
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    const auto type = squeeze(row.text(0));
    std::vector<std::int32_t> firsts, seconds;
    if (type != "BEAM" && type != "PIN" && type != "TIE" && type != "LINK") {
      row.error(fmt::format("type {} is not known; there are BEAM, PIN, TIE and LINK; joints are connectors (*CONNECTOR SECTION)", row.text(0)));
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
      Joint joint{.nodes = {second, first}, .pieces = {}};
      if (type == "LINK")
        joint.pieces = {{.part = Joint::Part::distance}};
      else if (turns[first])
        joint.pieces = {{.part = Joint::Part::offset}, {.part = Joint::Part::align}};
      else
        joint.pieces = {{.part = Joint::Part::offset}};
      add(builder, std::move(joint), "*MPC", line.location);
    }
  }
}

const RegisterKeyword equation{{"EQUATION", Phase::constraints, Place::model, {}, read_equation}};
const RegisterKeyword mpc{{"MPC", Phase::constraints, Place::model, {}, read_mpc}};

}  // namespace

}  // namespace balocco::deck
