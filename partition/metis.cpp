#include <metis.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "domain.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

std::vector<idx_t> as_metis(const std::vector<std::int64_t>& values) {
  for (const std::int64_t value : values)
    if (value > std::numeric_limits<idx_t>::max()) throw SystemError("the element graph is too large for this METIS");
  return {values.begin(), values.end()};
}

}  // namespace

std::vector<std::int32_t> metis_partition(const Graph& graph, int parts) {
  const std::size_t vertices = graph.weight.size();
  std::vector<std::int32_t> part(vertices, 0);
  if (parts == 1 || vertices == 0) return part;
  if (vertices <= static_cast<std::size_t>(parts)) {  // METIS wants more vertices than parts
    std::iota(part.begin(), part.end(), 0);
    return part;
  }
  auto first = as_metis(graph.first), neighbour = as_metis(graph.neighbour), weight = as_metis(graph.weight);
  std::array<idx_t, METIS_NOPTIONS> options{};
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  idx_t count = static_cast<idx_t>(vertices), constraints = 1, wanted = parts, cut = 0;
  std::vector<idx_t> result(vertices);
  // The METIS manual recommends recursive bisection for up to eight parts: better balance at small cost.
  const auto partition = parts <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int status = partition(&count, &constraints, first.data(), neighbour.data(), weight.data(), nullptr, nullptr,
                               &wanted, nullptr, nullptr, options.data(), &cut, result.data());
  if (status != METIS_OK) throw SystemError("METIS could not partition the element graph");
  std::copy(result.begin(), result.end(), part.begin());
  return part;
}

}  // namespace balocco
