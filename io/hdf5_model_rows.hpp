// Which rows of the model's tables this rank holds: nodes, elements by type, places of contact pairs.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "domain.hpp"
#include "elements/element_group.hpp"
#include "hdf5_rows.hpp"
#include "model/model.hpp"

namespace balocco {

using ElementGroups = std::span<const std::unique_ptr<ElementGroup>>;

/// `owned` for writing: every row has one holder. `all` for reading: every copy of a node wants its values.
enum class Copies { owned, all };

/// Local nodes that are held, with the exchange of their rows.
struct NodeRows {
  std::vector<std::int32_t> nodes;
  RowExchange exchange;
};

/// Elements of one table that are held, group by group, lanes in order.
struct TableRows {
  std::int32_t table = -1;
  std::vector<const ElementGroup*> groups;
  std::vector<std::size_t> group_index;  // of each of them among the rank's groups
  RowExchange exchange;
};

/// Points (positions in State::contact[pair]) that are held.
struct ContactRows {
  std::vector<std::int32_t> points;
  RowExchange exchange;
};

NodeRows make_node_rows(const Model& model, const Communicator& communicator, const Domain& domain, Copies copies);

/// One entry for each table whose elements have a kernel (not MASS, ROTARYI). Collective.
std::vector<TableRows> make_table_rows(const Model& model, const Communicator& communicator, ElementGroups groups);

ContactRows make_contact_rows(const Model& model, const Communicator& communicator, const Domain& domain, std::int32_t pair,
                              Copies copies);

}  // namespace balocco
