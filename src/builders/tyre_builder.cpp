#include "builders/tyre_builder.hpp"

#include <fmt/format.h>

#include "builders/section_picture.hpp"
#include "builders/tyre_report.hpp"
#include "builders/tyre_steps.hpp"

namespace balocco {

Model build_tyre(const std::string& toml_text, const std::string& file_name, const FileText& load, std::string& report) {
  const auto spec = read_tyre_spec(toml_text, file_name, load);
  const auto section = make_section(spec);
  Model model;
  model.name = "tyre";
  model.heading = fmt::format(
      "{}, model {}: seating, inflation, contact, load{}. Units mm, ms, g, N, MPa. Membranes carry no bending: a "
      "seating "
      "pressure of {:g} MPa{} supports them until they are inflated. Cords are linear (no slackening in compression).",
      spec.title, spec.model, spec.rolling.enabled ? ", rolling over the obstacle" : "", spec.statics.seating_pressure,
      spec.statics.stabilize ? " and stabilization" : "");
  model.units = {"mm", "g", "ms"};
  const auto mesh = add_tyre(spec, section, model);
  report = tyre_report(spec, section, mesh, model);
  const auto rig = add_rim_and_road(spec, section, mesh, model);
  add_steps(spec, section, mesh, rig, model);
  return model;
}

std::string tyre_section_svg(const std::string& toml_text, const std::string& file_name, const FileText& load) {
  const auto spec = read_tyre_spec(toml_text, file_name, load);
  return section_svg(spec, make_section(spec));
}

}  // namespace balocco
