#include "builders/tyre_steps.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "builders/rim_profile.hpp"
#include "builders/road_profile.hpp"

namespace balocco {
namespace {

constexpr std::int32_t every_dof = 6;
constexpr std::int32_t last_increment_only = 1000000;
enum StepRow { seat, inflate, contact, load };

std::int32_t node_set_row(const Model& model, const std::string& name) {
  const auto found = std::find_if(model.node_sets.begin(), model.node_sets.end(),
                                  [&](const NodeSet& set) { return set.name == name; });
  return static_cast<std::int32_t>(found - model.node_sets.begin());
}

const std::vector<std::int32_t>& nodes_of(const Model& model, const std::string& name) {
  return model.node_sets[node_set_row(model, name)].nodes;
}

BoundaryCondition held(std::int32_t node, std::int32_t dof, bool propagated) {
  BoundaryCondition condition;
  condition.node = node;
  condition.dof = dof;
  condition.propagated = propagated;
  return condition;
}

BoundaryCondition moved(std::int32_t node, std::int32_t dof, double magnitude) {
  auto condition = held(node, dof, false);
  condition.magnitude = magnitude;
  return condition;
}

/// Writes the steps in order; each lists everything that acts in it.
class StepAuthor {
 public:
  StepAuthor(const TyreSpec& spec, const TyreSection& section, const WheelAndRoad& rig, const TyreMesh& mesh,
             Model& model)
      : spec_(spec), section_(section), rig_(rig), mesh_(mesh), model_(model) {}

  void write_static_steps() { model_.steps = {seating(), inflation(), touching(), loading()}; }

  void write_rolling_steps() {
    const auto& rolling = spec_.rolling;
    if (rolling.settle_duration > 0.0)
      model_.steps.push_back(rolling_step("SETTLE", rolling.settle_duration, spec_.output.settle_frames, true));
    model_.steps.push_back(rolling_step("ROLL", rolling.duration, spec_.output.frames, rolling.settle_duration <= 0.0));
  }

 private:
  Step static_step(const std::string& name, double initial, double maximum) const {
    Step step;
    step.name = name;
    StaticProcedure procedure;
    procedure.initial_increment = initial;
    procedure.maximum_increment = maximum;
    procedure.nonlinear_geometry = true;
    procedure.maximum_increments = 200;
    step.procedure = procedure;
    step.field_outputs.push_back(field_output());
    step.field_outputs.back().frequency = last_increment_only;
    step.history_outputs.push_back(history_output());
    step.history_outputs.back().frequency = 1;
    return step;
  }

  FieldOutput field_output() const {
    FieldOutput output;
    output.node_variables = {"U", "V"};
    output.element_variables = {"S", "LE", "ELSE", "ELASE"};
    output.contact_variables = {"CPRESS", "CSHEAR"};
    return output;
  }

  HistoryOutput history_output() const {
    HistoryOutput output;
    output.nodes.push_back({node_set_row(model_, "HUB"), {"RF1", "RF2", "RF3", "RM2", "UR2", "VR2", "AR2"}});
    output.nodes.push_back({node_set_row(model_, "ROAD"), {"U1", "U3", "RF1", "RF3"}});
    output.nodes.push_back({node_set_row(model_, "CROWN_TOP"), {"U3"}});
    output.nodes.push_back({node_set_row(model_, "SIDE_LEFT"), {"U2"}});
    output.nodes.push_back({node_set_row(model_, "SIDE_RIGHT"), {"U2"}});
    output.energies = {"ALLKE", "ALLIE", "ALLSE", "ALLVD", "ALLAE", "ALLFD", "ALLCW", "ALLWK", "ETOTAL"};
    output.contact_pairs = {0};
    return output;
  }

  void hold(Step& step, std::int32_t node, bool propagated, std::int32_t free_dof = -1) const {
    for (std::int32_t dof = 0; dof < every_dof; ++dof)
      if (dof != free_dof) step.boundary.push_back(held(node, dof, propagated));
  }

  void press(Step& step, double pressure, double previous) const {
    if (pressure <= 0.0) return;
    SurfaceLoad load;
    load.surface = mesh_.liner_surface;
    load.magnitude = pressure;
    load.previous = previous;
    step.surface_loads.push_back(load);
  }

  /// The force that presses the road against the tyre.
  void lift(Step& step) const {
    ConcentratedLoad load;
    load.node = rig_.road;
    load.dof = 2;
    load.magnitude = spec_.statics.load;
    step.concentrated_loads.push_back(load);
  }

  /// The nodes on the rim move axially to the rim's width. Membranes alone have no stiffness out of their surface
  /// before they are stressed: a small pressure, or stabilization, carries them here.
  Step seating() const {
    auto step = static_step("SEAT", 0.25, 0.5);
    std::get<StaticProcedure>(step.procedure).stabilize = spec_.statics.stabilize;
    for (const auto& [name, side] : {std::pair{"BEAD_LEFT", 1.0}, std::pair{"BEAD_RIGHT", -1.0}}) {
      const auto& nodes = nodes_of(model_, name);
      for (const auto node : nodes) step.boundary.push_back(held(node, 0, false));
      for (const auto node : nodes) step.boundary.push_back(moved(node, 1, -side * section_.seat_shift));
      for (const auto node : nodes) step.boundary.push_back(held(node, 2, false));
    }
    hold(step, rig_.hub, false);
    hold(step, rig_.road, false);
    press(step, spec_.statics.seating_pressure, 0.0);
    return step;
  }

  Step inflation() const {
    auto step = static_step("INFLATE", 0.1, 0.25);
    RigidAttachment attachment;
    attachment.rigid_body = rig_.rim_body;
    for (const auto* name : {"BEAD_LEFT", "BEAD_RIGHT"}) {
      const auto& nodes = nodes_of(model_, name);
      attachment.nodes.insert(attachment.nodes.end(), nodes.begin(), nodes.end());
    }
    std::sort(attachment.nodes.begin(), attachment.nodes.end());
    step.attachments.push_back(attachment);
    hold(step, rig_.hub, true);
    hold(step, rig_.road, true);
    press(step, spec_.statics.pressure, spec_.statics.seating_pressure);
    return step;
  }

  /// The road rises to the tyre and presses on it; the next step sets it free, and what the road was held by fades as
  /// the load grows.
  Step touching() const {
    auto step = static_step("CONTACT", 0.2, 0.2);
    hold(step, rig_.hub, true);
    hold(step, rig_.road, true, 2);
    step.boundary.push_back(moved(rig_.road, 2, spec_.road.clearance + spec_.statics.contact_deflection));
    press(step, spec_.statics.pressure, spec_.statics.pressure);
    step.active_contact_pairs = {0};
    return step;
  }

  /// The wheel is free to spin from here on, held by friction alone, so that rolling starts from equilibrium.
  Step loading() const {
    auto step = static_step("LOAD", 0.25, 0.5);
    hold(step, rig_.hub, true, 4);
    hold(step, rig_.road, true, 2);
    press(step, spec_.statics.pressure, spec_.statics.pressure);
    lift(step);
    step.active_contact_pairs = {0};
    step.checkpoint_frequency = last_increment_only;
    return step;
  }

  Step rolling_step(const std::string& name, double duration, int frames, bool first) const {
    Step step;
    step.name = name;
    step.procedure = ExplicitProcedure{.duration = duration,
                                       .fixed_increment = {},
                                       .scale_factor = spec_.rolling.scale_factor,
                                       .linear_bulk_viscosity = spec_.rolling.linear_bulk_viscosity,
                                       .quadratic_bulk_viscosity = spec_.rolling.quadratic_bulk_viscosity};
    hold(step, rig_.hub, true, 4);
    for (std::int32_t dof = 0; dof < every_dof; ++dof) {
      auto condition = held(rig_.road, dof, dof > 0 && (dof != 2 || !first));
      if (dof == 0) {
        condition.kind = BoundaryCondition::Kind::velocity;
        condition.magnitude = -spec_.rolling.speed;
        condition.propagated = !first;
      }
      condition.fixed = dof == 2;  // the axle height of the static load stays
      step.boundary.push_back(condition);
    }
    press(step, spec_.statics.pressure, spec_.statics.pressure);
    step.active_contact_pairs = {0};
    if (mesh_.strike_surface >= 0) step.active_contact_pairs.push_back(1);
    step.field_outputs.push_back(field_output());
    step.field_outputs.back().number_interval = frames;
    step.history_outputs.push_back(history_output());
    step.history_outputs.back().time_interval = spec_.output.history_interval;
    if (spec_.output.checkpoints > 0) step.checkpoint_number_interval = spec_.output.checkpoints;
    return step;
  }

  const TyreSpec& spec_;
  const TyreSection& section_;
  const WheelAndRoad& rig_;
  const TyreMesh& mesh_;
  Model& model_;
};

void add_initial_velocities(const TyreSpec& spec, const TyreSection& section, const WheelAndRoad& rig, Model& model) {
  InitialVelocity spin;
  spin.kind = InitialVelocity::Kind::rotation;
  spin.nodes = nodes_of(model, "WHEEL");
  spin.angular_speed = spec.rolling.speed / rolling_radius(spec, section);
  spin.axis_direction = {0, 1, 0};
  InitialVelocity travel;
  travel.nodes = {rig.road};
  travel.dof = 0;
  travel.velocity = {-spec.rolling.speed, 0, 0};
  model.initial_velocities = {spin, travel};
}

void add_hub_inertia(const RimSpec& rim, std::int32_t hub, Model& model) {
  const auto add = [&](Section section, const char* type) {
    const auto row = static_cast<std::int32_t>(model.sections.size());
    const auto table = add_element_table(model, type);
    add_element_set(model, section.element_set, {{table, add_element(model, table, {hub}, row)}});
    model.sections.push_back(std::move(section));
  };
  Section mass;
  mass.kind = Section::Kind::mass;
  mass.element_set = "RIM_MASS";
  mass.mass = rim.mass;
  add(mass, "MASS");
  Section inertia;
  inertia.kind = Section::Kind::rotary_inertia;
  inertia.element_set = "RIM_INERTIA";
  inertia.inertia = {rim.transverse_inertia, rim.spin_inertia, rim.transverse_inertia, 0.0, 0.0, 0.0};
  add(inertia, "ROTARYI");
}

}  // namespace

double rolling_radius(const TyreSpec& spec, double outer_radius, double load) {
  return spec.rolling.rolling_radius.value_or(outer_radius - load / spec.statics.expected_stiffness / 3.0);
}

double rolling_radius(const TyreSpec& spec, const TyreSection& section) {
  return rolling_radius(spec, section.outer_radius(), spec.statics.load);
}

WheelAndRoad add_rim_and_road(const TyreSpec& spec, const TyreSection& section, const TyreMesh& mesh, Model& model) {
  WheelAndRoad rig;
  const Point foot{0.0, 0.0, -section.outer_radius() - spec.road.clearance};
  rig.hub = add_node(model, {0.0, 0.0, 0.0});
  rig.road = add_node(model, foot);
  add_node_set(model, "HUB", {rig.hub});
  add_node_set(model, "ROAD", {rig.road});
  auto wheel = nodes_of(model, "TYRE");
  wheel.push_back(rig.hub);
  add_node_set(model, "WHEEL", wheel);
  add_hub_inertia(spec.rim, rig.hub, model);

  const auto add_surface = [&](const char* name, AnalyticalSurface analytical) {
    model.surfaces.push_back({.kind = Surface::Kind::analytical, .name = name, .analytical = std::move(analytical)});
    return static_cast<std::int32_t>(model.surfaces.size()) - 1;
  };
  const auto road_row = add_surface("ROAD_SURFACE", road_surface(spec.road, foot));
  const auto rim_row = mesh.strike_surface >= 0 ? add_surface("RIM_SURFACE", rim_surface(spec, {0.0, 0.0, 0.0})) : -1;
  const auto add_body = [&](std::int32_t reference, std::int32_t surface) {
    RigidBody body;
    body.name = fmt::format("RIGID-{}", model.nodes.id[reference]);
    body.reference_node = reference;
    body.analytical_surface = surface;
    model.rigid_bodies.push_back(body);
    return static_cast<std::int32_t>(model.rigid_bodies.size()) - 1;
  };
  rig.rim_body = add_body(rig.hub, rim_row);
  rig.road_body = add_body(rig.road, road_row);

  Interaction grip;
  grip.name = "GRIP";
  grip.friction = spec.road.friction;
  model.interactions.push_back(grip);
  const auto add_pair = [&](std::int32_t slave, std::int32_t master) {  // known from the start so that every step may ask for its history
    ContactPair pair;
    pair.slave = slave;
    pair.master = master;
    pair.interaction = 0;
    pair.first_step = 0;
    model.contact_pairs.push_back(pair);
  };
  add_pair(mesh.tread_surface, road_row);  // active from CONTACT on
  if (rim_row >= 0) add_pair(mesh.strike_surface, rim_row);  // active as it rolls
  return rig;
}

void add_steps(const TyreSpec& spec, const TyreSection& section, const TyreMesh& mesh, const WheelAndRoad& rig,
               Model& model) {
  StepAuthor author(spec, section, rig, mesh, model);
  author.write_static_steps();
  if (!spec.rolling.enabled) return;
  author.write_rolling_steps();
  add_initial_velocities(spec, section, rig, model);
}

}  // namespace balocco
