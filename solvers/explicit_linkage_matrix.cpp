// How the gaps of a linkage change with its multipliers: the matrix, dense or sparse, its factors and corrections by them.
#include <algorithm>
#include <tuple>

#include "explicit_linkages.hpp"

namespace balocco {

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
    const std::size_t width = member.columns.size();
    for (std::size_t i = 0; i < member.rows.size(); ++i) {
      const double* g = &member.gradient[i * width];
      double* answer = &member.answer[i * width];
      for (const auto m : member.movers) {
        const auto& [response, size] = std::tie(system.movers[m].response, system.movers[m].size);
        for (int a = 0; a < size; ++a) {
          double sum = 0.0;
          for (int b = 0; b < size; ++b) sum += response(a, b) * g[b];
          answer[a] = average * sum;
        }
        g += size;
        answer += size;
      }
    }
  }
}

/// [ average G W G^T  G_0 ; G_0^T 0 ]: how gaps change with multipliers, and with the velocities of massless directions.
void ExplicitLinkages::find_matrix(System& system, double average) const {
  const auto unknowns = static_cast<std::size_t>(system.unknowns);
  const bool small = system.is_small();
  if (small) system.matrix.assign(unknowns * unknowns, 0.0);
  system.entries.clear();
  const auto add_to = [&](int i, int j, double value) {
    if (small) {
      system.matrix[i * unknowns + j] += value;
      if (i != j) system.matrix[j * unknowns + i] += value;
    } else {  // zeros too: the pattern stays
      system.entries.push_back({i, j, value});
    }
  };
  for (const auto& member : system.members)
    for (std::size_t i = 0; i < member.rows.size(); ++i) {
      const int row = member.first_row + static_cast<int>(i);
      const bool holds = system.holds[row];
      add_to(row, row, holds ? 0.0 : 1.0);  // where it does not, its multiplier is given
      for (const auto& [index, first, other_first, size] : member.shared) {
        const auto& other = system.members[index];
        const double* const answer = &member.answer[i * member.columns.size() + first];
        for (std::size_t j = &other == &member ? i : 0; j < other.rows.size(); ++j) {
          const double* const g = &other.gradient[j * other.columns.size() + other_first];
          const bool joined = holds && system.holds[other.first_row + j];
          double sum = 0.0;
          for (int k = 0; joined && k < size; ++k) sum += answer[k] * g[k];
          add_to(row, other.first_row + static_cast<int>(j), sum);
        }
      }
      const double* g = &member.gradient[i * member.columns.size()];
      for (const auto m : member.movers) {
        const auto& mover = system.movers[m];
        for (std::size_t k = 0; mover.first_unknown >= 0 && k < mover.directions.size(); ++k)
          add_to(row, mover.first_unknown + static_cast<int>(k), holds ? dot(Vector3<double>{g[0], g[1], g[2]}, Vector3<double>{mover.directions[k]}) : 0.0);
        g += mover.size;
      }
    }
}

/// The hub's part of average G W G^T, with W = L D L^T, is what is left where y is eliminated from [ . G L ; L^T G^T  -1 / (average D) ].
void ExplicitLinkages::find_hub_entries(System& system, double average) const {
  const auto [lower, diagonal] = factored(system.movers[system.hub].response);
  for (const auto& member : system.members)
    for (std::size_t i = 0; i < member.rows.size() && member.hub_column >= 0; ++i) {
      const double* const g = &member.gradient[i * member.columns.size() + static_cast<std::size_t>(member.hub_column)];
      const int row = member.first_row + static_cast<int>(i);
      for (int a = 0; a < 6; ++a) {
        double sum = 0.0;
        for (int b = a; b < 6 && system.holds[row]; ++b) sum += g[b] * lower(b, a);
        system.entries.push_back({row, system.unknowns + a, sum});
      }
    }
  for (int a = 0; a < 6; ++a)
    system.entries.push_back({system.unknowns + a, system.unknowns + a, diagonal[a] > 0.0 ? -1.0 / (average * diagonal[a]) : -1.0});
}

bool ExplicitLinkages::factorizes(System& system, double average) const {
  find_answers(system, average);
  find_matrix(system, average);
  if (system.hub >= 0) find_hub_entries(system, average);
  system.factorized_for = average;
  if (!system.is_small()) return system.sparse_factors.factorize(system.entries, static_cast<int>(system.residual.size()), system.is_definite());
  const auto unknowns = static_cast<std::size_t>(system.unknowns);
  return system.is_definite() ? system.factors.factorize(system.matrix, unknowns) : system.indefinite_factors.factorize(system.matrix, unknowns);
}

/// solution -= matrix^-1 residual.
void ExplicitLinkages::correct(System& system) const {
  std::fill(system.residual.begin() + system.unknowns, system.residual.end(), 0.0);
  if (!system.is_small())
    system.sparse_factors.solve(system.residual);
  else if (system.is_definite())
    system.factors.solve(system.residual);
  else
    system.indefinite_factors.solve(system.residual);
  for (std::size_t i = 0; i < system.solution.size(); ++i) system.solution[i] -= system.residual[i];
}

}  // namespace balocco
