#include "state_packing.hpp"

#include <algorithm>

namespace balocco {

std::array<double, work_values> pack(const NodalWork& work) {
  return {work.external, work.damping, work.friction, work.mass_scaling};
}

NodalWork unpack_work(const double* v) { return {v[0], v[1], v[2], v[3]}; }

std::array<double, contact_values> pack(const ContactPoint& point) {
  return {point.multiplier, point.closed, point.anchor[0], point.anchor[1], point.anchor[2], point.slip,
          point.frictional_dissipation, point.stiff_spring, point.stiff_force, point.stiff_friction[0], point.stiff_friction[1],
          point.stiff_friction[2], point.implicit_spring};
}

ContactPoint unpack_contact(const double* v) { return {v[0], v[1], {v[2], v[3], v[4]}, v[5], v[6], v[7], v[8], {v[9], v[10], v[11]}, v[12]}; }

std::array<double, body_values> pack(const RigidBodyState& body) {
  std::array<double, body_values> values;
  auto next = std::copy(body.position.begin(), body.position.end(), values.begin());
  next = std::copy(body.orientation.begin(), body.orientation.end(), next);
  next = std::copy(body.velocity.begin(), body.velocity.end(), next);
  next = std::copy(body.angular_velocity.begin(), body.angular_velocity.end(), next);
  std::copy(body.rotation.begin(), body.rotation.end(), next);
  return values;
}

RigidBodyState unpack_body(const double* v) {
  RigidBodyState body;
  std::copy_n(v, 3, body.position.begin());
  std::copy_n(v + 3, 4, body.orientation.begin());
  std::copy_n(v + 7, 3, body.velocity.begin());
  std::copy_n(v + 10, 3, body.angular_velocity.begin());
  std::copy_n(v + 13, 3, body.rotation.begin());
  return body;
}

std::vector<double> vectors_of(const std::vector<double>& nodal, const std::vector<std::int32_t>& nodes) {
  std::vector<double> values(nodes.size() * 3, 0.0);
  for (std::size_t i = 0; i < nodes.size() && !nodal.empty(); ++i) {
    std::copy_n(nodal.begin() + static_cast<std::ptrdiff_t>(nodes[i]) * 4, 3, values.begin() + i * 3);
  }
  return values;
}

std::vector<double> rotations_of(const State& state, const std::vector<std::int32_t>& nodes) {
  std::vector<double> values(nodes.size() * rotation_values, 0.0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto at = static_cast<std::ptrdiff_t>(nodes[i]) * 4;
    if (at >= std::ssize(state.orientation)) continue;
    auto next = std::copy_n(state.orientation.begin() + at, 4, values.begin() + i * rotation_values);
    next = std::copy_n(state.angular_velocity.begin() + at, 3, next);
    std::copy_n(state.rotation.begin() + at, 3, next);
  }
  return values;
}

void set_rotations(const std::vector<std::int32_t>& nodes, std::span<const double> values, State& state) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto at = static_cast<std::ptrdiff_t>(nodes[i]) * 4;
    if (at >= std::ssize(state.orientation)) continue;
    const double* const own = values.data() + i * rotation_values;
    std::copy_n(own, 4, state.orientation.begin() + at);
    std::copy_n(own + 4, 3, state.angular_velocity.begin() + at);
    std::copy_n(own + 7, 3, state.rotation.begin() + at);
  }
}

AlphaMemory unpack_alpha(const double* v) { return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}}; }

std::vector<double> alpha_memories_of(const State& state, const std::vector<std::int32_t>& nodes) {
  std::vector<double> values(nodes.size() * alpha_values, 0.0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto node = static_cast<std::size_t>(nodes[i]);
    if (node < state.alpha_memory.size()) pack(state.alpha_memory[node], values.begin() + i * alpha_values);
    if (node < state.alpha_memory_of_spins.size()) pack(state.alpha_memory_of_spins[node], values.begin() + i * alpha_values + 6);
  }
  return values;
}

void set_alpha_memories(const std::vector<std::int32_t>& nodes, std::span<const double> values, const Domain& domain, State& state) {
  state.alpha_memory.resize(static_cast<std::size_t>(domain.size()));
  state.alpha_memory_of_spins.resize(static_cast<std::size_t>(domain.turning));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto node = static_cast<std::size_t>(nodes[i]);
    state.alpha_memory[node] = unpack_alpha(values.data() + i * alpha_values);
    if (nodes[i] < domain.turning) state.alpha_memory_of_spins[node] = unpack_alpha(values.data() + i * alpha_values + 6);
  }
}

std::vector<double> mass_scales_of(const TableRows& rows, const State& state) {
  std::vector<double> values;
  for (std::size_t g = 0; g < rows.groups.size(); ++g) {
    const auto& scale = state.mass_scale[rows.group_index[g]];
    values.insert(values.end(), scale.begin(), scale.end());
    if (scale.empty()) values.insert(values.end(), static_cast<std::size_t>(rows.groups[g]->size()), 1.0);
  }
  return values;
}

void set_mass_scales(const TableRows& rows, std::span<const double> values, State& state) {
  for (std::size_t g = 0; g < rows.groups.size(); ++g) {
    const auto size = static_cast<std::size_t>(rows.groups[g]->size());
    state.mass_scale[rows.group_index[g]].assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(size));
    values = values.subspan(size);
  }
}

std::vector<double> restraints_of(const TableRows& rows, const State& state) {
  std::vector<double> values;
  for (std::size_t g = 0; g < rows.groups.size(); ++g) {
    const auto& bounds = state.restrained[rows.group_index[g]];
    for (const auto& [omega_square, rate] : bounds) values.insert(values.end(), {omega_square, rate});
    if (bounds.empty()) values.insert(values.end(), 2 * static_cast<std::size_t>(rows.groups[g]->size()), 0.0);
  }
  return values;
}

void set_restraints(const TableRows& rows, std::span<const double> values, State& state) {
  for (std::size_t g = 0; g < rows.groups.size(); ++g) {
    auto& bounds = state.restrained[rows.group_index[g]];
    bounds.resize(static_cast<std::size_t>(rows.groups[g]->size()));
    for (auto& bound : bounds) {
      bound = {values[0], values[1]};
      values = values.subspan(2);
    }
  }
}

std::vector<double> histories_of(const TableRows& rows, const State& state, int columns) {
  std::vector<double> values(rows.exchange.held() * columns, 0.0);
  std::size_t first = 0;
  for (std::size_t g = 0; g < rows.groups.size(); ++g) {
    const ElementGroup& group = *rows.groups[g];
    const auto& history = state.element_history[rows.group_index[g]];
    for (int k = 0; k < group.history_size(); ++k) {
      for (std::int32_t e = 0; e < group.size(); ++e) {
        values[(first + e) * columns + k] = history[static_cast<std::size_t>(k) * group.padded_size() + e];
      }
    }
    first += group.size();
  }
  return values;
}

void set_histories(const TableRows& rows, std::span<const double> values, int columns, State& state) {
  std::size_t first = 0;
  for (std::size_t g = 0; g < rows.groups.size(); ++g) {
    const ElementGroup& group = *rows.groups[g];
    auto& history = state.element_history[rows.group_index[g]];
    history.resize(static_cast<std::size_t>(group.history_size()) * group.padded_size());
    for (int k = 0; k < group.history_size(); ++k) {
      for (std::int32_t lane = 0; lane < group.padded_size(); ++lane) {
        const std::int32_t e = std::min(lane, group.size() - 1);  // padded lanes repeat the last element
        history[static_cast<std::size_t>(k) * group.padded_size() + lane] = values[(first + e) * columns + k];
      }
    }
    first += group.size();
  }
}

void set_vectors(const std::vector<std::int32_t>& nodes, std::span<const double> values, std::size_t count, std::vector<double>& nodal) {
  nodal.resize(4 * (count + 1), 0.0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    std::copy_n(values.begin() + i * 3, 3, nodal.begin() + static_cast<std::ptrdiff_t>(nodes[i]) * 4);
  }
}

}  // namespace balocco
