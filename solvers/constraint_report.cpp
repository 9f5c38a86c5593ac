#include "constraint_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/diagnostics.hpp"

namespace balocco {

namespace {

constexpr double largest_contradiction = 1e-6;  // gap relative to the model's size

std::size_t constraint_of(const Analysis& analysis, std::int32_t row) {
  const auto after = std::ranges::upper_bound(analysis.first_constraint_row, row);
  return static_cast<std::size_t>(after - analysis.first_constraint_row.begin()) - 1;
}

std::string where(const Analysis& analysis, std::size_t constraint) {
  const auto& definition = analysis.model.constraints[constraint];
  return analysis.model.where({definition.file, definition.line});
}

/// Where displacements are linear, so are the gaps: those of the reference and what its gradient makes of displacements and rotations.
void find_gaps(const Analysis& analysis, std::int32_t index, std::vector<double>& gaps) {
  const auto& constraint = *analysis.constraints[index];
  std::vector<NodePlace> places;
  analysis.find_places(index, places);
  gaps.assign(static_cast<std::size_t>(constraint.rows()), 0.0);
  if (!analysis.current.linear || constraint.is_linear()) return constraint.gaps(places, gaps);
  std::vector<double> motion;  // of the columns
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vector3<double> reference{analysis.model.nodes.coordinates[constraint.nodes()[i]]};
    const auto displacement = places[i].position - reference;
    motion.insert(motion.end(), displacement.component.begin(), displacement.component.end());
    motion.insert(motion.end(), places[i].turn.component.begin(), places[i].turn.component.end());
    places[i] = {.position = reference};
  }
  std::vector<double> gradient(gaps.size() * motion.size());
  constraint.gaps(places, gaps);
  constraint.gradient(places, gradient);
  for (std::size_t row = 0; row < gaps.size(); ++row)
    gaps[row] += std::inner_product(motion.begin(), motion.end(), gradient.begin() + static_cast<std::ptrdiff_t>(row * motion.size()), 0.0);
}

}  // namespace

std::vector<std::int32_t> of_all_ranks(const Analysis& analysis, std::span<const std::int32_t> rows) {
  std::vector<std::int8_t> known(analysis.current.multiplier.size(), 0);
  for (const auto row : rows) known[row] = 1;
  MPI_Allreduce(MPI_IN_PLACE, known.data(), static_cast<int>(known.size()), MPI_INT8_T, MPI_MAX, analysis.communicator.handle());
  std::vector<std::int32_t> all;
  for (std::size_t row = 0; row < known.size(); ++row)
    if (known[row] != 0) all.push_back(static_cast<std::int32_t>(row));
  return all;
}

void log_dependent_constraints(const Analysis& analysis, std::span<const std::int32_t> rows, Observer& observer) {
  constexpr int most_lines = 10;
  int lines = 0;
  for (std::size_t i = 0; i < rows.size();) {
    const auto constraint = constraint_of(analysis, rows[i]);
    const auto begin = i;
    while (i < rows.size() && constraint_of(analysis, rows[i]) == constraint) ++i;
    if (++lines > most_lines) continue;
    observer.log(fmt::format("  {}: note: {}: {} of its {} conditions {} from other constraints and boundary conditions", where(analysis, constraint),
                             analysis.model.constraints[constraint].keyword, i - begin, analysis.constraints[constraint]->rows(),
                             i - begin == 1 ? "follows" : "follow"));
  }
  if (lines > most_lines) observer.log(fmt::format("  and {} more constraints of the same kind", lines - most_lines));
}

void refuse_contradictions(const Analysis& analysis, std::span<const std::int32_t> rows, double model_size) {
  std::vector<double> gaps;
  analysis.communicator.together([&] {
    for (const auto row : rows) {
      const auto index = constraint_of(analysis, row);
      const auto& constraint = *analysis.constraints[index];
      if (!std::ranges::binary_search(analysis.local_constraints, static_cast<std::int32_t>(index))) continue;
      find_gaps(analysis, static_cast<std::int32_t>(index), gaps);
      const double gap = gaps[row - analysis.first_constraint_row[index]];
      const bool slack = constraint.is_one_sided() && gap < 0.0;
      if (slack || std::abs(gap) <= largest_contradiction * model_size) continue;
      throw AnalysisError(fmt::format(
          "{}: error: {}: cannot hold together with the other constraints and boundary conditions on its nodes (node {} and others): "
          "it is off by {:.3g}; remove one of them",
          where(analysis, index), analysis.model.constraints[index].keyword, analysis.model.node_name(constraint.nodes().front()),
          std::abs(gap)));
    }
  });
}

}  // namespace balocco
