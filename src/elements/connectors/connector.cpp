#include "elements/connectors/connector.hpp"

#include <algorithm>
#include <cmath>

#include "constraints/nodal_directions.hpp"
#include "elements/element_type.hpp"
#include "math/exact_sum.hpp"
#include "model/bounding_box.hpp"
#include "math/rotation.hpp"

namespace balocco {

namespace {

// Rows of an element's history.
constexpr int motion_row = 0, force_row = 6, elastic_row = 12, dissipation_row = 18, reach_row = 19;

}  // namespace

bool turns_nodes(const Connector& connector) {
  return connector.translation == Connector::Translation::cartesian || connector.rotation != Connector::Rotation::none;
}

ConnectorGroup::ConnectorGroup(const GroupInput& input)
    : ElementGroup(input), connector_(input.model.connectors[input.model.sections[input.section].connector]) {
  freedoms_per_node_ = turns_nodes(connector_) ? 6 : 3;
  for (int c = 0; c < 6; ++c) {
    const auto& component = connector_.component[c];
    if (component.elasticity) elasticity_[c].emplace(component.elasticity->slope, component.elasticity->table);
    if (component.damping) damping_[c].emplace(component.damping->slope, component.damping->table);
  }
  const auto is_given = [](const auto& law) { return law.has_value(); };
  pulls_ = std::ranges::any_of(elasticity_, is_given) || std::ranges::any_of(damping_, is_given) || !connector_.coupled_elasticity.empty() ||
           !connector_.coupled_damping.empty();
  if (has_growing_arm()) least_reach_ = 1e-6 * model_size(input.model);
  const ElementTable& table = input.model.elements[table_];
  for (std::int32_t element = 0; element < size_; ++element) {
    const auto* node = &table.connectivity[2 * static_cast<std::size_t>(rows_[element])];
    RelativeMotion::Axes axes;
    for (int end = 0; end < 2; ++end) {
      const auto orientation = connector_.orientation[end] >= 0 ? connector_.orientation[end] : connector_.orientation[0];
      axes[end] = orientation >= 0 ? local_axes(input.model.orientations[orientation], input.model.nodes.coordinates[node[end]])
                                   : Matrix3<double>::identity();
    }
    const auto at = [&](int end) { return Vector3<double>{input.model.nodes.coordinates[node[end]]}; };
    auto& reference = references_.emplace_back(Reference{{connector_, axes, at(1) - at(0)}});
    for (int c = 0; c < 6; ++c)
      if (const auto& unloaded = connector_.component[c].reference)
        reference.stretched[c] = reference.relative.position_at_start(c) - *unloaded;
  }
}

std::array<NodePlace, 2> ConnectorGroup::places(std::int32_t element, const NodalMotion& motion) const {
  std::array<NodePlace, 2> result;
  for (int end = 0; end < 2; ++end) {
    const auto node = std::ptrdiff_t{nodes(element)[end]};
    const double* const x = motion.position + 4 * node;
    result[end].position = {{x[0], x[1], x[2]}};
    if (!turns()) continue;
    const double* const q = motion.orientation + 4 * node;
    result[end].rotation = rotation_matrix(Quaternion<double>{q[0], q[1], q[2], q[3]});
  }
  return result;
}

ConnectorGroup::Kinematics ConnectorGroup::kinematics(std::int32_t element, const NodalMotion& motion, std::span<const double> old_motion) const {
  const auto& relative = references_[element].relative;
  const auto measured = relative.at<Slope>(places(element, motion), {slope_seed(0), slope_seed(1)});
  Kinematics result;
  for (int c = 0; c < 6; ++c) {
    result.motion[c] = relative.nearest(c, measured[c].value, old_motion[c]);
    result.gradient[c] = measured[c].derivative;
  }
  return result;
}

/// stiffness += force . second derivatives.
void ConnectorGroup::add_curvature(std::int32_t element, const NodalMotion& motion, const Six& force, std::span<double> stiffness) const {
  const auto measured = references_[element].relative.at<Curvature>(places(element, motion), {curvature_seed(0), curvature_seed(1)});
  const int size = 2 * freedoms_per_node_;
  const auto column = [&](int k) { return 6 * (k / freedoms_per_node_) + k % freedoms_per_node_; };
  for (int c = 0; c < 6; ++c)
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) stiffness[size * i + j] += force[c] * measured[c].derivative[column(i)].derivative[column(j)];
}

ConnectorGroup::Six ConnectorGroup::coupled(const std::vector<double>& matrix, const Six& motion) const {
  Six force{};
  std::size_t entry = 0;
  for (int j = 0; j < 6 && !matrix.empty(); ++j)
    for (int i = 0; i <= j; ++i) {
      force[i] += matrix[entry] * motion[j];
      if (i != j) force[j] += matrix[entry] * motion[i];
      ++entry;
    }
  return force;
}

/// Relative motion from where there is no force.
ConnectorGroup::Six ConnectorGroup::stretch(std::int32_t element, const Six& motion) const {
  Six result = motion;
  for (int c = 0; c < 6; ++c) result[c] += references_[element].stretched[c];
  return result;
}

ConnectorGroup::Rate ConnectorGroup::mean_rate(const Six& motion, std::span<const double> old_motion, double increment) {
  Rate rate;
  if (increment <= 0.0) return rate;
  for (int c = 0; c < 6; ++c) rate.velocity[c] = (motion[c] - old_motion[c]) / increment;
  rate.slope = 1.0 / increment;
  return rate;
}

/// Implicit dynamics know the velocities themselves.
ConnectorGroup::Rate ConnectorGroup::rate(std::int32_t element, const Kinematics& now, const NodalMotion& motion,
                                          std::span<const double> old_motion) const {
  if (motion.velocity_slope <= 0.0) return mean_rate(now.motion, old_motion, motion.increment);
  Rate rate{.slope = motion.velocity_slope};
  const auto add = [&](const double* velocity, int column) {
    for (int c = 0; c < 6; ++c)
      for (int k = 0; k < 3; ++k) rate.velocity[c] += now.gradient[c][column + k] * velocity[k];
  };
  for (int end = 0; end < 2; ++end) {
    const auto node = 4 * std::ptrdiff_t{nodes(element)[end]};
    add(motion.velocity + node, 6 * end);
    if (freedoms_per_node_ == 6) add(motion.angular_velocity + node, 6 * end + 3);
  }
  return rate;
}

ConnectorGroup::Pull ConnectorGroup::pull(std::int32_t element, const Six& motion, const Rate& rate) const {
  Pull result;
  const auto stretched = stretch(element, motion);
  result.elastic = coupled(connector_.coupled_elasticity, stretched);
  const auto& velocity = rate.velocity;
  const auto viscous = coupled(connector_.coupled_damping, velocity);
  for (int c = 0; c < 6; ++c) {
    Six unit{};
    unit[c] = 1.0;
    const auto by_motion = coupled(connector_.coupled_elasticity, unit), by_velocity = coupled(connector_.coupled_damping, unit);
    for (int i = 0; i < 6; ++i) result.slope[i][c] = by_motion[i] + by_velocity[i] * rate.slope;
    if (elasticity_[c]) {
      const auto [force, slope] = elasticity_[c]->at(stretched[c]);
      result.elastic[c] += force;
      result.slope[c][c] += slope;
    }
    result.force[c] = result.elastic[c] + viscous[c];
    if (!damping_[c] || rate.slope <= 0.0) continue;
    const auto [force, slope] = damping_[c]->at(velocity[c]);
    result.force[c] += force;
    result.slope[c][c] += slope * rate.slope;
  }
  return result;
}

void ConnectorGroup::update(const Kinematics& now, const Pull& pulled, std::span<const double> old_history, std::span<double> new_history) const {
  double dissipated = old_history[dissipation_row];
  for (int c = 0; c < 6; ++c) {
    const double viscous = pulled.force[c] - pulled.elastic[c], before = old_history[force_row + c] - old_history[elastic_row + c];
    dissipated += 0.5 * (viscous + before) * (now.motion[c] - old_history[motion_row + c]);
    new_history[motion_row + c] = now.motion[c];
    new_history[force_row + c] = pulled.force[c];
    new_history[elastic_row + c] = pulled.elastic[c];
  }
  new_history[dissipation_row] = dissipated;
  new_history[reach_row] = old_history[reach_row];
}

void ConnectorGroup::initialize_history(std::span<double> history) const { std::ranges::fill(history, 0.0); }
void ConnectorGroup::lumped_volume(std::int32_t, std::span<double> volume) const { std::ranges::fill(volume, 0.0); }
void ConnectorGroup::lumped_rotary_inertia(std::int32_t, std::span<double> inertia) const { std::ranges::fill(inertia, 0.0); }
void ConnectorGroup::material_rotary_inertia(std::int32_t, std::span<double> tensors) const { std::ranges::fill(tensors, 0.0); }

StableIncrement ConnectorGroup::add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle, std::span<double> history) const {
  for (const auto& run : runs)
    for (std::int32_t element = run.first; element < std::min(run.last, size_); ++element)
      if (acts(element)) add_force(element, cycle, history);
  return {};  // no mass, no frequency: see restraint
}

void ConnectorGroup::add_force(std::int32_t element, const ExplicitCycle& cycle, std::span<double> history) const {
  std::array<double, 20> before{}, after{};
  gather_history(element, history, before);
  after = before;
  if (!pulls_) {
    const auto& relative = references_[element].relative;
    const auto measured = relative.at(places(element, cycle.motion));
    for (int c = 0; c < 6; ++c) after[motion_row + c] = relative.nearest(c, measured[c], before[motion_row + c]);
    return scatter_history(element, after, history);
  }
  const auto now = kinematics(element, cycle.motion, std::span(before).first(6));
  const auto pulled = pull(element, now.motion, mean_rate(now.motion, std::span(before).first(6), cycle.increment));
  update(now, pulled, before, after);
  scatter_history(element, after, history);
  for (int end = 0; end < 2; ++end) {
    const auto node = std::ptrdiff_t{nodes(element)[end]};
    for (int k = 0; k < freedoms_per_node_; ++k) {
      double value = 0.0;
      for (int c = 0; c < 6; ++c) value += pulled.force[c] * now.gradient[c][6 * end + k];
      double* const sum = (k < 3 ? cycle.forces.force : cycle.forces.moment) + 4 * node;
      sum[k % 3] -= rounded(value, sum[3]);
    }
  }
}

bool ConnectorGroup::linearize(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history,
                               std::span<double> new_history, std::span<double> force, std::span<double> stiffness) const {
  const auto now = kinematics(element, motion, old_history.first(6));
  const auto pulled = pull(element, now.motion, rate(element, now, motion, old_history.first(6)));
  update(now, pulled, old_history, new_history);
  const int size = 2 * freedoms_per_node_;
  const auto column = [&](int k) { return 6 * (k / freedoms_per_node_) + k % freedoms_per_node_; };
  std::ranges::fill(force, 0.0);
  for (int k = 0; k < size; ++k)
    for (int c = 0; c < 6; ++c) force[k] += pulled.force[c] * now.gradient[c][column(k)];
  if (stiffness.empty()) return true;
  std::ranges::fill(stiffness, 0.0);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j)
      for (int a = 0; a < 6; ++a)
        for (int b = 0; b < 6; ++b)
          stiffness[size * i + j] += now.gradient[a][column(i)] * pulled.slope[a][b] * now.gradient[b][column(j)];
  add_curvature(element, motion, pulled.force, stiffness);
  return true;
}

ElementEnergies ConnectorGroup::energies(std::int32_t element, const NodalMotion&, std::span<const double> history) const {
  ElementEnergies result;
  Six motion{};
  std::copy_n(&history[motion_row], 6, motion.begin());
  const auto stretched = stretch(element, motion), force = coupled(connector_.coupled_elasticity, stretched);
  for (int c = 0; c < 6; ++c) {
    result.strain += 0.5 * force[c] * stretched[c];
    if (elasticity_[c]) result.strain += elasticity_[c]->integral(stretched[c]);
  }
  result.viscous = history[dissipation_row];
  return result;
}

namespace {

/// Bound of the largest eigenvalue of the part of a coupled matrix that begins at `first`: its trace.
double trace(const std::vector<double>& matrix, int first) {
  double sum = 0.0;
  for (int j = first; j < first + 3 && !matrix.empty(); ++j) sum += std::abs(matrix[j * (j + 1) / 2 + j]);
  return sum;
}

}  // namespace

/// Of components first to first + 2.
Restraint ConnectorGroup::bound(std::int32_t element, int first) const {
  Restraint result{.stiffness = trace(connector_.coupled_elasticity, first), .viscosity = trace(connector_.coupled_damping, first)};
  double stiffest = 0.0, most_viscous = 0.0;
  for (int c = first; c < first + 3; ++c) {
    const auto& elastic = elasticity_[c];
    const auto& viscous = damping_[c];
    if (elastic) {
      const bool axial = c < 3 && connector_.translation == Connector::Translation::axial;
      stiffest = std::max({stiffest, elastic->steepest(), axial ? elastic->tautness(references_[element].relative.length()) : 0.0});
      result.force = std::max(result.force, elastic->largest_force());
    }
    if (viscous) {
      most_viscous = std::max(most_viscous, viscous->steepest());
      result.force = std::max(result.force, viscous->largest_force());
    }
  }
  result.stiffness += stiffest;
  result.viscosity += most_viscous;
  return result;
}

Restraint ConnectorGroup::restraint(std::int32_t element) const { return bound(element, 0); }

/// Bound of the arm with which a force along an axis of the first node turns that node: what is held beside the axis stays where it was.
double ConnectorGroup::arm(std::int32_t element, int component) const {
  if (connector_.translation != Connector::Translation::cartesian) return 0.0;
  const auto& relative = references_[element].relative;
  double square = 0.0;
  for (int c = 0; c < 3; ++c) {
    if (c == component) continue;
    if (connector_.available[c]) return reach_.empty() ? relative.length() : reach_[element];
    square += relative.position_at_start(c) * relative.position_at_start(c);
  }
  return std::sqrt(square);
}

/// Forces on the second node turn the first one by their arms.
Restraint ConnectorGroup::rotary_restraint(std::int32_t element) const {
  if (!turns()) return {};
  auto result = bound(element, 3);
  const auto pulled = bound(element, 0);
  const bool is_coupled = !connector_.coupled_elasticity.empty() || !connector_.coupled_damping.empty();
  double longest = 0.0;
  for (int c = 0; c < 3; ++c)
    if (elasticity_[c] || damping_[c] || is_coupled) longest = std::max(longest, arm(element, c));
  result.stiffness += pulled.stiffness * longest * longest;
  result.viscosity += pulled.viscosity * longest * longest;
  result.force += pulled.force * longest;
  return result;
}

/// Whether some force has an arm that a free motion lengthens.
bool ConnectorGroup::has_growing_arm() const {
  if (!pulls_ || connector_.translation != Connector::Translation::cartesian) return false;
  return std::count(connector_.available.begin(), connector_.available.begin() + 3, true) > 1;
}

double ConnectorGroup::distance(std::int32_t element, const NodalMotion& motion) const {
  const double* const a = motion.position + 4 * std::ptrdiff_t{nodes(element)[0]};
  const double* const b = motion.position + 4 * std::ptrdiff_t{nodes(element)[1]};
  return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

/// A quarter more than the distance: what is thrown off by a model's size passes its reach some tens of times.
void ConnectorGroup::set_reach(const NodalMotion& motion, std::span<double> history) {
  if (!has_growing_arm()) return;
  reach_.resize(static_cast<std::size_t>(size_));
  std::array<double, 20> own{};
  for (std::int32_t element = 0; element < size_; ++element) {
    reach_[element] = 1.25 * distance(element, motion) + least_reach_;
    gather_history(element, history, own);
    own[reach_row] = reach_[element];
    scatter_history(element, own, history);
  }
}

void ConnectorGroup::restore_reach(std::span<const double> history) {
  if (!has_growing_arm()) return;
  reach_.resize(static_cast<std::size_t>(size_));
  std::array<double, 20> own{};
  for (std::int32_t element = 0; element < size_; ++element) {
    gather_history(element, history, own);
    reach_[element] = own[reach_row];
  }
}

bool ConnectorGroup::is_beyond_reach(const NodalMotion& motion) const {
  for (std::int32_t element = 0; element < static_cast<std::int32_t>(reach_.size()); ++element)
    if (acts(element) && distance(element, motion) > reach_[element]) return true;
  return false;
}

int ConnectorGroup::point_components(std::string_view variable) const {
  static constexpr std::array<std::string_view, 8> variables{"CTF", "CEF", "CVF", "CRF", "CSF", "CCF", "CU", "CP"};
  return std::ranges::count(variables, variable) > 0 ? 6 : 0;
}

/// Forces of what holds, rubs and loads a connector are multipliers of constraints, which Analysis adds.
void ConnectorGroup::point_output(std::string_view variable, std::int32_t element, int, const NodalMotion&, std::span<const double> history,
                                  std::span<double> values) const {
  for (int c = 0; c < 6; ++c) {
    values[c] = 0.0;
    if (variable == "CP") values[c] = history[motion_row + c] + references_[element].relative.position_at_start(c);
    if (variable == "CU") values[c] = history[motion_row + c];
    if (variable == "CTF") values[c] = history[force_row + c];
    if (variable == "CEF") values[c] = history[elastic_row + c];
    if (variable == "CVF") values[c] = history[force_row + c] - history[elastic_row + c];
  }
}

namespace {

std::unique_ptr<ElementGroup> make_group(const GroupInput& input) { return std::make_unique<ConnectorGroup>(input); }

const RegisterElement connector({.name = "CONN3D2",
                                 .shape = Shape::line,
                                 .nodes = 2,
                                 .section = Section::Kind::connector,
                                 .faces = {},
                                 .cycle_cost = 1000,
                                 .make_group = make_group});

}  // namespace

}  // namespace balocco
