// *EMBEDDED ELEMENT.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "constraints/host_solids.hpp"
#include "deck/builder.hpp"
#include "deck/register.hpp"
#include "elements/element_type.hpp"

namespace balocco::deck {

namespace {

/// The solids of HOST ELSET, or of the whole model without the embedded elements.
std::optional<std::vector<ElementRef>> hosts_of(Builder& builder, const Block& block, const std::vector<ElementRef>& embedded) {
  const Model& model = builder.model;
  std::vector<ElementRef> hosts;
  if (block.has("HOST ELSET")) {
    if (!builder.elements_of(block.value("HOST ELSET"), block, block.location, hosts)) return std::nullopt;
  } else {
    for (std::size_t table = 0; table < model.elements.size(); ++table)
      for (std::int32_t row = 0; row < model.elements[table].size(); ++row) hosts.push_back({static_cast<std::int32_t>(table), row});
    std::erase_if(hosts, [&](ElementRef host) { return std::ranges::binary_search(embedded, host) || !HostSolids::takes(*model.elements[host.table].type); });
  }
  for (const auto host : hosts)
    if (!HostSolids::takes(*model.elements[host.table].type)) {
      builder.error(block, block.location,
                    fmt::format("element {} of HOST ELSET={} is a {}; hosts are solids, so name a set of these", model.element_name(host),
                                block.value("HOST ELSET"), model.elements[host.table].type->name));
      return std::nullopt;
    }
  return hosts;
}

std::set<std::int32_t> nodes_of_elements(const Model& model, const std::vector<ElementRef>& elements) {
  std::set<std::int32_t> nodes;
  for (const auto element : elements) {
    const auto& table = model.elements[element.table];
    const auto first = table.connectivity.begin() + static_cast<std::ptrdiff_t>(element.row) * table.type->nodes;
    nodes.insert(first, first + table.type->nodes);
  }
  return nodes;
}

/// Nodes of the embedded elements move with the solids that they lie in; rotations stay free, as in Abaqus.
void read_embedded(Builder& builder, const Block& block) {
  Model& model = builder.model;
  std::vector<ElementRef> embedded;
  for (const auto& line : block.lines) {
    Row row(builder, block, line);
    for (int field = 0; field < row.size(); ++field) {
      std::vector<ElementRef> elements;
      if (!row.has(field)) continue;
      if (!builder.elements_of(row.text(field), block, line.location, elements)) return;
      embedded.insert(embedded.end(), elements.begin(), elements.end());
    }
  }
  if (embedded.empty()) return builder.error(block, block.location, "what is embedded is not said; add lines with sets of elements");
  std::ranges::sort(embedded);
  const auto hosts = hosts_of(builder, block, embedded);
  if (!hosts) return;
  const auto nodes = nodes_of_elements(model, embedded), of_hosts = nodes_of_elements(model, *hosts);
  const HostSolids solids(model, *hosts);
  const double tolerance = block.has("ABSOLUTE EXTERIOR TOLERANCE") ? block.real("ABSOLUTE EXTERIOR TOLERANCE", 0.0)
                                                                    : block.real("EXTERIOR TOLERANCE", 0.05) * solids.mean_size();
  const std::int32_t* lost = nullptr;
  std::size_t missed = 0;
  for (const auto& node : nodes) {
    if (of_hosts.contains(node)) continue;  // it is a node of the host itself
    auto point = solids.at(model.nodes.coordinates[node], tolerance);
    if (!point) {
      lost = &node;
      ++missed;
      continue;
    }
    model.constraints.push_back({Tie{.node = node, .others = std::move(point->nodes), .weights = std::move(point->weights)}, "*EMBEDDED ELEMENT",
                                 block.location.file, block.location.line});
  }
  if (missed > 0)
    builder.error(block, block.location,
                  fmt::format("{} of {} nodes, node {} among them, lie in no host within {:.4g}; correct the mesh, or give a greater EXTERIOR TOLERANCE",
                              missed, nodes.size(), model.node_name(*lost), tolerance));
}

const RegisterKeyword embedded{{"EMBEDDED ELEMENT",
                                Phase::constraints,
                                Place::model,
                                {name("HOST ELSET"), real("EXTERIOR TOLERANCE"), real("ABSOLUTE EXTERIOR TOLERANCE"), foreign("ROUNDOFF TOLERANCE")},
                                read_embedded}};

}  // namespace

}  // namespace balocco::deck
