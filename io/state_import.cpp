#include "state_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <unordered_map>

#include "checkpoint_file.hpp"
#include "constraints/constraint.hpp"
#include "constraints/rigid_body.hpp"
#include "elements/element_type.hpp"
#include "elements/slave_places.hpp"
#include "model/diagnostics.hpp"
#include "model_digest.hpp"
#include "model_identity.hpp"
#include "local_places.hpp"
#include "state_packing.hpp"

namespace balocco {

namespace {

class Importer {
 public:
  Importer(const std::string& path, const Model& model, const Communicator& communicator, const Domain& domain, ElementGroups groups,
           State& state)
      : path_(path), model_(model), import_(*model.state_import), communicator_(communicator), domain_(domain), groups_(groups), state_(state) {}

  std::string run() {
    communicator_.together([&] {
      file_ = open_checkpoint(path_);
      read_header();
      identity_.emplace(*file_);
      if (import_.update) return;  // the nodes have been compared before they were moved; constraints start anew
      ways_ = refuse_other_nodes(*identity_, path_, model_);
      refuse_other_elements(*identity_, path_, model_, ImportedSections::same);
      read_rows_of_constraints();
    });
    ParallelFile tables(path_, communicator_, ParallelFile::Mode::read);
    read_nodes(tables);
    if (!import_.update) {
      read_histories(tables);
      read_contact(tables);
    }
    place_bodies();
    if (import_.update) forget_motion();
    return fmt::format("Imported from {} (end of step {}): {} nodes, {} elements, {} of {} rigid bodies go on", path_, old_step_, import_.nodes.size(),
                       import_.elements.size(), bodies_that_go_on_, model_.rigid_bodies.size());
  }

 private:
  [[noreturn]] void refuse(const std::string& text) const { refuse_import(path_, model_, text); }
  bool is_imported(std::int32_t node_row) const { return std::ranges::binary_search(import_.nodes, node_row); }

  /// A node that a body is to carry from where it is now.
  struct Attachment {
    std::size_t body;
    RigidNode node;
  };

  void read_header();
  void read_rows_of_constraints();
  void read_nodes(ParallelFile& tables);
  void move_copies();
  void read_histories(ParallelFile& tables);
  void read_contact(ParallelFile& tables);
  void place_bodies();
  void forget_motion();
  std::vector<Attachment> go_on(std::int64_t old_body, std::size_t body, const RigidBodyState& motion);
  std::vector<std::int32_t> take_over_nodes(std::int64_t old_body, std::size_t body);
  void place_new_bodies(const std::vector<std::size_t>& bodies);
  std::vector<double> owners_values(const std::vector<std::int32_t>& rows, const std::vector<double>& nodal) const;

  const std::string& path_;
  const Model& model_;
  const StateImport& import_;
  const Communicator& communicator_;
  const Domain& domain_;
  ElementGroups groups_;
  State& state_;
  std::unique_ptr<Hdf5File> file_;
  std::optional<ModelIdentity> identity_;
  std::vector<Point> ways_;  // of copies, from there to here
  std::unordered_map<std::int64_t, std::int32_t> row_of_id_;  // of nodes, where bodies go on
  std::int64_t old_step_ = 0;
  std::size_t bodies_that_go_on_ = 0;
};

void Importer::read_header() {
  state_.dynamic = file_->integer_attribute("/", "dynamic") != 0;
  state_.linear = file_->integer_attribute("/", "linear") != 0;
  if (state_.linear) refuse("geometrically linear steps only, so that it is no state to go on from; give them NLGEOM");
  old_step_ = refuse_other_step(*file_, path_, model_);
}

void Importer::read_rows_of_constraints() {
  const auto constraints = make_constraints(model_);
  const auto read = [&](const char* name, std::vector<double>& values) {
    values.clear();
    const auto stored = file_->exists(name) ? file_->read(name) : std::vector<double>{};
    for (const auto& constraint : constraints) {
      const auto nodes = constraint->nodes();  // those of copies have other numbers there
      const bool of_copy = std::ranges::any_of(nodes, [&](std::int32_t node) { return import_.copy_of(node) != nullptr; });
      const auto first = of_copy ? -1 : identity_->constraint(digest_of_constraint(model_, *constraint));
      for (int row = 0; row < constraint->rows(); ++row) values.push_back(first < 0 ? 0.0 : stored[static_cast<std::size_t>(first + row)]);
    }
  };
  read("/multipliers", state_.multiplier);
  read("/guide_motions", state_.guide_motion);
  read("/guide_locked", state_.guide_locked);
}

void Importer::read_nodes(ParallelFile& tables) {
  std::vector<std::int32_t> nodes;
  std::vector<std::int64_t> rows;
  for (std::int32_t node = 0; node < domain_.size(); ++node) {
    if (!is_imported(domain_.node_row[node])) continue;
    nodes.push_back(node);
    rows.push_back(identity_->row_of_node(id_there(model_, domain_.node_row[node])));
  }
  const RowExchange exchange(communicator_, identity_->nodes(), std::move(rows));
  const auto read = [&](const char* name, int columns) { return exchange.from_slab(tables.read(name, exchange, columns), columns); };
  const auto count = static_cast<std::size_t>(domain_.size());
  set_vectors(nodes, read("position", 3), count, state_.position);
  move_copies();
  set_vectors(nodes, read("velocity", 3), count, state_.velocity);
  if (file_->exists("/rotation")) set_rotations(nodes, read("rotation", rotation_values), state_);
  const auto work = read("work", work_values);
  state_.nodal_work.resize(std::max(state_.nodal_work.size(), count));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    state_.nodal_work[nodes[i]] = unpack_work(&work[i * work_values]);
}

void Importer::move_copies() {
  for (std::size_t i = 0; i < import_.copies.size(); ++i)
    for (const auto row : import_.copies[i].nodes)
      if (const auto node = domain_.local_node[row]; node >= 0)
        for (std::size_t c = 0; c < 3; ++c) state_.position[4 * static_cast<std::size_t>(node) + c] += ways_[i][c];
}

/// Padded lanes repeat the last element of their group.
void Importer::read_histories(ParallelFile& tables) {
  for (std::int32_t table = 0; table < static_cast<std::int32_t>(model_.elements.size()); ++table) {
    const std::string type = model_.elements[table].type->name, path = history_path(type);
    if (!file_->exists("/" + path)) continue;
    const auto columns = static_cast<int>(file_->extent("/" + path)[1]);
    struct Lane {
      std::size_t group;
      std::int32_t element;
    };
    std::vector<Lane> lanes;
    std::vector<std::int64_t> rows;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      if (groups_[g]->table() != table) continue;
      for (std::int32_t e = 0; e < groups_[g]->size(); ++e) {
        const ElementRef element{table, groups_[g]->row(e)};
        if (!std::ranges::binary_search(import_.elements, element)) continue;
        lanes.push_back({g, e});
        rows.push_back(identity_->element(type, id_there(model_, element))->row);
      }
    }
    const RowExchange exchange(communicator_, identity_->elements(type), std::move(rows));
    const auto values = exchange.from_slab(tables.read(path, exchange, columns), columns);
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      const auto& group = *groups_[lanes[i].group];
      const auto last = lanes[i].element == group.size() - 1 ? group.padded_size() : lanes[i].element + 1;
      for (int k = 0; k < std::min(columns, group.history_size()); ++k)
        for (auto lane = lanes[i].element; lane < last; ++lane)
          state_.element_history[lanes[i].group][static_cast<std::size_t>(k) * group.padded_size() + lane] = values[i * columns + k];
    }
  }
}

void Importer::read_contact(ParallelFile& tables) {
  for (std::int32_t pair = 0; pair < static_cast<std::int32_t>(model_.contact_pairs.size()); ++pair) {
    const auto& surfaces = model_.contact_pairs[pair];
    const auto* const old = identity_->contact_pair(model_.surfaces[surfaces.slave].name, model_.surfaces[surfaces.master].name);
    if (old == nullptr) continue;
    const auto homes = homes_of_places(model_, surfaces);
    std::vector<std::size_t> which;  // of the places that are kept at the same node
    std::unordered_map<std::int32_t, std::size_t> count;
    for (const auto home : homes) which.push_back(count[home]++);
    std::vector<std::size_t> points;
    std::vector<std::int64_t> rows;
    const auto local = local_slave_places(model_, pair, domain_);
    for (std::size_t point = 0; point < local.size(); ++point) {
      const auto home = homes[local[point].row];
      const auto found = old->rows_of_home.find(id_there(model_, home));
      if (!is_imported(home) || found == old->rows_of_home.end()) continue;
      if (which[local[point].row] >= found->second.size()) continue;
      points.push_back(point);
      rows.push_back(found->second[which[local[point].row]]);
    }
    const RowExchange exchange(communicator_, old->places, std::move(rows));
    const auto values = exchange.from_slab(tables.read(fmt::format("contact_{}", old->index), exchange, contact_values), contact_values);
    for (std::size_t i = 0; i < points.size(); ++i) state_.contact[pair][points[i]] = unpack_contact(&values[i * contact_values]);
  }
}

/// 3 values a row, on all ranks.
std::vector<double> Importer::owners_values(const std::vector<std::int32_t>& rows, const std::vector<double>& nodal) const {
  std::vector<double> values(3 * rows.size(), 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto node = domain_.local_node[rows[i]];
    if (node >= 0 && domain_.owned[node] && 4 * static_cast<std::size_t>(node) < nodal.size()) std::copy_n(&nodal[4 * static_cast<std::size_t>(node)], 3, &values[3 * i]);
  }
  communicator_.sum(std::span<double>(values));
  return values;
}

/// Nodes that the old body carries, but for those that this deck gives to another one. @return the rows of those taken, sorted.
std::vector<std::int32_t> Importer::take_over_nodes(std::int64_t old_body, std::size_t body) {
  std::vector<std::int32_t> taken;
  const auto path = fmt::format("/rigid_{}_nodes", old_body);
  if (!file_->exists(path)) return taken;  // it carries none
  const auto nodes = file_->read_integers(path);
  const auto offsets = file_->read(fmt::format("/rigid_{}_offsets", old_body));
  auto& mine = state_.rigid_bodies[body].nodes;
  for (std::size_t i = 0; i < nodes.size() / 2; ++i) {
    const auto row = row_of_id_.find(identity_->node_id(nodes[2 * i]));
    if (row == row_of_id_.end()) continue;
    const auto carries = [&](const RigidBodyState& other) { return std::ranges::binary_search(other.nodes, row->second, {}, &RigidNode::node); };
    const auto carrier = std::ranges::find_if(state_.rigid_bodies, carries);
    if (carrier != state_.rigid_bodies.end() && carrier != state_.rigid_bodies.begin() + static_cast<std::ptrdiff_t>(body)) continue;
    const RigidNode node{row->second, nodes[2 * i + 1] != 0, {offsets[3 * i], offsets[3 * i + 1], offsets[3 * i + 2]}};
    const auto place = std::ranges::lower_bound(mine, node.node, {}, &RigidNode::node);
    if (place != mine.end() && place->node == node.node)
      *place = node;
    else
      mine.insert(place, node);
    taken.push_back(node.node);
  }
  std::ranges::sort(taken);
  return taken;
}

/// Nodes that the old body did not know keep their places.
std::vector<Importer::Attachment> Importer::go_on(std::int64_t old_body, std::size_t body, const RigidBodyState& motion) {
  const auto start = std::move(state_.rigid_bodies[body].nodes);
  state_.rigid_bodies[body] = motion;
  state_.rigid_bodies[body].nodes = start;
  const auto known = take_over_nodes(old_body, body);
  std::vector<Attachment> attachments;
  for (const auto& node : start)
    if (!std::ranges::binary_search(known, node.node)) attachments.push_back({body, node});
  return attachments;
}

void Importer::place_bodies() {
  const auto motions = file_->exists("/rigid_bodies") ? file_->read("/rigid_bodies") : std::vector<double>{};
  for (std::int32_t row = 0; row < model_.nodes.size() && !state_.rigid_bodies.empty(); ++row)
    row_of_id_.emplace(model_.nodes.id[row], row);
  std::vector<Attachment> attachments;
  std::vector<std::size_t> new_bodies;
  for (std::size_t b = 0; b < state_.rigid_bodies.size(); ++b) {
    const auto reference = model_.rigid_bodies[b].reference_node;
    const auto old = import_.copy_of(reference) != nullptr ? -1 : identity_->rigid_body(model_.nodes.id[reference]);
    if (old >= 0) {
      std::ranges::move(go_on(old, b, unpack_body(&motions[static_cast<std::size_t>(old) * body_values])), std::back_inserter(attachments));
      continue;
    }
    new_bodies.push_back(b);
    for (const auto& node : state_.rigid_bodies[b].nodes) attachments.push_back({b, node});
  }
  bodies_that_go_on_ = state_.rigid_bodies.size() - new_bodies.size();
  place_new_bodies(new_bodies);
  std::vector<std::int32_t> rows;
  for (const auto& attachment : attachments) rows.push_back(attachment.node.node);
  const auto positions = owners_values(rows, state_.position);
  for (std::size_t i = 0; i < attachments.size(); ++i) {
    const double* const x = &positions[3 * i];
    attach(state_.rigid_bodies[attachments[i].body], rows[i], attachments[i].node.tie, {x[0], x[1], x[2]});
  }
}

/// What has moved stands in its reference configuration: bodies carry their nodes from where these are, and no work is done yet.
void Importer::forget_motion() {
  for (std::size_t i = 0; i < state_.orientation.size(); ++i) state_.orientation[i] = i % 4 == 0 ? 1.0 : 0.0;
  std::ranges::fill(state_.rotation, 0.0);
  std::ranges::fill(state_.nodal_work, NodalWork{});
  for (auto& body : state_.rigid_bodies) {
    const auto turn = rotation_matrix(body);
    for (auto& node : body.nodes) node.offset = rigid_arm(turn, node);
    body.orientation = {1.0, 0.0, 0.0, 0.0};
    body.rotation = {};
  }
}

/// Where their reference nodes are, if these are imported.
void Importer::place_new_bodies(const std::vector<std::size_t>& bodies) {
  std::vector<std::int32_t> rows;
  for (const auto b : bodies) rows.push_back(model_.rigid_bodies[b].reference_node);
  const auto position = owners_values(rows, state_.position), velocity = owners_values(rows, state_.velocity),
             spin = owners_values(rows, state_.angular_velocity);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!is_imported(rows[i])) continue;
    auto& body = state_.rigid_bodies[bodies[i]];
    std::copy_n(&position[3 * i], 3, body.position.begin());
    std::copy_n(&velocity[3 * i], 3, body.velocity.begin());
    std::copy_n(&spin[3 * i], 3, body.angular_velocity.begin());
  }
}

}  // namespace

std::string import_state(const std::string& path, const Model& model, const Communicator& communicator, const Domain& domain,
                         ElementGroups groups, State& state) {
  return Importer(path, model, communicator, domain, groups, state).run();
}

}  // namespace balocco
