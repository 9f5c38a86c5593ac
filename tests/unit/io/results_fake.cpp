#include "results_fake.hpp"

#include <unistd.h>

#include <cmath>

namespace balocco::fake {

namespace {

const RegisterElement registered_brick({.name = "FAKE8",
                                        .shape = Shape::hexahedron,
                                        .nodes = 8,
                                        .integration_points = 2,
                                        .section = Section::Kind::solid,
                                        .faces = {{0, 3, 2, 1}, {4, 5, 6, 7}},
                                        .make_group = make<2>});
const RegisterElement registered_membrane({.name = "FAKE4",
                                           .shape = Shape::quadrilateral,
                                           .nodes = 4,
                                           .integration_points = 2,
                                           .section = Section::Kind::membrane,
                                           .faces = {{0, 1, 2, 3}, {0, 3, 2, 1}},
                                           .make_group = make<1>});

void add_mesh(Model& model, std::int32_t cells) {
  auto& nodes = model.nodes;
  for (std::int32_t i = 0; i <= cells; ++i) {
    for (const Point& corner : {Point{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}) {
      nodes.coordinates.push_back({static_cast<double>(i), corner[1], corner[2]});
    }
  }
  nodes.coordinates.push_back({0, 0, -5});  // reference node
  nodes.coordinates.push_back({9, 9, 9});   // loose
  nodes.location.resize(nodes.coordinates.size());
  for (std::size_t row = 0; row < nodes.coordinates.size(); ++row) {
    nodes.id.push_back(1000 + 2 * static_cast<std::int64_t>(row));
    nodes.row_of_id[nodes.id.back()] = static_cast<std::int32_t>(row);
  }
  ElementTable bricks, membranes;
  bricks.type = &brick();
  membranes.type = &membrane();
  for (std::int32_t i = 0; i < cells; ++i) {
    const std::int32_t a = 4 * i, b = 4 * (i + 1);
    bricks.id.push_back(10 + i);
    bricks.connectivity.insert(bricks.connectivity.end(), {a, b, b + 1, a + 1, a + 3, b + 3, b + 2, a + 2});
    bricks.section.push_back(i % 3 == 0 ? 1 : 0);
    membranes.id.push_back(50000 + i);
    membranes.connectivity.insert(membranes.connectivity.end(), {a, a + 1, b + 1, b});
    membranes.section.push_back(2);
  }
  bricks.location.resize(cells);
  membranes.location.resize(cells);
  model.elements = {membranes, bricks};
}

void add_steps(Model& model) {
  Step load;
  load.name = "LOAD";
  load.field_outputs.push_back({.frequency = 1, .node_variables = {"U"}, .element_variables = {"S"}});
  model.steps.push_back(load);

  Step roll;
  roll.procedure = ExplicitProcedure{.duration = 10.0, .fixed_increment = {}};
  roll.name = "ROLL";
  roll.field_outputs.push_back({.number_interval = 4, .node_variables = {"U", "RF"}, .element_variables = {"S", "STH"}});
  roll.field_outputs.push_back({.time_interval = 3.0,
                                .node_variables = {"V"},
                                .element_variables = {},
                                .integration_point_variables = {"S"},
                                .contact_variables = {"CPRESS"},
                                .single_precision = false});
  HistoryOutput history;
  history.time_interval = 0.5;
  history.nodes.push_back({.set = 0, .variables = {"U", "RF2"}});
  history.nodes.push_back({.set = 1, .variables = {"U"}});
  history.elements.push_back({.set = 0, .variables = {"S", "S12"}});
  history.energies = {"ALLKE", "ETOTAL"};
  history.contact_pairs = {0};
  roll.history_outputs.push_back(history);
  roll.checkpoint_number_interval = 5;
  model.steps.push_back(roll);
}

/// A number with all its bits in use, the same wherever it is computed.
double scramble(double value, std::int64_t row) { return 0.75 * value + std::sqrt(2.0 + static_cast<double>(row)) / 3.0; }

}  // namespace

const ElementType& brick() { return *find_element_type("FAKE8"); }
const ElementType& membrane() { return *find_element_type("FAKE4"); }

Model model(std::int32_t cells) {
  Model model;
  model.name = "row";
  model.heading = "bricks in a row";
  model.deck_sha256 = "0123abcd";
  model.units = {"mm", "g", "ms"};
  add_mesh(model, cells);
  const std::int32_t reference = 4 * (cells + 1);
  model.node_sets.push_back({"WATCHED", {0, 4 * cells + 2, reference}});
  model.element_sets.push_back({"PAIR", {{0, cells - 1}, {1, 0}}});
  model.node_sets.push_back({"HUB", {reference}});
  model.materials.push_back({.name = "RUBBER", .density = 1.0});
  model.sections = {{.kind = Section::Kind::solid, .element_set = "A", .material = 0},
                    {.kind = Section::Kind::solid, .element_set = "B", .material = 0},
                    {.kind = Section::Kind::membrane, .element_set = "SKIN", .material = 0}};
  Surface skin, road;
  skin.name = "SKIN";
  for (std::int32_t i = 0; i < cells; ++i) skin.faces.push_back({{0, i}, 1});
  road.name = "ROAD";
  road.kind = Surface::Kind::analytical;
  road.analytical = AnalyticalSurface{.kind = AnalyticalSurface::Kind::extruded, .origin = {0, 0, -5}};
  road.analytical->profile = {{.start = {-10, 0}, .end = {1, 0}},
                              {.kind = ProfileSegment::Kind::arc, .start = {1, 0}, .end = {2, 1}, .centre = {1, 1},
                               .counter_clockwise = true}};
  model.surfaces = {skin, road};
  model.rigid_bodies.push_back({.name = "RIGID-ROAD", .reference_node = reference, .analytical_surface = 1});
  model.interactions.push_back({.name = "I"});
  model.contact_pairs.push_back({.slave = 0, .master = 1, .interaction = 0});
  add_steps(model);
  return model;
}

Analysis::Analysis(const Model& the_model, const Communicator& the_communicator)
    : model(the_model), communicator(the_communicator), domain(make_domain(the_model, the_communicator)) {
  for (const GroupInput& input : domain.groups) {
    element_groups.push_back(model.elements[input.table].type->make_group(input));
  }
  current.position.assign(4 * (domain.size() + 1), 0.0);
  current.velocity = current.position;
  for (std::int32_t node = 0; node < domain.size(); ++node) {
    std::copy_n(model.nodes.coordinates[domain.node_row[node]].begin(), 3, current.position.begin() + 4 * node);
  }
  current.nodal_work.resize(domain.size());
  for (const auto& group : element_groups) {
    current.element_history.emplace_back(static_cast<std::size_t>(group->history_size()) * group->padded_size(), 0.0);
  }
  current.contact.emplace_back(local_slave_places(model, 0, domain).size());
  RigidBodyState road;
  road.position = {0, 0, -5};
  road.nodes.push_back({4, false, {0.5, 0.25, 0.125}});
  current.rigid_bodies.push_back(road);
}

void Analysis::increment(double time_increment) {
  for (std::int32_t node = 0; node < domain.size(); ++node) {
    const std::int64_t row = domain.node_row[node];
    for (int c = 0; c < 3; ++c) {
      double& velocity = current.velocity[4 * node + c];
      velocity = scramble(velocity, 3 * row + c);
      current.position[4 * node + c] += time_increment * velocity;
    }
    current.nodal_work[node].external = scramble(current.nodal_work[node].external, row);
    current.nodal_work[node].damping = scramble(current.nodal_work[node].damping, row + 7);
  }
  for (std::size_t g = 0; g < element_groups.size(); ++g) {
    const ElementGroup& group = *element_groups[g];
    for (int k = 0; k < group.history_size(); ++k) {
      for (std::int32_t lane = 0; lane < group.padded_size(); ++lane) {
        double& value = current.element_history[g][k * group.padded_size() + lane];
        value = scramble(value, 5 * group.row(lane) + k);
      }
    }
  }
  const auto slaves = local_slave_places(model, 0, domain);
  for (std::size_t i = 0; i < slaves.size(); ++i) {
    ContactPoint& point = current.contact[0][i];
    const std::int64_t row = domain.node_row[slaves[i].node];
    for (double* value : {&point.multiplier, &point.closed, &point.anchor[0], &point.anchor[1], &point.anchor[2], &point.slip,
                          &point.frictional_dissipation}) {
      *value = scramble(*value, row);
    }
  }
  RigidBodyState& road = current.rigid_bodies[0];
  for (Point* vector : {&road.position, &road.velocity, &road.angular_velocity, &road.rotation}) {
    for (double& value : *vector) value = scramble(value, 1);
  }
  road.orientation[2] = scramble(road.orientation[2], 3);
  current.time_increment = time_increment;
  current.step_time += time_increment;
  current.total_time += time_increment;
  ++current.increment;
}

bool Analysis::run(Observer& observer, std::int64_t last_increment) {
  for (; current.step < static_cast<std::int32_t>(model.steps.size()); ++current.step) {
    const Step& step = model.steps[current.step];
    const bool dynamic = !step.has_few_increments();
    current.dynamic |= dynamic;
    observer.step_started(*this, current.step);
    const double time_increment = dynamic ? 0.1 : 0.25;
    const auto count = static_cast<std::int64_t>(std::lround(step.duration() / time_increment));
    while (current.increment < count) {
      increment(time_increment);
      const bool finished = current.increment == count;
      if (!dynamic || finished || current.step_time >= observer.next_due()) {
        const Progress progress{.increment = current.increment, .step_time = current.step_time,
                                .total_time = current.total_time, .time_increment = time_increment,
                                .step_finished = finished};
        if (!observer.advanced(*this, progress)) return false;
      }
      if (dynamic && current.increment == last_increment) return true;
    }
    current.step_time = 0.0;
    current.increment = 0;
  }
  return true;
}

int Analysis::nodal_components(std::string_view variable) const {
  if (variable == "U" || variable == "V" || variable == "RF") return 3;
  return variable == "CPRESS" ? 1 : 0;
}

void Analysis::nodal(std::string_view variable, std::span<double> values) const {
  for (std::int32_t node = 0; node < domain.size(); ++node) {
    const std::int32_t row = domain.node_row[node];
    if (variable == "CPRESS") {
      values[node] = row + 0.5 * current.total_time;
      continue;
    }
    for (int c = 0; c < 3; ++c) {
      double value = current.velocity[4 * node + c];
      if (variable == "U") value = current.position[4 * node + c] - model.nodes.coordinates[row][c];
      if (variable == "RF") value = c == 0 ? -0.0 : 100.0 * row + c + current.step_time;
      values[3 * node + c] = value;
    }
  }
}

void Analysis::element(std::size_t group, std::string_view variable, std::int32_t element, int integration_point,
                       std::span<double> values) const {
  std::vector<double> history(element_groups[group]->history_size());
  element_groups[group]->gather_history(element, current.element_history[group], history);
  element_groups[group]->output(variable, element, integration_point, current.motion(), history, values);
}

EnergyBalance Analysis::energies() const {
  EnergyBalance energies;
  energies.kinetic = std::sqrt(2.0) * current.total_time;
  energies.total = -0.0;
  return energies;
}

ContactResultant Analysis::contact(std::int32_t) const {
  ContactResultant resultant;
  resultant.normal_force = {0, 0, current.total_time};
  resultant.area = 2.0 * current.total_time;
  return resultant;
}

namespace {

/// Named after root's process, for several programs may run at once.
std::filesystem::path parent_folder() {
  int process = ::getpid();
  MPI_Bcast(&process, 1, MPI_INT, 0, MPI_COMM_WORLD);
  return std::filesystem::temp_directory_path() / ("balocco_tests_" + std::to_string(process));
}

}  // namespace

std::string folder(const std::string& name) {
  const auto path = parent_folder() / name;
  const Communicator world;
  if (world.is_root()) std::filesystem::create_directories(path);
  MPI_Barrier(world.handle());
  return path.string();
}

void remove_folders() {
  const Communicator world;
  MPI_Barrier(world.handle());
  const auto path = parent_folder();
  if (world.is_root()) std::filesystem::remove_all(path);
}

}  // namespace balocco::fake
