#include "builders/car/car_steps.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "builders/car/rail_sections.hpp"
#include "builders/car/wheels.hpp"
#include "builders/rim_profile.hpp"
#include "builders/tyre_steps.hpp"

namespace balocco::car {
namespace {

// ms of a static step. Dampers push there too, by the increment of motion over that of time, as in Abaqus: so slowly it is nothing.
constexpr double period = 1e6;
constexpr double least_fall = 20.0;  // mm from the wheels that hang lowest to the road where a fall begins: they are estimated

const char* side_of(const std::string& wheel) {
  return wheel.ends_with("LEFT") ? "LEFT" : "RIGHT";
}

void write_road_pairs(DeckText& deck) {
  for (const auto* wheel : wheel_names) deck.line("TREAD_{}, ROAD_{}_SURFACE", wheel, side_of(wheel));
}

void write_rim_pairs(const TyreSpec& tyre, DeckText& deck) {
  for (const auto* wheel : wheel_names)
    if (strikes_rim(tyre)) deck.line("STRIKE_{}, RIM_{}", wheel, wheel);
}

void hold_body(const CarSpec& spec, DeckText& deck) {
  if (spec.fidelity != "complete") return deck.line("BODY_REFERENCE, 1, 6");
  for (const auto* side : {"LEFT", "RIGHT"}) deck.line("STRUT_MOUNT_FRONT_{}, 1, 3\nSPRING_SEAT_REAR_{}, 1, 3", side, side);
}

/// What every step tells over its time: hubs and roads, tyres, and the connectors by which they load the car.
void write_history(DeckText& deck) {
  for (const auto* wheel : wheel_names) {
    deck.line("*NODE OUTPUT, NSET=HUB_{}\nU, UR, V, RF\n*NODE OUTPUT, NSET=AXLE_{}\nU, UR", wheel, wheel);
    deck.line("*ELEMENT OUTPUT, ELSET=BEARING_{}\nCTF", wheel);
    deck.line("*CONTACT OUTPUT, SLAVE=TREAD_{}, MASTER=ROAD_{}_SURFACE\nCFN, CFT", wheel, side_of(wheel));
  }
  for (const std::string side : {"LEFT", "RIGHT"}) {
    deck.line("*NODE OUTPUT, NSET=ROAD_{}\nU, RF", side);
    for (const auto* mount : {"STRUT_MOUNT_FRONT_", "SPRING_SEAT_REAR_"}) deck.line("*NODE OUTPUT, NSET={}{}\nU, UR", mount, side);
    for (const auto* connector : {"TOP_MOUNT_", "STRUT_FRONT_", "SPRING_REAR_", "DAMPER_REAR_"})
      deck.line("*ELEMENT OUTPUT, ELSET={}{}\nCTF, CU", connector, side);
  }
}

/// Assemblies some of whose sheets deform.
std::set<std::string> deformable_assemblies(const CarSpec& spec, const BodyMesh& mesh) {
  std::set<std::string> names;
  for (const auto& part : mesh.parts())
    if (!is_rigid(spec, part)) names.insert(part.assembly);
  return names;
}

/// What the drive tells besides: section forces of rails that deform, and energies of what deforms as tables in JOB.dat.
void write_parts_history(const CarSpec& spec, const BodyMesh& mesh, DeckText& deck) {
  if (spec.fidelity == "complete")
    for (const auto& section : rail_section_names()) deck.line("*ELEMENT OUTPUT, ELSET={}\nSF", section);
  auto parts = deformable_assemblies(spec, mesh);
  for (const std::string wheel : wheel_names) parts.insert("TYRE_" + wheel);
  for (const auto& part : parts) deck.line("*EL PRINT, ELSET={}, TOTALS=ONLY, TIME POINTS=FRAMES\nELSE, ELKE", part);
}

/// Shells of wheels are thick for their size, and turn: made denser as the tyre's they would be flywheels. They have an increment
/// of their own.
void write_wheels_density(const WheelSpec& wheel, DeckText& deck) {
  for (const auto* name : wheel_names) {
    if (wheel.stable_increment > 0.0)
      deck.line("*FIXED MASS SCALING, ELSET=RIM_AND_DISC_{}, TYPE=BELOW MIN, DT={:g}", name, wheel.stable_increment);
    else
      deck.line("*FIXED MASS SCALING, ELSET=RIM_AND_DISC_{}, FACTOR=1.", name);
  }
}

void write_seating(std::span<const char* const> wheels, double shift, DeckText& deck) {
  for (const auto* wheel : wheels)
    for (const auto& [side, sign] : {std::pair{"LEFT", -1.0}, std::pair{"RIGHT", 1.0}})
      deck.line("BEAD_{}_{}, 1, 1\nBEAD_{}_{}, 2, 2, {:g}\nBEAD_{}_{}, 3, 3", side, wheel, side, wheel, sign * shift, side, wheel);
}

void write_static_step(const char* name, double first, double largest, DeckText& deck) {
  deck.line("**\n*STEP, NAME={}, NLGEOM=YES, INC=200\n*STATIC\n{:g}, {:g}, {:g}, {:g}", name, first * period, period, 1e-5 * period,
            largest * period);
}

/// Rigid arms between a wheel's beads and what carries them.
void tie_beads(const std::string& wheel, const std::string& carrier, DeckText& deck) {
  for (const auto* side : {"LEFT", "RIGHT"}) deck.line("*RIGID BODY, REF NODE={}, TIE NSET=BEAD_{}_{}", carrier, side, wheel);
}

/// Writes the steps of the equilibrium; each says all that acts in it.
class StepText {
 public:
  StepText(const CarSpec& spec, const TyreSpec& tyre, const TyreFacts& facts, double droop, DeckText& deck)
      : spec_(spec), tyre_(tyre), facts_(facts), droop_(droop), deck_(deck) {}

  void seat() {
    begin("SEAT", 0.25, 0.5);
    deck_.line("*BOUNDARY");
    write_seating(wheel_names, facts_.seat_shift, deck_);
    hold_hubs(1, 6);
    hold_roads(0.0);
    hold_body();
    inflate(tyre_.statics.seating_pressure);
    end();
  }

  void inflate_tyres() {
    begin("INFLATE", 0.1, 0.25);
    tie_all_beads();
    deck_.line("*BOUNDARY, OP=NEW");
    hold_hubs(1, 6);
    hold_roads(0.0);
    hold_body();
    inflate(tyre_.statics.pressure);
    end();
  }

  /// All tyres start from the one that another job has inflated: the pressure is there at once.
  void import_tyres() {
    for (std::size_t wheel = 0; wheel < wheel_names.size(); ++wheel) {
      const auto behind = static_cast<std::int64_t>(wheel);
      deck_.line("*IMPORT, STATE=YES, UPDATE=NO, STEP=2, ELEMENT SHIFT={}, SHIFT NODES={}\nTYRE_{}", behind * facts_.elements,
                 behind * facts_.nodes, wheel_names[wheel]);
    }
    deck_.line("*AMPLITUDE, NAME=AT_ONCE\n0., 1., {:g}, 1.", period);
    amplitude_ = ", AMPLITUDE=AT_ONCE";
    imported_ = true;
  }

  void weigh() {
    begin("GRAVITY", 0.1, 0.25);
    deck_.line("*BOUNDARY, OP=NEW");
    hold_hubs(1, 3);
    hold_hubs(5, 5);
    hold_roads(0.0);
    inflate(tyre_.statics.pressure);
    weight();
    end();
  }

  /// The road comes up to where the tyres touch it under the design height's load.
  void touch() {
    begin("CONTACT", 0.1, 0.2);
    deck_.line("*MODEL CHANGE, TYPE=CONTACT PAIR, ADD");
    write_road_pairs(deck_);
    deck_.line("*BOUNDARY, OP=NEW");
    hold_hubs(1, 3);
    hold_hubs(5, 5);
    hold_roads(rise());
    inflate(tyre_.statics.pressure);
    weight();
    end();
  }

  /// Free wheels let the car roll along: that alone is held, and hardly pulls; all else is held by friction.
  void stand() {
    begin("STAND", 0.1, 0.25);
    const char* middle = spec_.fidelity == "complete" ? "ENGINE" : "BODY_REFERENCE";
    deck_.line("*BOUNDARY, OP=NEW\n{}, 1, 1", middle);
    if (friction() == 0.0) hold_what_friction_would(middle);
    hold_roads(rise());
    inflate(tyre_.statics.pressure);
    weight();
    write_restart();
    end();
  }

  /// As the car is while it falls: its wheels have no weight and hang on their stops. Held where nothing pulls.
  void fall() {
    begin("FALL", 0.05, 0.1);
    deck_.line("*BOUNDARY, OP=NEW\n{}, 1, 6", spec_.fidelity == "complete" ? "ENGINE" : "BODY_REFERENCE");
    hold_hubs(5, 5);
    hold_roads(spec_.chassis.road.clearance - droop_ - std::min(least_fall, spec_.chassis.drive.height));
    inflate(tyre_.statics.pressure);
    write_restart();
    end();
  }

  /// How it bounces, pitches and rolls on its springs, and its wheels hop on their tyres; up to 60 Hz how its body twists and bends.
  void ride() {
    deck_.line("**\n*STEP, NAME=RIDE, PERTURBATION\n*FREQUENCY\n{}\n*END STEP", spec_.fidelity == "complete" ? "90, , 0.06" : "30");
  }

 private:
  double friction() const { return spec_.chassis.standing_friction.value_or(spec_.chassis.road.friction); }
  /// A road without friction lets the car slide across and turn round, and its wheels spin: nothing pulls there.
  void hold_what_friction_would(const char* middle) {
    deck_.line("{}, 2, 2", middle);
    deck_.line("{}", spec_.fidelity == "complete" ? "SPRING_SEAT_REAR_LEFT, 2, 2" : "BODY_REFERENCE, 6, 6");
    hold_hubs(5, 5);
  }
  double rise() const { return facts_.outer_radius + spec_.chassis.road.clearance - spec_.profile.wheel_height; }

  void begin(const char* name, double first, double largest) {
    write_static_step(name, first, largest, deck_);
    if (std::exchange(begun_, true)) return;
    if (friction() != spec_.chassis.road.friction) deck_.line("*CHANGE FRICTION, INTERACTION=GRIP\n*FRICTION\n{:g}", friction());
    deck_.line("*MODEL CHANGE, TYPE=CONTACT PAIR, REMOVE");
    write_road_pairs(deck_);
    write_rim_pairs(tyre_, deck_);
    if (imported_) tie_all_beads();
  }
  void tie_all_beads() {
    for (const auto* wheel : wheel_names) tie_beads(wheel, bead_carrier(spec_, wheel), deck_);
  }
  void hold_hubs(int first, int last) {
    for (const auto* wheel : wheel_names) deck_.line("HUB_{}, {}, {}", wheel, first, last);
  }
  void hold_roads(double up) {
    for (const auto* side : {"LEFT", "RIGHT"})
      deck_.line("ROAD_{}, 1, 2\nROAD_{}, 3, 3, {:g}\nROAD_{}, 4, 6", side, side, up, side);
  }
  void hold_body() { car::hold_body(spec_, deck_); }
  void inflate(double pressure) {
    deck_.line("*DSLOAD{}", amplitude_);
    for (const auto* wheel : wheel_names) deck_.line("LINER_{}, P, {:g}", wheel, pressure);
  }
  void write_restart() { deck_.line("*RESTART, WRITE, FREQUENCY=1000000, OVERLAY"); }
  void weight() { deck_.line("*DLOAD\n, GRAV, {:g}, 0., 0., -1.", gravity); }

  void end() {
    deck_.line("*OUTPUT, FIELD, FREQUENCY=1000000\n*NODE OUTPUT\nU\n*ELEMENT OUTPUT\nS, PEEQ\n*OUTPUT, HISTORY, FREQUENCY=1");
    write_history(deck_);
    deck_.line("*ENERGY OUTPUT\nALLIE, ALLWK, ETOTAL\n*END STEP");
    amplitude_ = "";
  }

  const CarSpec& spec_;
  const TyreSpec& tyre_;
  const TyreFacts& facts_;
  double droop_;
  DeckText& deck_;
  bool begun_ = false, imported_ = false;
  const char* amplitude_ = "";  // of the pressure in the next step
};

}  // namespace

void write_fidelity(const CarSpec& spec, const BodyMesh& mesh, DeckText& deck) {
  deck.chapter("FIDELITY: " + spec.fidelity);
  if (spec.fidelity == "complete") return;
  std::map<std::string, std::vector<const Part*>> rigid;
  for (const auto& part : mesh.parts())
    if (is_rigid(spec, part)) rigid[part.assembly].push_back(&part);
  for (const auto& [assembly, parts] : rigid) {
    deck.line("*ELSET, ELSET=RIGID_{}", assembly);
    Inertia inertia;
    for (const auto* part : parts) {
      deck.line("{}", part->name);
      add_part(spec, mesh, *part, inertia);
    }
    deck.line("*RIGID BODY, REF NODE={}, ELSET=RIGID_{}", deck.named_node(assembly + "_REFERENCE", inertia.centre()), assembly);
  }
}

void write_equilibrium(const CarSpec& spec, const TyreSpec& tyre, const TyreFacts& facts, double droop, Inflation inflation, DeckText& deck) {
  deck.chapter("EQUILIBRIUM");
  StepText steps(spec, tyre, facts, droop, deck);
  if (inflation == Inflation::of_one) {
    steps.import_tyres();
  } else {
    steps.seat();
    steps.inflate_tyres();
  }
  if (spec.chassis.drive.height > 0.0) return steps.fall();
  steps.weigh();
  steps.touch();
  steps.stand();
  steps.ride();
}

void write_tyre_steps(const TyreSpec& tyre, const TyreFacts& facts, DeckText& deck) {
  const std::string wheel = wheel_names[0], hub = "HUB_" + wheel;
  const auto load = [&](double pressure) {
    deck.line("*DSLOAD\nLINER_{}, P, {:g}\n*OUTPUT, FIELD, FREQUENCY=1000000\n*NODE OUTPUT\nU\n*ELEMENT OUTPUT\nS\n*OUTPUT, HISTORY, "
              "FREQUENCY=1\n*NODE OUTPUT, NSET={}\nU, RF\n*RESTART, WRITE, FREQUENCY=1000000, OVERLAY\n*END STEP", wheel, pressure, hub);
  };
  write_static_step("SEAT", 0.25, 0.5, deck);
  deck.line("*BOUNDARY\n{}, 1, 6", hub);
  write_seating(std::span(wheel_names).first(1), facts.seat_shift, deck);
  load(tyre.statics.seating_pressure);
  write_static_step("INFLATE", 0.1, 0.25, deck);
  tie_beads(wheel, hub, deck);
  deck.line("*BOUNDARY, OP=NEW\n{}, 1, 6", hub);
  load(tyre.statics.pressure);
}

void write_kinematics(const CarSpec& spec, double travel, DeckText& deck) {
  deck.chapter("KINEMATICS: wheels up and down");
  struct Motion {
    const char* name;
    double left, right;  // in parts of the travel
  };
  for (const auto& [name, left, right] : {Motion{"BUMP", 1.0, 1.0}, Motion{"REBOUND", -1.0, -1.0}, Motion{"ROLL", 0.5, -0.5}}) {
    write_static_step(name, 0.05, 0.05, deck);
    deck.line("*BOUNDARY, OP=NEW");
    hold_body(spec, deck);
    for (const std::string wheel : wheel_names)
      deck.line("HUB_{}, 3, 3, {:g}\nHUB_{}, 5, 5", wheel, travel * (wheel.ends_with("LEFT") ? left : right), wheel);
    deck.line("*OUTPUT, HISTORY, FREQUENCY=1");
    for (const auto* wheel : wheel_names) deck.line("*NODE OUTPUT, NSET=HUB_{}\nU, UR, RF", wheel);
    deck.line("*END STEP");
  }
}

namespace {

/// The roads run and the wheels turn.
void write_rolling_start(const CarSpec& spec, const TyreSpec& tyre, const TyreFacts& facts, const CornerWeights& loads,
                         DeckText& deck) {
  const double speed = spec.chassis.drive.speed;
  const auto centres = wheel_centres(spec);
  for (std::size_t wheel = 0; wheel < wheel_names.size(); ++wheel) {
    const auto& at = centres[wheel];
    deck.line("*NSET, NSET=WHEEL_{}\nTYRE_{}, HUB_{}", wheel_names[wheel], wheel_names[wheel], wheel_names[wheel]);
    if (!spec.chassis.wheel.mesh.empty()) deck.line("RIM_AND_DISC_{}, SEATS_{}", wheel_names[wheel], wheel_names[wheel]);
    const double radius = rolling_radius(tyre, facts.outer_radius, wheel < 2 ? loads.front : loads.rear);
    deck.line("*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY\nWHEEL_{}, {:.9g}, 0., 0., 0.", wheel_names[wheel],
              speed / radius);
    deck.line("{:g}, {:g}, {:g}, {:g}, {:g}, {:g}", at[0], at[1], at[2], at[0], at[1] + 1.0, at[2]);  // two points of the axis
  }
  for (const auto* side : {"LEFT", "RIGHT"}) deck.line("*INITIAL CONDITIONS, TYPE=VELOCITY\nROAD_{}, 1, {:g}", side, -speed);
}

/// Amplitudes of tyres that lose their air.
void write_pressure_losses(const CarSpec& spec, double pressure, DeckText& deck) {
  for (std::size_t wheel = 0; wheel < wheel_names.size(); ++wheel)
    if (const auto left = spec.pressure[wheel])
      deck.line("*AMPLITUDE, NAME=PRESSURE_{}\n0., 1., {:g}, {:g}", wheel_names[wheel], spec.pressure_loss_time, *left / pressure);
}

void write_pressure(const CarSpec& spec, double pressure, DeckText& deck) {
  for (std::size_t wheel = 0; wheel < wheel_names.size(); ++wheel)
    deck.line("*DSLOAD{}\nLINER_{}, P, {:g}",
              spec.pressure[wheel] ? fmt::format(", AMPLITUDE=PRESSURE_{}", wheel_names[wheel]) : "", wheel_names[wheel], pressure);
}

/// All falls as fast as from the whole height, but for what is left of it.
void write_falling_start(const DriveSpec& drive, DeckText& deck) {
  const double speed = std::sqrt(2.0 * gravity * std::max(drive.height - least_fall, 0.0));
  deck.line("*INITIAL CONDITIONS, TYPE=VELOCITY\nALL_BUT_TYRES, 3, {:.9g}", -speed);
  for (const auto* wheel : wheel_names) deck.line("TYRE_{}, 3, {:.9g}", wheel, -speed);
}

}  // namespace

void write_drive(const CarSpec& spec, const BodyMesh& mesh, const TyreSpec& tyre, const TyreFacts& facts,
                 const CornerWeights& loads, DeckText& deck) {
  const auto& drive = spec.chassis.drive;
  if (drive.height > 0.0) {
    deck.chapter("DROP: the car falls on its wheels");
    write_falling_start(drive, deck);
  } else {
    deck.chapter("DRIVE: the roads run, the car is free");
    write_rolling_start(spec, tyre, facts, loads, deck);
  }
  write_pressure_losses(spec, tyre.statics.pressure, deck);
  deck.line("*TIME POINTS, NAME=FRAMES, GENERATE\n0., {:g}, {:g}", drive.duration, drive.duration / drive.frames);
  deck.line("**\n*STEP, NAME=DRIVE, NLGEOM=YES\n*DYNAMIC, EXPLICIT, SCALE FACTOR={:g}\n, {:g}\n*BULK VISCOSITY\n{:g}, {:g}",
            tyre.rolling.scale_factor, drive.duration, tyre.rolling.linear_bulk_viscosity, tyre.rolling.quadratic_bulk_viscosity);
  if (drive.stable_increment > 0.0) deck.line("*FIXED MASS SCALING, TYPE=BELOW MIN, DT={:g}", drive.stable_increment);
  if (!spec.chassis.wheel.mesh.empty()) write_wheels_density(spec.chassis.wheel, deck);
  deck.line("*MODEL CHANGE, TYPE=CONTACT PAIR, ADD");
  write_road_pairs(deck);
  write_rim_pairs(tyre, deck);
  for (const auto* side : {"LEFT", "RIGHT"})
    deck.line("*BOUNDARY, TYPE=VELOCITY\nROAD_{}, 1, 1, {:g}\n*BOUNDARY, FIXED\nROAD_{}, 2, 6", side, 0.0 - drive.speed, side);  // a fall's is 0, not -0
  write_pressure(spec, tyre.statics.pressure, deck);
  deck.line("*DLOAD\n, GRAV, {:g}, 0., 0., -1.", gravity);
  deck.line(
      "*OUTPUT, FIELD, NUMBER INTERVAL={}\n*NODE OUTPUT\nU, V\n*ELEMENT OUTPUT\nS, PEEQ\n*OUTPUT, HISTORY, TIME INTERVAL={:g}",
      drive.frames, drive.history_interval);
  write_history(deck);
  constexpr double rows_between_energies = 10.0;  // they change slowly and ask every element
  deck.line("*OUTPUT, HISTORY, TIME INTERVAL={:g}\n*ENERGY OUTPUT\nALLIE, ALLKE, ALLWK, ETOTAL", rows_between_energies * drive.history_interval);
  write_parts_history(spec, mesh, deck);
  deck.line("*RESTART, WRITE, NUMBER INTERVAL=4, OVERLAY\n*END STEP");
}

}  // namespace balocco::car
