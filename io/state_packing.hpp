// State as rows of doubles, as checkpoints keep it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hdf5_model_rows.hpp"
#include "model/state.hpp"

namespace balocco {

/// Position 3, orientation 4, velocity 3, angular velocity 3, rotation 3.
constexpr int body_values = 16;
/// Multiplier, closed, anchor 3, slip, frictional dissipation, stiff spring, its force, friction 3, implicit spring.
constexpr int contact_values = 13;
/// External, damping, friction, mass scaling.
constexpr int work_values = 4;
/// What nodes that turn have beside positions and velocities: orientation 4, angular velocity 3, rotation 3.
constexpr int rotation_values = 10;
/// What implicit dynamics remember of a node's displacement and of its rotation: acceleration 3 and force 3 each.
constexpr int alpha_values = 12;

std::array<double, work_values> pack(const NodalWork& work);
NodalWork unpack_work(const double* values);
std::array<double, contact_values> pack(const ContactPoint& point);
ContactPoint unpack_contact(const double* values);
std::array<double, body_values> pack(const RigidBodyState& body);  // without its nodes
RigidBodyState unpack_body(const double* values);

/// The first 3 of 4 values of the nodes held, and back; `count`: nodes of the rank.
std::vector<double> vectors_of(const std::vector<double>& nodal, const std::vector<std::int32_t>& nodes);
void set_vectors(const std::vector<std::int32_t>& nodes, std::span<const double> values, std::size_t count, std::vector<double>& nodal);

/// Those of the nodes that turn; the others have zeros.
std::vector<double> rotations_of(const State& state, const std::vector<std::int32_t>& nodes);
void set_rotations(const std::vector<std::int32_t>& nodes, std::span<const double> values, State& state);

/// Memories of the alpha method; a body's has 6 values.
template <class Value>
void pack(const AlphaMemory& memory, Value next) {
  next = std::ranges::copy(memory.acceleration, next).out;
  std::ranges::copy(memory.force, next);
}
AlphaMemory unpack_alpha(const double* values);
std::vector<double> alpha_memories_of(const State& state, const std::vector<std::int32_t>& nodes);
void set_alpha_memories(const std::vector<std::int32_t>& nodes, std::span<const double> values, const Domain& domain, State& state);

/// Mass scales of the elements held in a table: 1 where the state says nothing.
std::vector<double> mass_scales_of(const TableRows& rows, const State& state);
void set_mass_scales(const TableRows& rows, std::span<const double> values, State& state);

/// What restrains the elements held in a table: omega square and rate each, 0 where the state says nothing.
std::vector<double> restraints_of(const TableRows& rows, const State& state);
void set_restraints(const TableRows& rows, std::span<const double> values, State& state);

/// History of the elements held in a table, `columns` an element (shorter histories end in zeros).
std::vector<double> histories_of(const TableRows& rows, const State& state, int columns);
void set_histories(const TableRows& rows, std::span<const double> values, int columns, State& state);

}  // namespace balocco
