#include "implicit_prescribed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "model/diagnostics.hpp"
#include "step_driver.hpp"

namespace balocco {

namespace {

/// Abscissae and weights of Gauss's rule with four points on (0, 1): exact for polynomials of degree 7.
constexpr std::array<std::array<double, 2>, 4> gauss_points{{{0.06943184420297371, 0.17392742256872693},
                                                             {0.33000947820757187, 0.32607257743127307},
                                                             {0.66999052179242813, 0.32607257743127307},
                                                             {0.93056815579702629, 0.17392742256872693}}};

/// Times between which the amplitude is one polynomial (tabular, smooth step) or nearly so (periodic).
std::vector<double> smooth_pieces(const Amplitude& amplitude, double offset, double step_time) {
  std::vector<double> times{0.0, step_time};
  for (const auto& point : amplitude.points) times.push_back(point[0] - offset);
  if (amplitude.kind == Amplitude::Kind::periodic) {
    times.push_back(amplitude.start - offset);
    constexpr int pieces = 256;
    for (int i = 1; i < pieces; ++i) times.push_back(step_time * i / pieces);
  }
  std::erase_if(times, [&](double t) { return t < 0.0 || t > step_time; });
  std::ranges::sort(times);
  return times;
}

/// Integral of amplitude(s) * (t - s)^order over 0 < s < t, for order 0 (velocity) or 1 (acceleration).
double integral(const Model& model, std::int32_t amplitude, double step_time, double total_time, int order) {
  if (amplitude < 0) return order == 0 ? step_time : 0.5 * step_time * step_time;
  const auto& curve = model.amplitudes[amplitude];
  const double offset = curve.total_time ? total_time - step_time : 0.0;
  const auto times = smooth_pieces(curve, offset, step_time);
  double sum = 0.0;
  for (std::size_t i = 1; i < times.size(); ++i)
    for (const auto& [abscissa, weight] : gauss_points) {
      const double length = times[i] - times[i - 1], s = times[i - 1] + abscissa * length;
      sum += weight * length * curve.value(s + offset) * (order == 0 ? 1.0 : step_time - s);
    }
  return sum;
}

}  // namespace

MotionLaw motion_law(const Model& model, const Step& step, const BoundaryCondition& condition, double step_time,
                     double total_time) {
  using Kind = BoundaryCondition::Kind;
  if (condition.fixed) return {};
  if (condition.kind != Kind::displacement)
    return {1.0, condition.magnitude * integral(model, condition.amplitude, step_time, total_time,
                                                condition.kind == Kind::velocity ? 0 : 1)};
  if (has_arrived(model, condition)) return {};
  const double factor = amplitude_factor(model, step, condition.amplitude, step_time, total_time);
  return {condition.amplitude >= 0 ? 0.0 : 1.0 - factor, condition.magnitude * factor};
}

std::vector<PrescribedMotion> prescribed_motions(const Analysis& analysis, const Step& step) {
  std::map<std::int32_t, const BoundaryCondition*> conditions;  // by slot
  std::map<std::int32_t, std::int32_t> carrier;                 // by model row, the same on every rank
  for (std::size_t body = 0; body < analysis.current.rigid_bodies.size(); ++body)
    for (const auto& node : analysis.current.rigid_bodies[body].nodes)
      carrier[node.node] = static_cast<std::int32_t>(body);
  std::vector<bool> turns_with_body(static_cast<std::size_t>(analysis.model.nodes.size()));
  for (const auto& body : analysis.current.rigid_bodies)
    for (const auto& node : body.nodes) turns_with_body[node.node] = node.tie;
  const SlotLayout layout(analysis);
  std::vector<std::string> errors;
  for (const auto& condition : step.boundary) {
    const bool pinned_rotation = condition.dof >= 3 && !turns_with_body[condition.node];
    if (const auto entry = carrier.find(condition.node); entry != carrier.end() && !pinned_rotation) {
      if (!condition.propagated)
        errors.push_back(
            fmt::format("{}: error: *BOUNDARY: node {} is carried by rigid body {}; prescribe the motion of its "
                        "reference node instead, or release the node",
                        analysis.model.where({condition.file, condition.line}), analysis.model.nodes.id[condition.node],
                        analysis.model.rigid_bodies[entry->second].name));
      continue;
    }
    const auto node = analysis.domain.local_node[condition.node];
    if (node < 0) continue;
    const auto body = analysis.reference_of(node);
    if (condition.dof >= 3 && body >= 0)
      conditions[layout.rotation_slot(body, condition.dof - 3)] = &condition;
    else if (condition.dof < 3 || node < layout.turning)
      conditions[layout.slot(node, condition.dof)] = &condition;
  }
  if (!errors.empty()) throw InputError(std::move(errors));
  std::vector<PrescribedMotion> motions;
  for (const auto& [slot, condition] : conditions) motions.push_back({slot, condition, 0.0});
  return motions;
}

std::vector<std::int32_t> slots_of(const std::vector<PrescribedMotion>& motions) {
  std::vector<std::int32_t> slots;
  for (const auto& motion : motions) slots.push_back(motion.slot);
  return slots;
}

void show_reactions(Analysis& analysis, const ImplicitDofMap& map, std::span<const double> residual) {
  std::ranges::fill(analysis.reaction, 0.0);
  std::ranges::fill(analysis.acceleration, 0.0);
  std::ranges::fill(analysis.reaction_moment, 0.0);
  std::ranges::fill(analysis.angular_acceleration, 0.0);
  std::ranges::fill(analysis.body_angular_acceleration, Point{});
  std::ranges::fill(analysis.body_reaction, std::array<double, 6>{});
  for (std::int32_t slot = 0; slot < map.first_multiplier(); ++slot) {
    if (map.role(slot) != ImplicitDofMap::Role::prescribed) continue;
    const auto node = map.node_of(slot);
    const auto body = analysis.reference_of(node);
    for (int i = 0; i < 3; ++i) {
      const double component = map.directions(node)(slot % 3, i) * residual[slot];
      if (!map.is_rotation(slot)) analysis.reaction[4 * node + i] += component;
      if (map.is_rotation(slot) && body < 0) analysis.reaction_moment[4 * node + i] += component;
      if (body >= 0) analysis.body_reaction[body][map.is_rotation(slot) ? 3 + i : i] += component;
    }
  }
}

}  // namespace balocco
