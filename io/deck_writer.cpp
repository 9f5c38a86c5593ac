#include "deck_writer.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "deck/writer.hpp"
#include "elements/element_type.hpp"
#include "materials/elastic_by_temperature.hpp"
#include "materials/material_option.hpp"

namespace balocco {

namespace deck {

namespace {

std::string label_of(const ElementType& type, std::int32_t face) {
  if (type.section != Section::Kind::solid) return face == 0 ? "SPOS" : "SNEG";
  return fmt::format("S{}", face + 1);
}

Point plus(const Point& a, const Point& b, double factor) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

std::string list(const Point& p) {
  return fmt::format("{}, {}, {}", p[0], p[1], p[2]);
}

}  // namespace

std::string quoted(const std::string& name) {
  return name.find_first_of(" ,=") == std::string::npos ? name : "\"" + name + "\"";
}

std::string Writer::amplitude_parameter(std::int32_t amplitude) const {
  return amplitude < 0 ? "" : ", AMPLITUDE=" + quoted(model_.amplitudes[amplitude].name);
}

std::string Writer::node_set_of(const std::vector<std::int32_t>& nodes, const std::string& name_if_made) {
  for (const auto* sets : {&model_.node_sets, &std::as_const(made_node_sets_)}) {
    for (const auto& set : *sets) {
      if (set.nodes == nodes) return set.name;
    }
  }
  made_node_sets_.push_back({name_if_made, nodes});
  return name_if_made;
}

std::string Writer::element_set_of(const std::vector<ElementRef>& elements, const std::string& name_if_made) {
  for (const auto* sets : {&model_.element_sets, &std::as_const(made_element_sets_)}) {
    for (const auto& set : *sets) {
      if (set.elements == elements) return set.name;
    }
  }
  made_element_sets_.push_back({name_if_made, elements});
  return name_if_made;
}

void Writer::comment(const char* text) {
  line("**\n** {}\n**", text);
}

void Writer::head() {
  line("*HEADING");
  if (!model_.heading.empty()) line("{}", model_.heading);
  const auto& units = model_.units;
  if (units.length.empty() && units.mass.empty() && units.time.empty()) return;
  std::string parameters;
  if (!units.length.empty()) parameters += ", LENGTH=" + units.length;
  if (!units.mass.empty()) parameters += ", MASS=" + units.mass;
  if (!units.time.empty()) parameters += ", TIME=" + units.time;
  line("*UNITS{}", parameters);
}

void Writer::mesh() {
  comment("Mesh");
  line("*NODE");
  for (std::int32_t row = 0; row < model_.nodes.size(); ++row)
    line("{}, {}", node_id(row), list(model_.nodes.coordinates[row]));
  for (const auto& table : model_.elements) {
    line("*ELEMENT, TYPE={}", table.type->name);
    for (std::int32_t row = 0; row < table.size(); ++row) {
      fmt::format_to(std::back_inserter(text_), "{}", table.id[row]);
      for (int n = 0; n < table.type->nodes; ++n) {
        fmt::format_to(std::back_inserter(text_), ", {}", node_id(table.connectivity[row * table.type->nodes + n]));
      }
      text_ += '\n';
    }
  }
}

void Writer::sets() {
  comment("Sets");
  std::vector<std::int64_t> ids;
  for (const auto* sets : {&model_.node_sets, &std::as_const(made_node_sets_)}) {
    for (const auto& set : *sets) {
      const bool sorted =
          std::adjacent_find(set.nodes.begin(), set.nodes.end(), std::greater_equal<>()) == set.nodes.end();
      line("*NSET, NSET={}{}", quoted(set.name), sorted ? "" : ", UNSORTED");
      ids.clear();
      for (const auto row : set.deck_order.empty() ? set.nodes : set.deck_order)
        if (row >= 0) ids.push_back(node_id(row));
      values(ids);
    }
  }
  for (const auto* sets : {&model_.element_sets, &std::as_const(made_element_sets_)}) {
    for (const auto& set : *sets) {
      line("*ELSET, ELSET={}", quoted(set.name));
      ids.clear();
      for (const auto element : set.deck_order.empty() ? set.elements : set.deck_order)
        ids.push_back(model_.elements[element.table].id[element.row]);
      values(ids);
    }
  }
}

void Writer::amplitude(const Amplitude& amplitude) {
  const char* time = amplitude.total_time ? ", TIME=TOTAL TIME" : "";
  if (amplitude.kind == Amplitude::Kind::periodic) {
    line("*AMPLITUDE, NAME={}, DEFINITION=PERIODIC{}", quoted(amplitude.name), time);
    line("{}, {}, {}, {}", amplitude.harmonics.size(), amplitude.circular_frequency, amplitude.start,
         amplitude.initial);
    std::vector<double> coefficients;
    for (const auto& harmonic : amplitude.harmonics)
      coefficients.insert(coefficients.end(), harmonic.begin(), harmonic.end());
    return values(coefficients);
  }
  line("*AMPLITUDE, NAME={}, DEFINITION={}{}", quoted(amplitude.name),
       amplitude.kind == Amplitude::Kind::smooth_step ? "SMOOTH STEP" : "TABULAR", time);
  std::vector<double> numbers;
  for (const auto& point : amplitude.points) numbers.insert(numbers.end(), point.begin(), point.end());
  values(numbers);
}

/// Axes of single elements, as a distribution.
void Writer::element_orientation(const Orientation& orientation) {
  line("*DISTRIBUTION TABLE, NAME={}", quoted(orientation.name + "-TABLE"));
  line("COORD3D, COORD3D");
  line("*DISTRIBUTION, NAME={}, LOCATION=ELEMENT, TABLE={}", quoted(orientation.name + "-AXES"), quoted(orientation.name + "-TABLE"));
  for (const auto& [element, axes] : orientation.of_element)
    line("{}, {}, {}", model_.elements[element.table].id[element.row], list(axes[0]), list(axes[1]));
  line("*ORIENTATION, NAME={}", quoted(orientation.name));
  line("{}", quoted(orientation.name + "-AXES"));
}

void Writer::orientation(const Orientation& orientation) {
  const auto& [x, y, z] = orientation.axes;
  const Point& o = orientation.origin;
  if (!orientation.of_element.empty()) {
    element_orientation(orientation);
  } else if (orientation.system == Orientation::System::cylindrical) {
    line("*ORIENTATION, NAME={}, SYSTEM=CYLINDRICAL", quoted(orientation.name));
    line("{}, {}", list(o), list(plus(o, z, 1.0)));
  } else {
    line("*ORIENTATION, NAME={}, SYSTEM=RECTANGULAR", quoted(orientation.name));
    line("{}, {}, {}", list(plus(o, x, 1.0)), list(plus(o, y, 1.0)), list(o));
  }
  if (orientation.additional_rotation != 0.0 || orientation.rotation_axis != 0) {
    line("{}, {}", orientation.rotation_axis + 1, degrees_of(orientation.additional_rotation));
  }
}

void Writer::definitions() {
  comment("Amplitudes, orientations and nodal directions");
  for (const auto& item : model_.amplitudes) amplitude(item);
  for (const auto& item : model_.orientations) orientation(item);
  for (std::size_t k = 0; k < model_.transforms.size(); ++k) {
    const auto& [nodes, directions] = model_.transforms[k];
    const auto& [x, y, z] = directions.axes;
    const bool cylindrical = directions.system == Orientation::System::cylindrical;
    line("*TRANSFORM, NSET={}, TYPE={}", quoted(node_set_of(nodes, fmt::format("_TRANSFORM-{}", k + 1))),
         cylindrical ? "C" : "R");
    line("{}, {}", list(cylindrical ? directions.origin : x), list(cylindrical ? plus(directions.origin, z, 1.0) : y));
  }
}

void Writer::analytical(const Surface& surface) {
  const auto& shape = *surface.analytical;
  const bool revolved = shape.kind == AnalyticalSurface::Kind::revolved;
  line("*SURFACE, TYPE={}, NAME={}", revolved ? "REVOLUTION" : "CYLINDER", quoted(surface.name));
  line("{}, {}", list(shape.origin), list(plus(shape.origin, shape.axes[revolved ? 1 : 0], 1.0)));
  if (!revolved) line("{}", list(plus(shape.origin, shape.axes[2], -1.0)));
  line("START, {}, {}", shape.profile[0].start[0], shape.profile[0].start[1]);
  for (const auto& segment : shape.profile) {
    if (segment.kind == ProfileSegment::Kind::line) {
      line("LINE, {}, {}", segment.end[0], segment.end[1]);
    } else {
      line("CIRCL, {}, {}, {}, {}", segment.end[0], segment.end[1], segment.centre[0], segment.centre[1]);
    }
  }
}

void Writer::surface(const Surface& surface) {
  if (surface.kind == Surface::Kind::analytical) return analytical(surface);
  if (!surface.edges.empty()) {
    line("*SURFACE, TYPE=ELEMENT, NAME={}", quoted(surface.name));
    for (const auto& [element, edge] : surface.edges) line("{}, E{}", model_.elements[element.table].id[element.row], edge + 1);
    return;
  }
  if (surface.kind == Surface::Kind::nodes) {
    line("*SURFACE, TYPE=NODE, NAME={}", quoted(surface.name));
    for (const auto row : surface.nodes) line("{}", node_id(row));
    return;
  }
  line("*SURFACE, TYPE=ELEMENT, NAME={}", quoted(surface.name));
  for (const auto& [element, face] : surface.faces) {
    const auto& table = model_.elements[element.table];
    line("{}, {}", table.id[element.row], label_of(*table.type, face));
  }
}

void Writer::surfaces() {
  comment("Surfaces");
  for (const auto& item : model_.surfaces) surface(item);
}

void Writer::materials() {
  comment("Materials");
  for (const auto& material : model_.materials) {
    line("*MATERIAL, NAME={}", quoted(material.name));
    if (material.density > 0.0) line("*DENSITY\n{}", material.density);
    if (material.damping_alpha != 0.0 || material.damping_beta != 0.0) {
      line("*DAMPING, ALPHA={}, BETA={}", material.damping_alpha, material.damping_beta);
    }
    const MaterialLaw* law = find_material_law(material.law);
    if (law == nullptr) continue;
    // Abaqus names the variants of *ELASTIC by TYPE and those of the other keywords by a flag.
    const char* separator = law->variant.empty() ? "" : law->keyword == "ELASTIC" ? ", TYPE=" : ", ";
    line("*{}{}{}{}{}", law->keyword, separator, law->variant, law->order > 0 ? fmt::format(", N={}", law->order) : "",
         material.instantaneous ? ", MODULI=INSTANTANEOUS" : "");
    if (ElasticTable::is_in(material)) {
      for (std::size_t i = 0; i < material.parameters.size(); i += ElasticTable::columns)
        values(std::span(material.parameters).subspan(i, ElasticTable::columns));
    } else {
      values(material.parameters);
    }
    for (const auto& option : material.options) material_option(option);
    if (!material.expansion) continue;
    line("*EXPANSION, ZERO={}", material.expansion->reference);
    for (const auto& row : material.expansion->rows) values(row);
  }
}

void Writer::material_option(const MaterialOption& option) {
  const OptionSpec& spec = *find_material_option(option.name);
  std::string keyword = "*" + spec.keyword;
  if (!spec.selector.empty()) keyword += ", " + spec.selector + "=" + spec.variant;
  for (const auto& word : spec.words) keyword += ", " + word.name + (word.value.empty() ? "" : "=" + word.value);
  for (std::size_t i = 0; i < option.settings.size(); ++i)
    if (option.settings[i] != 0.0) keyword += fmt::format(", {}={}", spec.settings[i].name, option.settings[i]);
  line("{}", keyword);
  for (const auto& row : option.rows) values(row);
}

void Writer::rigid_bodies() {
  comment("Rigid bodies");
  for (const auto& body : model_.rigid_bodies) {
    std::string parameters = fmt::format(", REF NODE={}", node_id(body.reference_node));
    if (!body.elements.empty())
      parameters += ", ELSET=" + quoted(element_set_of(body.elements, "_" + body.name + "-ELEMENTS"));
    if (!body.tie_nodes.empty())
      parameters += ", TIE NSET=" + quoted(node_set_of(body.tie_nodes, "_" + body.name + "-TIE"));
    if (!body.pin_nodes.empty())
      parameters += ", PIN NSET=" + quoted(node_set_of(body.pin_nodes, "_" + body.name + "-PIN"));
    if (body.at_center_of_mass) parameters += ", POSITION=CENTER OF MASS";
    if (body.analytical_surface >= 0)
      parameters += ", ANALYTICAL SURFACE=" + quoted(model_.surfaces[body.analytical_surface].name);
    line("*RIGID BODY{}", parameters);
  }
}

void Writer::friction(const Interaction& interaction) {
  if (interaction.friction == 0.0 && !interaction.elastic_slip) return;
  line("*FRICTION{}{}\n{}", interaction.elastic_slip ? fmt::format(", ELASTIC SLIP={}", *interaction.elastic_slip) : "",
       std::isfinite(interaction.shear_stress_limit) ? fmt::format(", TAUMAX={}", interaction.shear_stress_limit) : "",
       interaction.stick_slope ? fmt::format("{}, {}", interaction.friction, *interaction.stick_slope) : fmt::format("{}", interaction.friction));
}

void Writer::behavior(const Interaction& interaction) {
  // Before a law, which would be hard again behind it.
  if (interaction.penalty_scale != 1.0) line("*SURFACE BEHAVIOR, PENALTY\n{}", interaction.penalty_scale);
  const auto& law = interaction.behavior;
  switch (law.kind) {
    case PressureLaw::Kind::hard: break;
    case PressureLaw::Kind::linear:
      if (std::isinf(law.tension))
        line("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n{}", law.slope);
      else
        line("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{}, {}, {}", law.slope, law.tension, law.spring_clearance);
      break;
    case PressureLaw::Kind::exponential:
      line("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL\n{}, {}, {}", law.clearance, law.pressure, law.greatest_slope);
      break;
    case PressureLaw::Kind::table:
      line("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR");
      for (const auto& row : law.rows) line("{}, {}", row.pressure, row.overclosure);
      break;
  }
}

void Writer::contact() {
  comment("Contact");
  for (const auto& interaction : model_.interactions) {
    line("*SURFACE INTERACTION, NAME={}", quoted(interaction.name));
    friction(interaction);
    behavior(interaction);
  }
  for (const auto& pair : model_.contact_pairs) {
    if (pair.first_step > 0) continue;
    line("*CONTACT PAIR, INTERACTION={}{}\n{}, {}", quoted(model_.interactions[pair.interaction].name),
         pair.of_faces ? ", TYPE=SURFACE TO SURFACE" : "", quoted(model_.surfaces[pair.slave].name), quoted(model_.surfaces[pair.master].name));
  }
}

void Writer::initial_displacements() {
  for (std::size_t k = 0; k < model_.initial_displacements.size(); ++k) {
    const auto& [nodes, dof, value, location] = model_.initial_displacements[k];
    line("*INITIAL CONDITIONS, TYPE=DISPLACEMENT\n{}, {}, {}", quoted(node_set_of(nodes, fmt::format("_DISPLACEMENT-{}", k + 1))), dof + 1, value);
  }
}

void Writer::initial_velocities() {
  for (std::size_t k = 0; k < model_.initial_velocities.size(); ++k) {
    const auto& velocity = model_.initial_velocities[k];
    const std::string set = quoted(node_set_of(velocity.nodes, fmt::format("_VELOCITY-{}", k + 1)));
    if (velocity.kind == InitialVelocity::Kind::rotation) {
      line("*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY\n{}, {}, {}", set, velocity.angular_speed,
           list(velocity.velocity));
      line("{}, {}", list(velocity.axis_point), list(plus(velocity.axis_point, velocity.axis_direction, 1.0)));
      continue;
    }
    line("*INITIAL CONDITIONS, TYPE=VELOCITY\n{}, {}, {}", set, velocity.dof + 1, velocity.velocity[velocity.dof]);
  }
}

void Writer::initial_fields() {
  for (std::size_t k = 0; k < model_.initial_fields.size(); ++k) {
    const auto& [field, components, elements, values, location] = model_.initial_fields[k];
    const auto& table = model_.elements[elements[0].table];
    const char* const type = field == "S0" ? "STRESS" : "HARDENING";
    if (const auto count = static_cast<std::size_t>(components); values.size() > count) {  // of one point after the other
      line("*INITIAL CONDITIONS, TYPE={}{}", type, table.type->section == Section::Kind::shell ? ", SECTION POINTS" : "");
      for (std::size_t point = 0; count * point < values.size(); ++point) {
        std::string numbers;
        for (std::size_t i = 0; i < count; ++i) numbers += fmt::format(", {}", values[count * point + i]);
        line("{}, {}{}", table.id[elements[0].row], point + 1, numbers);
      }
      continue;
    }
    std::string numbers;
    for (const double value : values) numbers += fmt::format(", {}", value);
    line("*INITIAL CONDITIONS, TYPE={}\n{}{}", type,
         quoted(element_set_of(elements, fmt::format("_INITIAL-{}", k + 1))), numbers);
  }
}

void Writer::initial_temperatures() {
  if (model_.initial_temperature.empty()) return;
  line("*INITIAL CONDITIONS, TYPE=TEMPERATURE");
  for (std::int32_t node = 0; node < model_.nodes.size(); ++node) line("{}, {}", node_id(node), model_.initial_temperature[node]);
}

std::string Writer::write() {
  // What refers to sets comes first, because it may make some.
  definitions();
  surfaces();
  materials();
  sections();
  rigid_bodies();
  contact();
  initial_displacements();
  initial_temperatures();
  initial_velocities();
  initial_fields();
  for (std::size_t row = 0; row < model_.steps.size(); ++row) step(row);
  const std::string rest = std::move(text_);
  text_.clear();
  head();
  mesh();
  sets();
  return text_ + time_points_ + rest;
}

}  // namespace deck

std::string write_deck(const Model& model) {
  return deck::Writer(model).write();
}

}  // namespace balocco
