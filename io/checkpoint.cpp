#include "checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <utility>

#include "checkpoint_file.hpp"
#include "elements/element_type.hpp"
#include "hdf5_file.hpp"
#include "hdf5_rows.hpp"
#include "model/diagnostics.hpp"
#include "model_digest.hpp"
#include "model_identity.hpp"
#include "state_packing.hpp"

namespace balocco {

namespace {

constexpr std::int64_t checkpoint_version = 11;

ParallelFile::Layout plain_layout(int columns) {
  return {{static_cast<hsize_t>(columns)}, ParallelFile::Precision::double_, false};
}

std::string restraints_path(const std::string& element_type) { return "restraints_" + element_type; }

/// Whether a file has tables of a kind: then those of all types of its model.
bool has_tables(const Hdf5File& file, const Model& model, std::string (*path)(const std::string&)) {
  return std::ranges::any_of(model.elements, [&](const auto& table) { return file.exists("/" + path(table.type->name)); });
}

/// Tables that only some files have.
struct OptionalTables {
  bool mass_scales = false, restraints = false;
};

/// Doubles of history that any element of the table has on any rank.
int history_columns(const TableRows& rows, const Communicator& communicator) {
  int columns = 0;
  for (const ElementGroup* group : rows.groups) columns = std::max(columns, group->history_size());
  return static_cast<int>(communicator.maximum(columns));
}

/// Upper bound of the size of a checkpoint.
std::size_t checkpoint_bytes(const Model& model, const Communicator& communicator, ElementGroups groups) {
  std::size_t values = static_cast<std::size_t>(model.nodes.size()) * (6 + work_values + rotation_values + alpha_values);
  for (const TableRows& rows : make_table_rows(model, communicator, groups)) {
    values += static_cast<std::size_t>(rows.exchange.total()) * history_columns(rows, communicator);
  }
  // Slave nodes of a pair and nodes of rigid bodies are at most all nodes each.
  values += static_cast<std::size_t>(model.nodes.size()) * (model.contact_pairs.size() * (contact_values + 1) + 5);
  values += 4 * static_cast<std::size_t>(model.nodes.size());  // identity
  for (const auto& table : model.elements) values += 6 * static_cast<std::size_t>(table.size());  // identity, mass scales, restraints
  return values * sizeof(double) + (1 << 20);
}

void write_state_tables(ParallelFile& file, const Model& model, const Communicator& communicator, const Domain& domain,
                  ElementGroups groups, const State& state) {
  const NodeRows nodes = make_node_rows(model, communicator, domain, Copies::owned);
  const auto write = [&](const std::string& name, const RowExchange& exchange, std::vector<double> values, int columns) {
    file.write(file.root(), name, exchange, exchange.to_slab(std::move(values), columns), plain_layout(columns));
  };
  write("position", nodes.exchange, vectors_of(state.position, nodes.nodes), 3);
  write("velocity", nodes.exchange, vectors_of(state.velocity, nodes.nodes), 3);
  if (communicator.any(domain.turning > 0))
    write("rotation", nodes.exchange, rotations_of(state, nodes.nodes), rotation_values);
  if (communicator.any(!state.alpha_memory.empty()))
    write("alpha_memory", nodes.exchange, alpha_memories_of(state, nodes.nodes), alpha_values);
  std::vector<double> work(nodes.nodes.size() * work_values, 0.0);
  for (std::size_t i = 0; i < nodes.nodes.size() && !state.nodal_work.empty(); ++i)
    std::ranges::copy(pack(state.nodal_work[nodes.nodes[i]]), work.begin() + static_cast<std::ptrdiff_t>(i * work_values));
  write("work", nodes.exchange, std::move(work), work_values);
  const bool scaled = communicator.any(std::ranges::any_of(state.mass_scale, [](const auto& scale) { return !scale.empty(); }));
  const bool restrained = communicator.any(std::ranges::any_of(state.restrained, [](const auto& bounds) { return !bounds.empty(); }));
  for (const TableRows& rows : make_table_rows(model, communicator, groups)) {
    const auto& type = model.elements[rows.table].type->name;
    if (restrained) write(restraints_path(type), rows.exchange, restraints_of(rows, state), 2);
    if (scaled) write(mass_scale_path(type), rows.exchange, mass_scales_of(rows, state), 1);
    const int columns = history_columns(rows, communicator);
    if (columns > 0) write(history_path(type), rows.exchange, histories_of(rows, state, columns), columns);
  }
  for (std::int32_t pair = 0; pair < static_cast<std::int32_t>(model.contact_pairs.size()); ++pair) {
    const ContactRows rows = make_contact_rows(model, communicator, domain, pair, Copies::owned);
    std::vector<double> values;
    for (std::int32_t point : rows.points) {
      const auto packed = pack(state.contact[pair][point]);
      values.insert(values.end(), packed.begin(), packed.end());
    }
    write(fmt::format("contact_{}", pair), rows.exchange, std::move(values), contact_values);
  }
}

void write_bodies(const Hdf5File& file, const State& state) {
  std::vector<double> motions;
  for (std::size_t b = 0; b < state.rigid_bodies.size(); ++b) {
    const RigidBodyState& body = state.rigid_bodies[b];
    const auto motion = pack(body);
    motions.insert(motions.end(), motion.begin(), motion.end());
    std::vector<std::int32_t> nodes;
    std::vector<double> offsets;
    for (const RigidNode& node : body.nodes) {
      nodes.insert(nodes.end(), {node.node, node.tie ? 1 : 0});
      offsets.insert(offsets.end(), node.offset.begin(), node.offset.end());
    }
    file.write(fmt::format("/rigid_{}_nodes", b), {body.nodes.size(), 2}, nodes);
    file.write(fmt::format("/rigid_{}_offsets", b), {body.nodes.size(), 3}, offsets);
  }
  file.write("/rigid_bodies", {state.rigid_bodies.size(), body_values}, motions);
  std::vector<double> memories(6 * state.alpha_memory_of_bodies.size());
  for (std::size_t b = 0; b < state.alpha_memory_of_bodies.size(); ++b) pack(state.alpha_memory_of_bodies[b], memories.begin() + 6 * b);
  if (!memories.empty()) file.write("/alpha_memory_of_bodies", {state.alpha_memory_of_bodies.size(), 6}, memories);
}

/// What all ranks know together of constraints: those that hold one hold the same bits of it, the others zero.
struct ConstraintRows {
  std::vector<double> multipliers, guide_motions, locked, implied;  // implied: 1 where State::implied_rows names the row

  ConstraintRows(const Communicator& communicator, const State& state)
      : multipliers(state.multiplier), guide_motions(state.guide_motion), locked(state.guide_locked), implied(state.multiplier.size(), 0.0) {
    if (multipliers.empty()) return;
    for (const auto row : state.implied_rows) implied[row] = 1.0;
    for (auto* values : {&multipliers, &guide_motions}) share(communicator, *values);
    for (auto* values : {&locked, &implied}) communicator.maximum(std::span<double>(*values));
  }

 private:
  static void share(const Communicator& communicator, std::vector<double>& values) {
    std::vector<double> opposite(values.size());
    std::ranges::transform(values, opposite.begin(), std::negate<>());
    for (auto* each : {&values, &opposite}) communicator.maximum(std::span<double>(*each));
    for (std::size_t row = 0; row < values.size(); ++row)
      if (values[row] <= 0.0) values[row] = -opposite[row];
  }
};

void read_constraint_rows(const Hdf5File& file, State& state) {
  if (!file.exists("/multipliers")) return;
  state.multiplier = file.read("/multipliers");
  state.guide_motion = file.read("/guide_motions");
  state.guide_locked = file.read("/guide_locked");
  const auto implied = file.read("/implied_rows");
  state.implied_rows.clear();
  for (std::size_t row = 0; row < implied.size(); ++row)
    if (implied[row] != 0.0) state.implied_rows.push_back(static_cast<std::int32_t>(row));
}

/// What belongs to no table; the format's name comes last and makes the file valid.
void write_header(const std::string& path, const Model& model, const State& state, const ConstraintRows& rows,
                  bool step_finished) {
  Hdf5File file(path, Hdf5File::Mode::modify);
  write_bodies(file, state);
  if (!rows.multipliers.empty()) {
    file.write("/multipliers", {rows.multipliers.size(), 1}, rows.multipliers);
    file.write("/guide_motions", {rows.guide_motions.size(), 1}, rows.guide_motions);
    file.write("/guide_locked", {rows.locked.size(), 1}, rows.locked);
    file.write("/implied_rows", {rows.implied.size(), 1}, rows.implied);
  }
  write_identity(file, model);
  file.set_attribute("/", "format_version", checkpoint_version);
  file.set_attribute("/", "deck_sha256", model.deck_sha256);
  for (const auto& [part, digest] : model_digests(model)) file.set_attribute("/", "digest of " + part, digest);
  file.set_attribute("/", "total_time", state.total_time);
  file.set_attribute("/", "step", static_cast<std::int64_t>(state.step + (step_finished ? 1 : 0)));
  file.set_attribute("/", "step_time", step_finished ? 0.0 : state.step_time);
  file.set_attribute("/", "increment", step_finished ? std::int64_t{0} : state.increment);
  file.set_attribute("/", "dynamic", static_cast<std::int64_t>(state.dynamic));
  file.set_attribute("/", "time_increment", state.time_increment);
  file.set_attribute("/", "linear", static_cast<std::int64_t>(state.linear));
  file.set_attribute("/", "easy", static_cast<std::int64_t>(state.easy));
  file.set_attribute("/", "energy_at_start", state.energy_at_start);
  file.set_attribute("/", "largest_energy", state.largest_energy);
  file.set_attribute("/", "least_stable", state.least_stable);
  file.set_attribute("/", "restraint_omega_square", state.restraint_omega_square);
  file.set_attribute("/", "restraint_rate", state.restraint_rate);
  file.set_attribute("/", "restraint_increment", state.restraint_increment);
  if (const auto& read = model.restart_read; read && read->end_step) {
    file.set_attribute("/", ended_step, static_cast<std::int64_t>(read->step));
    file.set_attribute("/", duration_of_ended_step, model.steps[read->step - 1].duration());
  }
  file.set_attribute("/", "format", std::string("balocco checkpoint"));
  file.close();
}

void refuse_other_model(const Hdf5File& file, const std::string& path, const Model& model) {
  for (const auto& [part, digest] : model_digests(model)) {
    const std::string attribute = "digest of " + part;
    if (file.has_attribute("/", attribute) && file.text_attribute("/", attribute) == digest) continue;
    throw InputError(
        fmt::format("{}: error: checkpoint of another model than {}: its {} differ; go on from a job with the same model, "
                    "whose steps alone are others{}",
                    path, model.files.empty() ? model.name : model.files.front(), part,
                    part == "constraints" ? " (nodes at the ends of rigid arms are part of a rigid body where no step of a job holds, attaches or "
                                            "releases them: let both jobs do so, or neither)"
                                          : ""));
  }
}

/// Everything stands as at the start of a job, but for what the steps before have made of it.
void read_foreign_header(const Hdf5File& file, const std::string& path, const Model& model, State& state) {
  refuse_other_model(file, path, model);
  state.dynamic = file.integer_attribute("/", "dynamic") != 0;
  state.linear = file.integer_attribute("/", "linear") != 0;
  if (state.linear)
    throw InputError(fmt::format("{}: error: its steps are geometrically linear, so that it is no state to go on from; give them NLGEOM", path));
}

/// Where the state stands in the steps of its job, and what their solvers remember.
void read_place(const Hdf5File& file, State& state) {
  state.total_time = file.number_attribute("/", "total_time");
  state.step = static_cast<std::int32_t>(file.integer_attribute("/", "step"));
  state.step_time = file.number_attribute("/", "step_time");
  state.increment = file.integer_attribute("/", "increment");
  state.dynamic = file.integer_attribute("/", "dynamic") != 0;
  state.time_increment = file.number_attribute("/", "time_increment");
  state.linear = file.integer_attribute("/", "linear") != 0;
  state.easy = file.integer_attribute("/", "easy") != 0;
  state.energy_at_start = file.number_attribute("/", "energy_at_start");
  state.largest_energy = file.number_attribute("/", "largest_energy");
  state.least_stable = file.number_attribute("/", "least_stable");
  state.restraint_omega_square = file.number_attribute("/", "restraint_omega_square");
  state.restraint_rate = file.number_attribute("/", "restraint_rate");
  state.restraint_increment = file.number_attribute("/", "restraint_increment");
}

void read_header(const Hdf5File& file, const std::string& path, const Model& model, State& state) {
  if (file.text_attribute("/", "deck_sha256") != model.deck_sha256) {
    throw InputError(fmt::format("{}: error: checkpoint of another deck than {}; restart with the deck as it was, or run "
                                 "without --restart",
                                 path, model.files.empty() ? model.name : model.files.front()));
  }
  read_place(file, state);
}

void read_header_of_other_deck(const Hdf5File& file, const std::string& path, const Model& model, State& state) {
  refuse_other_model(file, path, model);
  read_place(file, state);
}

void read_bodies(const Hdf5File& file, State& state) {
  const std::vector<double> motions = file.exists("/rigid_bodies") ? file.read("/rigid_bodies") : std::vector<double>{};
  state.rigid_bodies.resize(motions.size() / body_values);
  for (std::size_t b = 0; b < state.rigid_bodies.size(); ++b) {
    RigidBodyState& body = state.rigid_bodies[b] = unpack_body(motions.data() + b * body_values);
    if (!file.exists(fmt::format("/rigid_{}_nodes", b))) continue;  // a body that carries no nodes
    const auto nodes = file.read_integers(fmt::format("/rigid_{}_nodes", b));
    const auto offsets = file.read(fmt::format("/rigid_{}_offsets", b));
    for (std::size_t i = 0; i < nodes.size() / 2; ++i) {
      body.nodes.push_back({static_cast<std::int32_t>(nodes[2 * i]), nodes[2 * i + 1] != 0,
                            {offsets[3 * i], offsets[3 * i + 1], offsets[3 * i + 2]}});
    }
  }
}

void read_body_memories(const Hdf5File& file, State& state) {
  if (!file.exists("/alpha_memory_of_bodies")) return;
  const auto memories = file.read("/alpha_memory_of_bodies");
  state.alpha_memory_of_bodies.clear();
  for (std::size_t at = 0; at < memories.size(); at += 6) state.alpha_memory_of_bodies.push_back(unpack_alpha(&memories[at]));
}

void read_tables(ParallelFile& file, const Model& model, const Communicator& communicator, const Domain& domain,
                 ElementGroups groups, const OptionalTables& has, State& state) {
  const NodeRows nodes = make_node_rows(model, communicator, domain, Copies::all);
  const auto read = [&](const std::string& name, const RowExchange& exchange, int columns) {
    return exchange.from_slab(file.read(name, exchange, columns), columns);
  };
  const auto count = static_cast<std::size_t>(domain.size());
  set_vectors(nodes.nodes, read("position", nodes.exchange, 3), count, state.position);
  set_vectors(nodes.nodes, read("velocity", nodes.exchange, 3), count, state.velocity);
  if (communicator.any(domain.turning > 0)) set_rotations(nodes.nodes, read("rotation", nodes.exchange, rotation_values), state);
  const auto work = read("work", nodes.exchange, work_values);
  state.nodal_work.resize(std::max(state.nodal_work.size(), count));
  for (std::size_t i = 0; i < nodes.nodes.size(); ++i) state.nodal_work[nodes.nodes[i]] = unpack_work(&work[i * work_values]);
  state.element_history.resize(groups.size());
  state.mass_scale.resize(groups.size());
  state.restrained.assign(groups.size(), {});
  for (const TableRows& rows : make_table_rows(model, communicator, groups)) {
    const auto& type = model.elements[rows.table].type->name;
    if (has.restraints) set_restraints(rows, read(restraints_path(type), rows.exchange, 2), state);
    if (has.mass_scales) set_mass_scales(rows, read(mass_scale_path(type), rows.exchange, 1), state);
    const int columns = history_columns(rows, communicator);
    if (columns > 0) set_histories(rows, read(history_path(type), rows.exchange, columns), columns, state);
  }
  state.contact.resize(model.contact_pairs.size());
  for (std::int32_t pair = 0; pair < static_cast<std::int32_t>(model.contact_pairs.size()); ++pair) {
    const ContactRows rows = make_contact_rows(model, communicator, domain, pair, Copies::all);
    const auto values = read(fmt::format("contact_{}", pair), rows.exchange, contact_values);
    state.contact[pair].resize(rows.points.size());
    for (std::size_t i = 0; i < rows.points.size(); ++i) {
      state.contact[pair][rows.points[i]] = unpack_contact(values.data() + i * contact_values);
    }
  }
}

/// `header`: which of the functions above reads what belongs to no table.
void read_all(const std::string& path, const Model& model, const Communicator& communicator, const Domain& domain, ElementGroups groups,
              State& state, void (*header)(const Hdf5File&, const std::string&, const Model&, State&)) {
  bool has_alpha_memory = false;
  OptionalTables has;
  communicator.together([&] {
    const auto file = open_checkpoint(path);
    header(*file, path, model, state);
    read_bodies(*file, state);
    read_body_memories(*file, state);
    has_alpha_memory = file->exists("/alpha_memory");
    has = {has_mass_scales(*file, model), has_tables(*file, model, restraints_path)};
    read_constraint_rows(*file, state);
  });
  ParallelFile file(path, communicator, ParallelFile::Mode::read);
  read_tables(file, model, communicator, domain, groups, has, state);
  if (!has_alpha_memory) return;
  const NodeRows nodes = make_node_rows(model, communicator, domain, Copies::all);
  set_alpha_memories(nodes.nodes, nodes.exchange.from_slab(file.read("alpha_memory", nodes.exchange, alpha_values), alpha_values), domain, state);
}

}  // namespace

std::string mass_scale_path(const std::string& element_type) { return "mass_scale_" + element_type; }

bool has_mass_scales(const Hdf5File& file, const Model& model) { return has_tables(file, model, mass_scale_path); }

std::string history_path(const std::string& element_type) { return "history_" + element_type; }

std::unique_ptr<Hdf5File> open_checkpoint(const std::string& path) {
  if (!std::filesystem::exists(path))
    throw InputError(fmt::format("{}: error: no checkpoint to go on from; run without --restart or --import", path));
  auto file = open_existing(path);
  const std::string format = file->has_attribute("/", "format") ? file->text_attribute("/", "format") : "";
  if (format != "balocco checkpoint")
    throw InputError(fmt::format("{}: error: {}; restart from a whole JOB.ckpt.h5, or run without --restart", path,
                                 format == "balocco" ? "this is a results file, not a checkpoint"
                                                     : "not a checkpoint of Balocco, or one that was not finished"));
  if (file->integer_attribute("/", "format_version") != checkpoint_version)
    throw InputError(fmt::format("{}: error: checkpoint of another version of Balocco; restart with that version", path));
  return file;
}

void write_checkpoint(const std::string& path, const Model& model, const Communicator& communicator, const Domain& domain,
                      ElementGroups groups, const State& state, bool step_finished) {
  const std::string beside = path + ".tmp";
  const std::size_t bytes = checkpoint_bytes(model, communicator, groups);
  communicator.together([&] {
    if (communicator.is_root()) ensure_space(beside, bytes);
  });
  ParallelFile file(beside, communicator, ParallelFile::Mode::create);
  write_state_tables(file, model, communicator, domain, groups, state);
  file.close();
  const ConstraintRows rows(communicator, state);
  communicator.together([&] {
    if (!communicator.is_root()) return;
    write_header(beside, model, state, rows, step_finished);
    synchronize(beside);
    if (std::rename(beside.c_str(), path.c_str()) != 0) {
      throw SystemError(fmt::format("{}: checkpoint cannot be put in place: {}", path, std::strerror(errno)));
    }
    synchronize(path);
  });
}

void import_checkpoint(const std::string& path, const Model& model, const Communicator& communicator, const Domain& domain,
                       ElementGroups groups, State& state) {
  read_all(path, model, communicator, domain, groups, state, read_foreign_header);
  for (auto& scale : state.mass_scale) scale.clear();
}

void read_checkpoint_of_other_deck(const std::string& path, const Model& model, const Communicator& communicator,
                                   const Domain& domain, ElementGroups groups, State& state) {
  read_all(path, model, communicator, domain, groups, state, read_header_of_other_deck);
}

void read_checkpoint(const std::string& path, const Model& model, const Communicator& communicator, const Domain& domain,
                     ElementGroups groups, State& state) {
  read_all(path, model, communicator, domain, groups, state, read_header);
}

}  // namespace balocco
