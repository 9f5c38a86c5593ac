// *INITIAL CONDITIONS.
#include <fmt/format.h>

#include "deck/builder.hpp"
#include "deck/geometry.hpp"
#include "deck/register.hpp"

namespace balocco::deck {

namespace {

void read_velocities(Builder& builder, const Block& block) {
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    InitialVelocity velocity;
    velocity.location = line.location;
    const std::int64_t dof = row.integer(1, "degree of freedom");
    const double value = row.real(2, "velocity");
    row.at_most(3);
    if (row.ok() && (dof < 1 || dof > 3))
      row.error(fmt::format("degree of freedom {} has no initial velocity; give 1 to 3", dof));
    if (!row.ok() || !builder.nodes_of(row.text(0), block, line.location, velocity.nodes)) continue;
    velocity.dof = static_cast<std::int32_t>(dof - 1);
    velocity.velocity[velocity.dof] = value;
    builder.model.initial_velocities.push_back(std::move(velocity));
  }
}

/// Pairs of lines: nodes, angular speed, velocity of the axis; two points of the axis.
void read_rotating_velocities(Builder& builder, const Block& block) {
  if (block.lines.size() % 2 != 0) {
    return builder.error(
        block, block.location,
        "each line 'nodes, angular speed, vx, vy, vz' needs a line with two points of the axis; add it");
  }
  for (std::size_t line = 0; line < block.lines.size(); line += 2) {
    Row row(builder, block, block.lines[line]), axis(builder, block, block.lines[line + 1]);
    InitialVelocity rotation;
    rotation.kind = InitialVelocity::Kind::rotation;
    rotation.location = row.location();
    rotation.angular_speed = row.real(1, "angular speed");
    Point second{};
    for (int i = 0; i < 3; ++i) {
      rotation.velocity[i] = row.real_or(2 + i, 0.0, "velocity of the axis");
      rotation.axis_point[i] = axis.real_or(i, 0.0, "first point of the axis");
      second[i] = axis.real_or(3 + i, 0.0, "second point of the axis");
    }
    row.at_most(5);
    axis.at_most(6);
    rotation.axis_direction = subtract(second, rotation.axis_point);
    const double length = norm(rotation.axis_direction);
    if (axis.ok() && !(length > 0.0)) axis.error("the two points of the axis coincide; correct them");
    if (!row.ok() || !axis.ok() || !builder.nodes_of(row.text(0), block, row.location(), rotation.nodes)) continue;
    for (double& component : rotation.axis_direction) component /= length;
    builder.model.initial_velocities.push_back(std::move(rotation));
  }
}

void read_initial_conditions(Builder& builder, const Block& block) {
  block.value("TYPE") == "VELOCITY" ? read_velocities(builder, block) : read_rotating_velocities(builder, block);
}

const RegisterKeyword initial{{"INITIAL CONDITIONS",
                               Phase::constraints,
                               Place::model,
                               {required(choice("TYPE", {"VELOCITY", "ROTATING VELOCITY"}))},
                               read_initial_conditions}};

}  // namespace

}  // namespace balocco::deck
