#include "explicit_scale.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elements/bulk_viscosity.hpp"
#include "elements/element_type.hpp"
#include "loads/body_load.hpp"
#include "model/bounding_box.hpp"

namespace balocco {

namespace {

/// Forces may exceed the one that strains an element by about one this many times before the run counts as blown up.
constexpr double safety = 64.0;

double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Shortest distance between two nodes of an element, for each local node over all elements of the model that touch it.
std::vector<double> shortest_edges(const Model& model, const Domain& domain) {
  const double longest = model_size(model);
  std::vector<double> edge(static_cast<std::size_t>(domain.size()), longest);
  const auto shorten = [&](std::int32_t row, double length) {
    if (const auto node = domain.local_node[row]; node >= 0 && length > 0.0) edge[node] = std::min(edge[node], length);
  };
  for (const auto& table : model.elements) {
    const int count = table.type->nodes;
    for (std::int32_t row = 0; row < table.size(); ++row) {
      const auto* nodes = &table.connectivity[static_cast<std::size_t>(row) * static_cast<std::size_t>(count)];
      for (int i = 0; i < count; ++i) {
        for (int j = 0; j < i; ++j) {
          const double length = distance(model.nodes.coordinates[nodes[i]], model.nodes.coordinates[nodes[j]]);
          shorten(nodes[i], length);
          shorten(nodes[j], length);
        }
      }
    }
  }
  return edge;
}

/// Nodal masses of elements alone: point masses load no element by themselves.
std::vector<double> element_masses(const Analysis& analysis) {
  auto mass = analysis.inertia.mass;
  for (const auto& table : analysis.model.elements) {
    if (table.type->section != Section::Kind::mass) continue;
    for (std::int32_t row = 0; row < table.size(); ++row)
      if (const auto node = analysis.domain.local_node[table.connectivity[row]]; node >= 0)
        mass[node] = std::max(0.0, mass[node] - analysis.model.sections[table.section[row]].mass);
  }
  return mass;
}

/// Greatest factor that an amplitude can reach; 1 without amplitude.
double greatest_factor(const Model& model, std::int32_t amplitude) {
  if (amplitude < 0) return 1.0;
  const auto& curve = model.amplitudes[amplitude];
  double greatest = std::abs(curve.initial);
  for (const auto& [a, b] : curve.harmonics) greatest += std::abs(a) + std::abs(b);
  for (const auto& point : curve.points) greatest = std::max(greatest, std::abs(point[1]));
  return greatest;
}

double distance_from_axis(const BodyLoad& load, const Point& place) {
  Vector3<double> arm{}, axis{};
  for (int i = 0; i < 3; ++i) {
    arm[i] = place[i] - load.point[i];
    axis[i] = load.direction[i];
  }
  const auto across = cross(axis, arm);
  return std::sqrt(dot(across, across));
}

/// Adds what a body load of magnitude `greatest` can do to each node, alike on all copies of it.
void add_body_load(const Analysis& analysis, const BodyLoad& load, double greatest, std::vector<double>& largest) {
  const auto& domain = analysis.domain;
  double volume = 0.0;
  if (!acts_on_mass(load)) volume = analysis.communicator.maximum(std::ranges::max(analysis.loaded_share(load)));
  const double size = model_size(analysis.model);
  for (std::int32_t node = 0; node < domain.size(); ++node) {
    double force = greatest * (acts_on_mass(load) ? analysis.inertia.mass[node] : volume);
    if (load.kind == BodyLoad::Kind::centrifugal)
      force *= size + distance_from_axis(load, analysis.model.nodes.coordinates[domain.node_row[node]]);
    largest[node] += force;
  }
}

void add_loads(const Analysis& analysis, const Step& step, std::vector<double>& largest, std::vector<double>& moment) {
  const auto greatest = [&](const auto& load) {
    return std::max(std::abs(load.magnitude), std::abs(load.previous)) *
           greatest_factor(analysis.model, load.amplitude);
  };
  for (const auto& load : step.concentrated_loads) {
    const auto node = analysis.domain.local_node[load.node];
    if (node >= 0 && load.dof < 3) largest[node] += greatest(load);
    if (load.dof >= 3 && node >= 0 && node < analysis.domain.turning) moment[node] += greatest(load);
  }
  for (const auto& load : step.body_loads) add_body_load(analysis, load, greatest(load), largest);
}

double greatest_pull(const Restraint& restraint, double reach, double increment) {
  return restraint.stiffness * reach + restraint.viscosity * (reach / increment) + restraint.force;
}

/// Springs may stretch by the size of the model or turn around, by what is prescribed, and by what moving nodes pass in an increment:
/// the last two count where all nodes lie in one place.
void add_restraints(const Analysis& analysis, const Step& step, const NodalRestraints& restraints, double increment,
                    std::vector<double>& largest, std::vector<double>& moment) {
  const double size = model_size(analysis.model);
  double displacement = size, rotation = 2.0 * std::numbers::pi, speed = 0.0, spin = 0.0;
  for (const auto& condition : step.boundary) {
    const double magnitude = std::abs(condition.magnitude) * greatest_factor(analysis.model, condition.amplitude);
    const bool turns = condition.dof >= 3;
    auto& way = turns ? rotation : displacement;
    auto& rate = turns ? spin : speed;
    if (condition.kind == BoundaryCondition::Kind::displacement) way = std::max(way, magnitude);
    if (condition.kind == BoundaryCondition::Kind::velocity) rate = std::max(rate, magnitude);
  }
  for (const auto& initial : analysis.model.initial_velocities) {
    const auto& v = initial.velocity;
    speed = std::max(speed, std::hypot(v[0], v[1], v[2]));
    spin = std::max(spin, std::abs(initial.angular_speed));
  }
  const double reach = displacement + (speed + spin * size) * increment, turn = rotation + spin * increment;
  for (std::size_t node = 0; node < restraints.translation.size(); ++node) {
    const double pull = greatest_pull(restraints.translation[node], reach, increment);
    largest[node] += pull;
    if (node < moment.size()) moment[node] += pull * reach;  // the pull of a connector has an arm about the other node
  }
  for (std::size_t node = 0; node < restraints.rotation.size(); ++node) moment[node] += greatest_pull(restraints.rotation[node], turn, increment);
}

}  // namespace

double undeformed_increment(const Model& model, const Communicator& communicator, const Domain& domain,
                            std::span<const std::unique_ptr<ElementGroup>> groups) {
  std::vector<double> position(4 * static_cast<std::size_t>(domain.size() + 1), 0.0), velocity(position.size(), 0.0),
      force(position.size(), 0.0), moment(position.size(), 0.0),
      orientation(4 * static_cast<std::size_t>(domain.turning), 0.0), spin(orientation.size(), 0.0);
  for (std::size_t i = 0; i < orientation.size(); i += 4) orientation[i] = 1.0;
  for (std::int32_t node = 0; node < domain.size(); ++node)
    std::copy_n(model.nodes.coordinates[domain.node_row[node]].data(), 3, &position[4 * node]);
  const ExplicitCycle cycle{.motion = {.position = position.data(),
                                       .velocity = velocity.data(),
                                       .orientation = orientation.data(),
                                       .angular_velocity = spin.data(),
                                       .rotation = spin.data()},
                            .forces = {.force = force.data(), .moment = moment.data()}};
  StableIncrement smallest;
  for (const auto& group : groups) {
    auto history = group->initial_history();
    for (const auto portion : {Portion::interface, Portion::interior})
      smallest.merge(group->add_forces(portion, cycle, history));
  }
  return communicator.minimum(smallest.increment);
}

ForceScale force_scale(const Analysis& analysis, const Step& step, const NodalRestraints& restraints) {
  const double increment = analysis.undeformed_increment;
  ForceScale scale;
  const auto edge = shortest_edges(analysis.model, analysis.domain);
  auto largest = element_masses(analysis);
  for (std::size_t node = 0; node < largest.size(); ++node)
    largest[node] *= edge[node] / (increment * increment);
  // A rotation of about one strains the element: moments are rotary inertia / increment^2, or that force at the edge's end.
  std::vector<double> moment(analysis.inertia.rotary);
  scale.lever.assign(edge.begin(), edge.begin() + analysis.domain.turning);
  for (std::size_t node = 0; node < moment.size(); ++node)
    moment[node] = std::max(moment[node] / (increment * increment), largest[node] * edge[node]);
  add_loads(analysis, step, largest, moment);
  if (std::isfinite(analysis.current.restraint_increment))
    add_restraints(analysis, step, restraints, std::min(increment, analysis.current.restraint_increment), largest, moment);
  std::vector<double> springs;  // of deformable masters and their slaves
  for (const auto pair : step.active_contact_pairs) {
    const auto& contact = analysis.contacts[pair];
    for (std::int32_t point = 0; point < contact.size(); ++point)
      largest[contact.nodes()[point]] += contact.normal_stiffness(point) * edge[contact.nodes()[point]];
    springs.resize(largest.size());
    analysis.mesh_contacts[pair].add_spring_stiffness(springs);
  }
  for (std::size_t node = 0; node < springs.size(); ++node) largest[node] += springs[node] * edge[node];
  for (const double value : largest)
    scale.rounding_constant.push_back(rounding_constant(value > 0.0 ? safety * value : 1.0));
  scale.rounding_constant.push_back(rounding_constant(1.0));
  for (const double value : moment) scale.moment_constant.push_back(rounding_constant(value > 0.0 ? safety * value : 1.0));
  return scale;
}

}  // namespace balocco
