#include "hdf5_model_rows.hpp"

#include <algorithm>

#include "elements/element_type.hpp"
#include "elements/slave_places.hpp"
#include "local_places.hpp"

namespace balocco {

NodeRows make_node_rows(const Model& model, const Communicator& communicator, const Domain& domain, Copies copies) {
  std::vector<std::int32_t> nodes;
  std::vector<std::int64_t> rows;
  for (std::int32_t node = 0; node < domain.size(); ++node) {
    if (copies == Copies::owned && !domain.owned[node]) continue;
    nodes.push_back(node);
    rows.push_back(domain.node_row[node]);
  }
  return {std::move(nodes), RowExchange(communicator, model.nodes.size(), std::move(rows))};
}

std::vector<TableRows> make_table_rows(const Model& model, const Communicator& communicator, ElementGroups groups) {
  std::vector<TableRows> tables;
  for (std::int32_t table = 0; table < static_cast<std::int32_t>(model.elements.size()); ++table) {
    if (model.elements[table].type->make_group == nullptr) continue;
    std::vector<const ElementGroup*> mine;
    std::vector<std::size_t> index;
    std::vector<std::int64_t> rows;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (groups[g]->table() != table) continue;
      mine.push_back(groups[g].get());
      index.push_back(g);
      for (std::int32_t element = 0; element < groups[g]->size(); ++element) rows.push_back(groups[g]->row(element));
    }
    tables.push_back({table, std::move(mine), std::move(index),
                      RowExchange(communicator, model.elements[table].size(), std::move(rows))});
  }
  return tables;
}

ContactRows make_contact_rows(const Model& model, const Communicator& communicator, const Domain& domain, std::int32_t pair,
                              Copies copies) {
  const auto local = local_slave_places(model, pair, domain);
  std::vector<std::int32_t> points;
  std::vector<std::int64_t> rows;
  for (std::int32_t point = 0; point < static_cast<std::int32_t>(local.size()); ++point) {
    if (copies == Copies::owned && !domain.owned[local[point].node]) continue;
    points.push_back(point);
    rows.push_back(local[point].row);
  }
  const auto all = homes_of_places(model, model.contact_pairs[pair]).size();
  return {std::move(points), RowExchange(communicator, static_cast<std::int64_t>(all), std::move(rows))};
}

}  // namespace balocco
