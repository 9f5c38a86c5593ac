#include "builders/car/rail_sections.hpp"

#include <algorithm>
#include <limits>

namespace balocco::car {
namespace {

constexpr std::array rails{"FRONT_RAIL", "RAIL_EXTENSION", "REAR_RAIL"};

struct Range {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  void include(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

}  // namespace

std::vector<std::string> rail_section_names() {
  std::vector<std::string> names;
  for (const std::string rail : rails)
    for (const auto* side : {"_LEFT", "_RIGHT"}) names.push_back("SECTION_" + rail + side);
  return names;
}

void write_rail_section(const BodyMesh& mesh, const Part& part, std::int64_t first, DeckText& deck) {
  const auto rail = std::ranges::find_if(rails, [&](const char* name) { return part.gauge.starts_with(name); });
  if (rail == rails.end()) return;
  Range whole;
  for (int node = part.first_node; node < part.first_node + part.nodes; ++node) whole.include(mesh.nodes()[node][0]);
  const double middle = 0.5 * (whole.low + whole.high);
  std::vector<std::int64_t> cut;
  for (std::size_t element = 0; element < part.quadrilaterals.size(); ++element) {
    Range along;
    for (const int node : part.quadrilaterals[element]) along.include(mesh.nodes()[node][0]);
    if (along.low <= middle && middle < along.high) cut.push_back(first + static_cast<std::int64_t>(element));
  }
  deck.line("*ELSET, ELSET=SECTION_{}{}", *rail, part.name.substr(part.gauge.size()));
  deck.numbers(cut);
}

}  // namespace balocco::car
