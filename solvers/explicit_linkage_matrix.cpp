// How the gaps of a linkage change with its multipliers: the matrix, dense or sparse, its factors and corrections by them.
#include <algorithm>
#include <type_traits>

#include "explicit_linkages.hpp"

namespace balocco {

namespace {

/// Calls `act` with the number of columns of a mover as a constant, so that what is read many times stays in registers.
template <class Act>
void with_size(int size, Act act) {
  size == 6 ? act(std::integral_constant<int, 6>()) : act(std::integral_constant<int, 3>());
}

template <int size>
std::array<Pack, size> packs(const Lanes* lanes) {
  std::array<Pack, size> result;
  for (int k = 0; k < size; ++k) result[k] = lanes[k].pack();
  return result;
}

/// answer = average * response * gradient.
template <int size>
void find_answer(const Matrix6& response, double average, const Lanes* gradient, Lanes* answer) {
  const auto g = packs<size>(gradient);
  for (int a = 0; a < size; ++a) {
    Pack sum = response(a, 0) * g[0];
    for (int b = 1; b < size; ++b) sum += response(a, b) * g[b];
    answer[a].set(average * sum);
  }
}

/// block += answer^T gradient, as many rows as the member of the answer has.
template <int size>
void add_product(const Lanes* answer, const Lanes* gradient, int rows, BlockSolver::Block& block) {
  const auto g = packs<size>(gradient);
  for (int i = 0; i < rows; ++i) {
    Pack sum = block[i].pack();
    for (int k = 0; k < size; ++k) sum += answer[k][i] * g[k];
    block[i].set(sum);
  }
}

}  // namespace

void ExplicitLinkages::find_responses(const Analysis& analysis, System& system) const {
  for (auto& mover : system.movers) {
    if (mover.kind == Mover::Kind::body) mover.response = bodies_.response(analysis, static_cast<std::size_t>(mover.index));
    if (mover.kind == Mover::Kind::gyroscopic) {
      const auto response = gyroscopic_.response(analysis, mover.index);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) mover.response(i, j) = response(i, j);
    }
  }
}

void ExplicitLinkages::find_answers(System& system, double average) const {
  for (auto& member : system.members) {
    const Lanes* g = member.gradient.data();
    Lanes* answer = member.answer.data();
    for (const auto m : member.movers) {
      const auto& mover = system.movers[m];
      with_size(mover.size, [&](auto size) { find_answer<size>(mover.response, average, g, answer); });
      g += mover.size;
      answer += mover.size;
    }
  }
}

/// average G W G^T: how gaps change with multipliers. Where rows do not hold, their multipliers are given.
void ExplicitLinkages::find_matrix(System& system, double average) const {
  system.blocks.clear();
  for (const auto& member : system.members) {
    const auto rows = static_cast<int>(member.rows.size());
    for (const auto& [index, first, other_first, size, place] : member.shared) {
      const Lanes* const answer = &member.answer[first];
      const Lanes* const gradient = &system.members[index].gradient[other_first];
      auto& block = system.blocks.block(place);
      with_size(size, [&](auto constant) { add_product<constant>(answer, gradient, rows, block); });
    }
  }
  for (const auto& member : system.members)
    if (member.cloud) add_response_of_cloud(system, member, average);
  for (const auto& member : system.members)
    for (const auto& shared : member.shared) let_go(system, member, shared);
  if (system.hub >= 0) find_hub_blocks(system, average);
}

void ExplicitLinkages::add_response_of_cloud(System& system, const Member& member, double average) {
  const auto response = member.cloud->response(member.places.front().rotation);
  const auto number = static_cast<std::int32_t>(&member - system.members.data());
  auto& block = system.blocks.block(system.blocks.place(number, number));
  for (std::size_t i = 0; i < member.rows.size(); ++i)
    for (std::size_t j = 0; j < member.rows.size(); ++j)
      block[i][static_cast<int>(j)] += average * response(member.components[member.rows[i]], member.components[member.rows[j]]);
}

void ExplicitLinkages::let_go(System& system, const Member& member, const Shared& shared) {
  const auto& other = system.members[shared.member];
  if (!member.is_guide && !other.is_guide) return;
  auto& block = system.blocks.block(shared.block);
  for (int i = 0; i < static_cast<int>(member.rows.size()); ++i)
    for (int j = 0; j < static_cast<int>(other.rows.size()); ++j)
      if (!system.holds[member.first_row + i] || !system.holds[other.first_row + j])
        block[i][j] = &member == &other && i == j ? 1.0 : 0.0;
}

/// The hub's part of average G W G^T, with W = L D L^T, is what is left where y is eliminated from [ . G L ; L^T G^T  -1 / (average D) ].
void ExplicitLinkages::find_hub_blocks(System& system, double average) const {
  const auto [lower, diagonal] = factored(system.movers[system.hub].response);
  const auto hub = static_cast<std::int32_t>(system.members.size());
  for (const auto& member : system.members) {
    if (member.hub_column < 0) continue;
    const Lanes* const g = &member.gradient[static_cast<std::size_t>(member.hub_column)];
    auto& block = system.blocks.block(system.blocks.place(static_cast<std::int32_t>(&member - system.members.data()), hub));
    for (int i = 0; i < static_cast<int>(member.rows.size()); ++i)
      for (int a = 0; a < 6; ++a)
        for (int b = a; b < 6 && system.holds[member.first_row + i]; ++b) block[i][a] += g[b][i] * lower(b, a);
  }
  auto& block = system.blocks.block(system.blocks.place(hub, hub));
  for (int a = 0; a < 6; ++a) block[a][a] = diagonal[a] > 0.0 ? -1.0 / (average * diagonal[a]) : -1.0;
}

/// [ average G W G^T  G_0 ; G_0^T 0 ]: with the velocities of massless directions.
void ExplicitLinkages::list_entries(System& system) const {
  system.entries.clear();
  const auto hub = static_cast<std::int32_t>(system.members.size());
  const auto first_of = [&](std::int32_t block) { return block < hub ? system.members[block].first_row : system.unknowns; };
  const auto size_of = [&](std::int32_t block) { return block < hub ? static_cast<int>(system.members[block].rows.size()) : 6; };
  system.blocks.for_each([&](std::int32_t row, std::int32_t column, const BlockSolver::Block& block) {
    for (int i = 0; i < size_of(row); ++i)
      for (int j = row == column ? i : 0; j < size_of(column); ++j)
        system.entries.push_back({first_of(row) + i, first_of(column) + j, block[i][j]});
  });
  for (const auto& member : system.members)
    for (int i = 0; i < static_cast<int>(member.rows.size()); ++i) {
      const Lanes* g = member.gradient.data();
      for (const auto m : member.movers) {
        const auto& mover = system.movers[m];
        for (std::size_t k = 0; mover.first_unknown >= 0 && k < mover.directions.size(); ++k) {
          const double along = dot(Vector3<double>{g[0][i], g[1][i], g[2][i]}, Vector3<double>{mover.directions[k]});
          const bool holds = system.holds[member.first_row + i];
          system.entries.push_back({member.first_row + i, mover.first_unknown + static_cast<int>(k), holds ? along : 0.0});
        }
        g += mover.size;
      }
    }
}

bool ExplicitLinkages::factorizes(System& system, double average) const {
  find_answers(system, average);
  find_matrix(system, average);
  system.factorized_for = average;
  system.pivots = !system.is_definite();
  if (system.pivots) return factorizes_with_pivots(system);
  if (system.blocks.factorize()) return true;
  find_matrix(system, average);
  system.pivots = true;
  return factorizes_with_pivots(system);
}

bool ExplicitLinkages::factorizes_with_pivots(System& system) const {
  list_entries(system);
  if (!system.is_small()) return system.sparse_factors.factorize(system.entries, system.equations());
  const auto size = static_cast<std::size_t>(system.equations());
  system.matrix.assign(size * size, 0.0);
  for (const auto& [row, column, value] : system.entries)
    system.matrix[row * size + column] = system.matrix[column * size + row] = value;
  return system.pivoting_factors.factorize(system.matrix, size);
}

/// solution -= matrix^-1 residual.
void ExplicitLinkages::correct(System& system) const {
  std::fill(system.residual.begin() + system.unknowns, system.residual.end(), 0.0);
  if (!system.pivots)
    system.blocks.solve(system.residual);
  else if (system.is_small())
    system.pivoting_factors.solve(system.residual);
  else
    system.sparse_factors.solve(system.residual);
  for (std::size_t i = 0; i < system.solution.size(); ++i) system.solution[i] -= system.residual[i];
}

double ExplicitLinkages::mobility(const Analysis& analysis, std::int32_t node, bool rotation) {
  const auto kind = rotation ? Mover::Kind::rotation : Mover::Kind::translation;
  for (auto& system : systems_) {
    for (const auto& member : system.members)
      if (!rotation && member.cloud && member.cloud->has(node)) return member.cloud->inverse_mass(node);
    for (const auto& mover : system.movers) {
      if (mover.kind != kind || mover.index != node) continue;
      if (mover.first_unknown < 0) return mover.inverse_inertia;
      find_places(analysis, system);
      find_gradient(analysis, system);
      find_responses(analysis, system);
      const bool sound = factorizes(system, 1.0);  // else the start of the step tells
      double trace = 0.0;
      for (std::size_t k = 0; sound && k < mover.directions.size(); ++k) {
        std::ranges::fill(system.solution, 0.0);
        std::ranges::fill(system.residual, 0.0);
        system.residual[mover.first_unknown + k] = 1.0;
        correct(system);
        trace += std::abs(system.solution[mover.first_unknown + k]);
      }
      system.factorized_for = 0.0;
      return trace;
    }
  }
  return clusters_.mobility(node, rotation);
}

}  // namespace balocco
