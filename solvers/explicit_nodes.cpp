#include "explicit_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <experimental/simd>

#include "explicit_scale.hpp"
#include "math/rotation.hpp"

namespace balocco {

namespace {

using Four = std::experimental::fixed_size_simd<double, 4>;

Four at(const double* address) {
  return Four(address, std::experimental::element_aligned);
}
void put(const Four& value, double* address) {
  value.copy_to(address, std::experimental::element_aligned);
}

/// 1 for x, y, z and 0 for the fourth slot.
Four vector_part() {
  return Four([](auto lane) { return lane < 3 ? 1.0 : 0.0; });
}

}  // namespace

std::vector<NodeRun> find_runs(std::int32_t size, const std::function<bool(std::int32_t)>& chosen) {
  std::vector<NodeRun> runs;
  bool goes_on = false;
  for (std::int32_t node = 0; node < size; ++node) {
    const bool is_chosen = chosen(node);
    if (is_chosen && !goes_on) runs.push_back({static_cast<std::size_t>(node), 0});
    if (is_chosen) ++runs.back().count;
    goes_on = is_chosen;
  }
  return runs;
}

void clear_vectors(std::span<double> nodal) {
  for (std::size_t i = 0; i < nodal.size(); i += 4) nodal[i] = nodal[i + 1] = nodal[i + 2] = 0.0;
}

void clear_vectors(std::span<double> nodal, std::span<const std::int32_t> nodes) {
  for (const auto node : nodes) std::fill_n(&nodal[4 * static_cast<std::size_t>(node)], 3, 0.0);
}

void add_vectors(std::span<double> sum, std::span<const double> addend, std::span<const std::int32_t> nodes) {
  const Four part = vector_part();
  for (const auto node : nodes) {
    const std::size_t i = 4 * static_cast<std::size_t>(node);
    put(at(&sum[i]) + part * at(&addend[i]), &sum[i]);
  }
}

void add_mass_damping(std::span<double> force, std::span<double> damping_force, std::span<const double> coefficient,
                      std::span<const double> velocity) {
  for (std::size_t node = 0; node < coefficient.size(); ++node) {
    const Four damping = coefficient[node] * at(&velocity[4 * node]);  // the fourth slot of a velocity is zero
    put(damping, &damping_force[4 * node]);
    put(at(&force[4 * node]) - damping, &force[4 * node]);
  }
}

bool kick(std::span<double> velocity, std::span<const double> force, std::span<const double> inverse_mass,
          double increment) {
  const Four part = vector_part();
  Four::mask_type sound(true);
  for (std::size_t node = 0; node < inverse_mass.size(); ++node) {
    const Four f = part * at(&force[4 * node]);
    sound = sound && (std::experimental::abs(f) < Four(overflow_fraction * force[4 * node + 3]));  // false for NaN too
    put(at(&velocity[4 * node]) + (increment * inverse_mass[node]) * f, &velocity[4 * node]);
  }
  return std::experimental::all_of(sound);
}

void drift(std::span<double> position, std::span<const double> velocity, double increment) {
  for (std::size_t i = 0; i < position.size(); ++i) position[i] += increment * velocity[i];
}

bool kick_and_drift(const NodalPass& nodes, double average, double increment) {
  constexpr std::size_t block = 256;  // nodes whose position, velocity and force stay in L1
  bool sound = true;
  for (std::size_t first = 0; first < nodes.inverse_mass.size(); first += block) {
    const std::size_t count = std::min(block, nodes.inverse_mass.size() - first);
    const auto velocity = nodes.velocity.subspan(4 * first, 4 * count), force = nodes.force.subspan(4 * first, 4 * count);
    if (!kick(velocity, force, nodes.inverse_mass.subspan(first, count), average)) sound = false;
    drift(nodes.position.subspan(4 * first, 4 * count), velocity, increment);
    if (sound) clear_vectors(force);
  }
  return sound;
}

void drift_rotations(std::span<double> orientation, std::span<double> rotation, std::span<const double> angular_velocity,
                     double increment) {
  for (std::size_t i = 0; i < orientation.size(); i += 4) {
    const double* const spin = &angular_velocity[i];
    double* const q = &orientation[i];
    const Vector3<double> turn{{increment * spin[0], increment * spin[1], increment * spin[2]}};
    const auto now = turned(Quaternion<double>{q[0], q[1], q[2], q[3]}, turn);
    for (int c = 0; c < 4; ++c) q[c] = now[c];
    for (int c = 0; c < 3; ++c) rotation[i + c] += turn[c];
  }
}

bool has_outgrown(const double* force) {
  const double limit = overflow_fraction * force[3];
  return !(std::abs(force[0]) < limit && std::abs(force[1]) < limit && std::abs(force[2]) < limit);
}

}  // namespace balocco
