#include "sections/beam_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/initial_stress.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

using std::numbers::pi;

/// A rectangle of a thin-walled section: centre and sides along n1 and n2.
struct Strip {
  double x1, x2, width, height;
};

/// Strips together, about their common centroid; each twists by itself.
BeamArea open_area(const std::vector<Strip>& strips, BeamPoint& centroid) {
  BeamArea sum;
  for (const auto& s : strips) {
    const double area = s.width * s.height;
    sum.area += area;
    centroid.x1 += area * s.x1;
    centroid.x2 += area * s.x2;
    sum.torsion += std::max(s.width, s.height) * std::pow(std::min(s.width, s.height), 3) / 3.0;
  }
  centroid.x1 /= sum.area;
  centroid.x2 /= sum.area;
  for (const auto& s : strips) {
    const double area = s.width * s.height, x1 = s.x1 - centroid.x1, x2 = s.x2 - centroid.x2;
    sum.i11 += area * (x2 * x2 + s.height * s.height / 12.0);
    sum.i22 += area * (x1 * x1 + s.width * s.width / 12.0);
    sum.i12 += area * x1 * x2;
  }
  return sum;
}

/// Saint-Venant: J = a b^3 (1/3 - 64 b / (pi^5 a) sum over odd n of tanh(n pi a / 2 b) / n^5), a the longer side.
double rectangle_torsion(double first, double second) {
  const double a = std::max(first, second), b = std::min(first, second);
  double sum = 0.0;
  for (int n = 1; n < 30; n += 2) sum += std::tanh(n * pi * a / (2.0 * b)) / std::pow(n, 5);
  return a * b * b * b * (1.0 / 3.0 - 64.0 * b / (std::pow(pi, 5) * a) * sum);
}

BeamArea ring(double outer, double inner) {
  const double quarter = 0.25 * pi * (std::pow(outer, 4) - std::pow(inner, 4));
  return {pi * (outer * outer - inner * inner), quarter, 0.0, quarter, 2.0 * quarter};
}

std::vector<Strip> box_strips(const std::vector<double>& d) {
  const double a = d[0], b = d[1], t1 = d[2], t2 = d[3], t3 = d[4], t4 = d[5];
  const double inside_height = b - t2 - t4, middle = 0.5 * (t4 - t2);
  return {{0.0, 0.5 * (b - t2), a, t2},
          {0.0, -0.5 * (b - t4), a, t4},
          {0.5 * (a - t1), middle, t1, inside_height},
          {-0.5 * (a - t3), middle, t3, inside_height}};
}

/// Bredt: J = 4 (enclosed area)^2 / integral of ds / t, on the middle line. Sides t1 (right), t2 (top), t3 (left), t4 (bottom).
BeamArea box_area(const std::vector<double>& d) {
  const double a = d[0], b = d[1], t1 = d[2], t2 = d[3], t3 = d[4], t4 = d[5];
  BeamPoint centroid;
  BeamArea area = open_area(box_strips(d), centroid);
  const double width = a - 0.5 * (t1 + t3), height = b - 0.5 * (t2 + t4);
  area.torsion = 4.0 * std::pow(width * height, 2) / (height / t1 + width / t2 + height / t3 + width / t4);
  return area;
}

/// l, h, b1 (bottom), b2 (top), t1 (bottom), t2 (top), t3 (web): strips from the bottom.
std::vector<Strip> i_strips(const std::vector<double>& d) {
  const double h = d[1], b1 = d[2], b2 = d[3], t1 = d[4], t2 = d[5], t3 = d[6];
  return {{0.0, 0.5 * t1, b1, t1}, {0.0, h - 0.5 * t2, b2, t2}, {0.0, 0.5 * (h + t1 - t2), t3, h - t1 - t2}};
}

/// Shear factors of the profiles (Cowper, J. Appl. Mech. 33 (1966) 335-340, rounded as Abaqus does).
double shear_factor(BeamProfile::Shape shape) {
  switch (shape) {
    case BeamProfile::Shape::rectangle: return 0.85;
    case BeamProfile::Shape::circle: return 0.89;
    case BeamProfile::Shape::pipe: return 0.53;
    case BeamProfile::Shape::box: return 0.44;
    case BeamProfile::Shape::i_section: return 0.44;
    case BeamProfile::Shape::general: return 1.0;
  }
  return 1.0;
}

std::vector<BeamPoint> stress_points(const BeamProfile& profile) {
  const auto& d = profile.dimensions;
  const auto corners = [](double x, double y) {
    return std::vector<BeamPoint>{{-x, -y}, {x, -y}, {-x, y}, {x, y}};
  };
  switch (profile.shape) {
    case BeamProfile::Shape::rectangle:
    case BeamProfile::Shape::box: return corners(0.5 * d[0], 0.5 * d[1]);
    case BeamProfile::Shape::circle:
    case BeamProfile::Shape::pipe:
      return {{0.0, -d[0], d[0]}, {d[0], 0.0, d[0]}, {0.0, d[0], d[0]}, {-d[0], 0.0, d[0]}};
    case BeamProfile::Shape::i_section: {
      const double bottom = -d[0], top = d[1] - d[0];
      return {{-0.5 * d[2], bottom}, {0.5 * d[2], bottom}, {-0.5 * d[3], top}, {0.5 * d[3], top}};
    }
    case BeamProfile::Shape::general: return {{}};
  }
  return {};
}

constexpr double gauss = 0.28867513459481287;  // 1 / (2 sqrt(3))
constexpr std::array<double, 5> simpson{1.0 / 12.0, 1.0 / 3.0, 1.0 / 6.0, 1.0 / 3.0, 1.0 / 12.0};

void add_strip(const Strip& s, std::vector<BeamFibre>& fibres) {
  const bool wide = s.width > s.height;
  for (int i = 0; i < 5; ++i)
    for (const double across : {-gauss, gauss}) {
      const double along = 0.25 * i - 0.5, area = 0.5 * simpson[i] * s.width * s.height;
      fibres.push_back({s.x1 + s.width * (wide ? along : across), s.x2 + s.height * (wide ? across : along), 0.0, area});
    }
}

void add_ring(double outer, double inner, std::vector<BeamFibre>& fibres) {
  constexpr int angles = 8;
  const double span = outer * outer - inner * inner;
  for (const double s : {0.5 - gauss, 0.5 + gauss})
    for (int i = 0; i < angles; ++i) {
      const double r = std::sqrt(inner * inner + s * span), angle = 2.0 * pi * i / angles;
      fibres.push_back({r * std::cos(angle), r * std::sin(angle), r, 0.5 * pi * span / angles});
    }
}

/// Young's and the shear modulus of an isotropic elastic material, from its plane-stress stiffness.
void set_moduli(const Model& model, const Section& section, BeamSection& beam) {
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}: error: *BEAM SECTION: {}", model.where(section.location), what));
  };
  if (section.material < 0) fail("it names no material; add MATERIAL=NAME");
  const Material& material = model.materials[section.material];
  const MaterialLaw* law = find_material_law(material.law);
  if (law == nullptr || law->fibre == nullptr || law->lamina_stiffness == nullptr)
    fail(fmt::format("material {} has no law for beams; give it *ELASTIC, with *PLASTIC if it yields", material.name));
  std::array<double, 9> q{};
  law->lamina_stiffness(material.parameters, q);
  beam.shear_modulus = q[8];
  beam.youngs_modulus = q[0] - q[1] * q[1] / q[4];
  if (!material.options.empty() || material.expansion || section.initially_stressed) {
    beam.law = law_of_section<PointKind::fibre>(material, section);
    beam.fibres = beam_fibres(section.beam);
    beam.points.clear();
    for (const auto& fibre : beam.fibres) beam.points.push_back({fibre.x1, fibre.x2, fibre.lever});
  }
  beam.density = material.density;
  beam.damping_beta = material.damping_beta;
}

}  // namespace

BeamArea beam_area(const BeamProfile& profile) {
  const auto& d = profile.dimensions;
  switch (profile.shape) {
    case BeamProfile::Shape::general: return {d[0], d[1], d[2], d[3], d[4]};
    case BeamProfile::Shape::rectangle: {
      const double area = d[0] * d[1];
      return {area, area * d[1] * d[1] / 12.0, 0.0, area * d[0] * d[0] / 12.0, rectangle_torsion(d[0], d[1])};
    }
    case BeamProfile::Shape::circle: return ring(d[0], 0.0);
    case BeamProfile::Shape::pipe: return ring(d[0], d[0] - d[1]);
    case BeamProfile::Shape::box: return box_area(d);
    case BeamProfile::Shape::i_section: {
      BeamPoint centroid;
      return open_area(i_strips(d), centroid);
    }
  }
  return {};
}

double centroid_height(const BeamProfile& profile) {
  BeamPoint centroid;
  open_area(i_strips(profile.dimensions), centroid);
  return centroid.x2;
}

std::vector<BeamFibre> beam_fibres(const BeamProfile& profile) {
  const auto& d = profile.dimensions;
  std::vector<BeamFibre> fibres;
  switch (profile.shape) {
    case BeamProfile::Shape::general: break;
    case BeamProfile::Shape::rectangle:
      for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 5; ++j)
          fibres.push_back({d[0] * (0.25 * i - 0.5), d[1] * (0.25 * j - 0.5), 0.0, simpson[i] * simpson[j] * d[0] * d[1]});
      break;
    case BeamProfile::Shape::circle: add_ring(d[0], 0.0, fibres); break;
    case BeamProfile::Shape::pipe: add_ring(d[0], d[0] - d[1], fibres); break;
    case BeamProfile::Shape::box:
      for (const auto& strip : box_strips(d)) add_strip(strip, fibres);
      break;
    case BeamProfile::Shape::i_section: {
      const double bottom = centroid_height(profile);
      for (auto strip : i_strips(d)) {
        strip.x2 -= bottom;
        add_strip(strip, fibres);
      }
      break;
    }
  }
  return fibres;
}

BeamSection beam_section(const Model& model, const Section& section) {
  const BeamProfile& profile = section.beam;
  BeamSection beam;
  beam.shape = beam_area(profile);
  beam.points = stress_points(profile);
  if (profile.shape == BeamProfile::Shape::general) {
    beam.youngs_modulus = profile.youngs_modulus;
    beam.shear_modulus = profile.shear_modulus;
    beam.density = profile.density;
  } else {
    set_moduli(model, section, beam);
  }
  const double shear = shear_factor(profile.shape) * beam.shear_modulus * beam.shape.area;
  beam.shear_stiffness = profile.shear_stiffness.value_or(std::array{shear, shear});
  return beam;
}

bool beam_frame(const Point& a, const Point& b, const Point& n1, std::array<Point, 3>& frame) {
  const auto unit = [](const Point& v, double length) { return Point{v[0] / length, v[1] / length, v[2] / length}; };
  const auto cross = [](const Point& u, const Point& v) {
    return Point{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  };
  const Point along{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const Point axis = unit(along, std::hypot(along[0], along[1], along[2]));
  const Point across = cross(axis, n1);
  const double sine = std::hypot(across[0], across[1], across[2]) / std::hypot(n1[0], n1[1], n1[2]);
  if (!(sine > 1e-3)) return false;
  const Point n2 = unit(across, std::hypot(across[0], across[1], across[2]));
  frame = {cross(n2, axis), n2, axis};
  return true;
}

}  // namespace balocco
