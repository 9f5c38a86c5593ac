#include "builders/section_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace balocco {
namespace {

constexpr double scale = 4.0, margin = 60.0;
constexpr std::array<const char*, solid_part_count> part_colours{"#9c9c9c", "#6f6f6f", "#c8b89a", "#a8753f", "#7d5a3c"};
constexpr std::array<const char*, region_count> region_colours{"#c0392b", "#d98200", "#1f6fb2", "#2c8f4e"};

/// Millimetres of the section to units of the picture: axial to the right, radius upwards.
struct Frame {
  double left, top;
  double x(double axial) const { return margin + scale * (axial - left); }
  double y(double radius) const { return margin + scale * (top - radius); }
};

void add_legend(double y, std::string& svg) {
  const auto out = std::back_inserter(svg);
  double x = margin;
  const auto entry = [&](const char* colour, const char* name) {
    fmt::format_to(out,
                   "<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"14\" height=\"14\" fill=\"{}\"/><text x=\"{:.0f}\" "
                   "y=\"{:.0f}\">{}</text>\n",
                   x, y, colour, x + 18, y + 12, name);
    x += 40.0 + 8.0 * std::string_view(name).size();
    if (x > 620.0) {
      x = margin;
      y += 20.0;
    }
  };
  for (int part = 0; part < solid_part_count; ++part) entry(part_colours[part], solid_part_names[part]);
  for (int r = 0; r < region_count; ++r) entry(region_colours[r], fmt::format("plies: {}", region_names[r]).c_str());
  entry("#000000", "on the rim");
}

}  // namespace

std::string section_svg(const TyreSpec& spec, const TyreSection& section) {
  double bottom = 1e300;
  for (const auto& node : section.nodes) bottom = std::min(bottom, node[0]);
  const Frame frame{-0.5 * section.width(), section.outer_radius()};
  const double width = 2.0 * margin + scale * section.width();
  const double height = 2.0 * margin + scale * (section.outer_radius() - bottom) + 60.0;
  std::string svg;
  const auto out = std::back_inserter(svg);
  fmt::format_to(
      out,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width, height);
  fmt::format_to(out,
                 "<text x=\"{:.0f}\" y=\"30\" font-size=\"17\">{}: model {}, moulded width {:.1f} mm, outer diameter "
                 "{:.1f} mm</text>\n",
                 margin, spec.title, spec.model, section.width(), 2.0 * section.outer_radius());
  for (const auto& quad : section.quads) {
    fmt::format_to(out, "<polygon fill=\"{}\" stroke=\"white\" stroke-width=\"0.7\" points=\"",
                   part_colours[static_cast<int>(quad.part)]);
    for (const int node : quad.nodes)
      fmt::format_to(out, "{:.2f},{:.2f} ", frame.x(section.nodes[node][1]), frame.y(section.nodes[node][0]));
    fmt::format_to(out, "\"/>\n");
  }
  const auto& line = section.layers[0];
  for (std::size_t j = 0; j < section.line_regions.size(); ++j) {
    const auto &a = section.nodes[line[j]], &b = section.nodes[line[j + 1]];
    fmt::format_to(out,
                   "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" stroke-width=\"3\"/>\n",
                   frame.x(a[1]), frame.y(a[0]), frame.x(b[1]), frame.y(b[0]),
                   region_colours[static_cast<int>(section.line_regions[j])]);
  }
  for (const auto* side : {&section.bead_left, &section.bead_right})
    for (const int node : *side)
      fmt::format_to(out, "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\"/>\n", frame.x(section.nodes[node][1]),
                     frame.y(section.nodes[node][0]));
  add_legend(height - 60.0, svg);
  return svg + "</svg>\n";
}

}  // namespace balocco
