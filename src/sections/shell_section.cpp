#include "sections/shell_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/initial_stress.hpp"
#include "math/dense.hpp"
#include "model/diagnostics.hpp"
#include "sections/membrane_section.hpp"

namespace balocco {

namespace {

/// A ply with what its quadratures need of it.
struct PlyModuli {
  PlaneStiffness stiffness;     // in the directions of the section
  std::array<double, 3> shear;  // G11 G22 G12 of transverse shear, likewise
  double density = 0.0, beta = 0.0;
};

class Reader {
 public:
  Reader(const Model& model, const Section& section) : model_(model), section_(section) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: error: *SHELL {}SECTION: {}", model_.where(section_.location),
                                 section_.shell.general ? "GENERAL " : "", what));
  }

  /// Adds a ply's law, and returns its moduli at rest.
  PlyModuli add_ply(const Ply& ply, ShellSection& result) const {
    if (ply.material < 0) fail("it names no material; add MATERIAL=NAME");
    const Material& material = model_.materials[ply.material];
    ShellPly shell_ply;
    shell_ply.law = law_of_section<PointKind::plane>(material, section_);
    if (shell_ply.law == nullptr)
      fail(fmt::format("material {} has no plane-stress law; give it *ELASTIC or *HYPERELASTIC", material.name));
    const MaterialLaw* law = find_material_law(material.law);
    shell_ply.turned = ply.angle != 0.0;
    shell_ply.cosine = std::cos(ply.angle);
    shell_ply.sine = std::sin(ply.angle);

    std::vector<double> history(shell_ply.law->history_size(), 0.0);
    shell_ply.initial_modulus = undeformed_modulus(*shell_ply.law, history);
    PlyModuli moduli;
    std::array<double, 3> stress;
    PlaneStiffness own;
    shell_ply.law->tangent(std::array<double, 3>{}, 0.0, history, stress, own);
    moduli.stiffness = rotated_stiffness(own, ply.angle);
    const std::array<double, 2> g =
        law->transverse_shear != nullptr ? law->transverse_shear(material.parameters) : std::array{own[8], own[8]};
    if (!(g[0] > 0.0 && g[1] > 0.0))
      fail(fmt::format("material {} has no stiffness in transverse shear; give G13 and G23", material.name));
    const double c = shell_ply.cosine, s = shell_ply.sine;
    moduli.shear = {c * c * g[0] + s * s * g[1], s * s * g[0] + c * c * g[1], c * s * (g[0] - g[1])};
    moduli.density = material.density;
    moduli.beta = material.damping_beta;
    result.linear = result.linear && law->lamina_stiffness != nullptr && material.options.empty() && !material.expansion &&
                    !section_.initially_stressed;
    result.damping_beta = std::max(result.damping_beta, material.damping_beta);
    result.plies.push_back(std::move(shell_ply));
    return moduli;
  }

 private:
  const Model& model_;
  const Section& section_;
};

void add(const PlaneStiffness& stiffness, double factor, double height, double weight, ShellStiffness& sum) {
  for (int i = 0; i < 9; ++i) {
    sum.membrane[i] += factor * weight * stiffness[i];
    sum.coupling[i] += factor * weight * height * stiffness[i];
    sum.bending[i] += factor * weight * height * height * stiffness[i];
  }
}

/// Shear stiffness along direction `axis` from the energy of the shear stress that balances cylindrical bending: 5/6 G
/// h of a homogeneous plate (Whitney, J. Appl. Mech. 40, 1973).
double balanced_shear(const ShellSection& section, const std::vector<PlyModuli>& moduli, int axis) {
  double stretch = 0.0, first = 0.0, second = 0.0;
  for (std::size_t p = 0; p < moduli.size(); ++p) {
    const double q = moduli[p].stiffness[4 * axis], a = section.plies[p].bottom, b = section.plies[p].top;
    stretch += q * (b - a);
    first += q * (b * b - a * a) / 2.0;
    second += q * (b * b * b - a * a * a) / 3.0;
  }
  const double neutral = first / stretch, rigidity = second - neutral * first;
  double flow = 0.0,
         energy = 0.0;  // integral of q (z - neutral) from the bottom; twice the energy of a unit shear force
  for (std::size_t p = 0; p < moduli.size(); ++p) {
    const double q = moduli[p].stiffness[4 * axis], a = section.plies[p].bottom, b = section.plies[p].top;
    const auto flow_at = [&](double z) { return flow + q * ((z * z - a * a) / 2.0 - neutral * (z - a)); };
    for (const auto& point : thickness_rule(3, true)) {  // exact: a square of a parabola
      const double stress = flow_at(0.5 * (a + b) + point.position * (b - a)) / rigidity;
      energy += point.weight * (b - a) * stress * stress / moduli[p].shear[axis];
    }
    flow = flow_at(b);
  }
  return 1.0 / energy;
}

void add_layers(const Section& input, const std::vector<Ply>& plies, const std::vector<PlyModuli>& moduli,
                ShellSection& section) {
  double height = section.bottom, mass = 0.0;
  for (std::size_t p = 0; p < plies.size(); ++p) {
    const double share = plies[p].thickness / section.thickness;
    ShellPly& ply = section.plies[p];
    ply.bottom = height;
    ply.top = height + share;
    for (const auto& point : thickness_rule(plies[p].points, input.shell.gauss)) {
      const ShellLayer layer{static_cast<int>(p), section.history_size, height + share * (0.5 + point.position),
                             share * point.weight};
      section.history_size += ply.law->history_size();
      section.layers.push_back(layer);
      add(moduli[p].stiffness, 1.0, layer.height, layer.weight, section.stiffness);
      add(moduli[p].stiffness, moduli[p].beta, layer.height, layer.weight, section.damping);
    }
    mass += moduli[p].density * share;
    section.rotary += moduli[p].density * (std::pow(ply.top, 3) - std::pow(ply.bottom, 3)) / 3.0;
    section.shear[2] += moduli[p].shear[2] * share * 5.0 / 6.0;
    height = ply.top;
  }
  section.density = mass;
  if (mass > 0.0) section.rotary /= mass;
  section.shear[0] = balanced_shear(section, moduli, 0);
  section.shear[1] = balanced_shear(section, moduli, 1);
}

/// *SHELL GENERAL SECTION with its own constants: column by column 11, 12, 22, 13, ...
void set_general_stiffness(const Section& input, const Reader& reader, ShellSection& section) {
  Dense<6, 6> d;
  std::size_t k = 0;
  for (int column = 0; column < 6; ++column)
    for (int row = 0; row <= column; ++row) d(row, column) = d(column, row) = input.shell.stiffness[k++];
  if (!(symmetric_eigenvalues(d.component, 6).front() > 0.0))
    reader.fail(
        "its stiffness is not positive definite; check the order of the 21 constants: D11, D12, D22, D13, ... D66");
  const double h = section.thickness;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      section.stiffness.membrane[3 * i + j] = d(i, j) / h;
      section.stiffness.coupling[3 * i + j] = d(i, j + 3) / (h * h);
      section.stiffness.bending[3 * i + j] = d(i + 3, j + 3) / (h * h * h);
    }
  // Without *TRANSVERSE SHEAR STIFFNESS the sheet is taken as homogeneous: its shear modulus is that in its plane.
  section.shear = {d(2, 2) / h * 5.0 / 6.0, d(2, 2) / h * 5.0 / 6.0, 0.0};
  section.rotary = 1.0 / 12.0 + input.shell.offset * input.shell.offset;
}

}  // namespace

std::vector<QuadraturePoint> thickness_rule(int points, bool gauss) {
  std::vector<QuadraturePoint> rule;
  if (!gauss) {
    if (points == 1) return {{0.0, 1.0}};
    const double weight = 1.0 / (3.0 * (points - 1));
    for (int i = 0; i < points; ++i) {
      const double factor = i == 0 || i == points - 1 ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
      rule.push_back({static_cast<double>(i) / (points - 1) - 0.5, factor * weight});
    }
    return rule;
  }
  // Roots of the Legendre polynomial by Newton's method from Tricomi's estimate.
  for (int i = points; i >= 1; --i) {
    double x = std::cos(M_PI * (i - 0.25) / (points + 0.5)), slope = 1.0;
    for (int iteration = 0; iteration < 10; ++iteration) {
      double p = 1.0, before = 0.0;
      for (int k = 1; k <= points; ++k) {
        const double next = ((2.0 * k - 1.0) * x * p - (k - 1.0) * before) / k;
        before = p;
        p = next;
      }
      slope = points * (x * p - before) / (x * x - 1.0);
      x -= p / slope;
    }
    rule.push_back({0.5 * x, 1.0 / ((1.0 - x * x) * slope * slope)});
  }
  return rule;
}

ShellSection shell_section(const Model& model, const Section& input) {
  const Reader reader(model, input);
  ShellSection section;
  section.nodal_thickness = input.shell.nodal_thickness;
  section.bottom = -0.5 - input.shell.offset;
  section.top = 0.5 - input.shell.offset;
  section.thickness = input.thickness;
  section.linear = true;
  if (!(section.thickness > 0.0))
    reader.fail(fmt::format("its thickness is {}; it must be positive", section.thickness));
  if (!input.shell.stiffness.empty()) {
    set_general_stiffness(input, reader, section);
  } else {
    std::vector<Ply> plies = input.plies;
    if (plies.empty()) plies.push_back({input.thickness, input.material, 0.0, input.shell.points});
    std::vector<PlyModuli> moduli;
    for (const Ply& ply : plies) moduli.push_back(reader.add_ply(ply, section));
    add_layers(input, plies, moduli, section);
    if (input.shell.general) section.linear = true;
  }
  if (input.shell.mass_per_area > 0.0) {
    const double mass = section.density + input.shell.mass_per_area / section.thickness;
    section.rotary = (section.rotary * section.density + (1.0 / 12.0 + input.shell.offset * input.shell.offset) *
                                                             input.shell.mass_per_area / section.thickness) /
                     mass;
    section.density = mass;
  }
  if (!input.shell.transverse_shear.empty())
    for (int i = 0; i < 3; ++i) section.shear[i] = input.shell.transverse_shear[i] / section.thickness;
  return section;
}

}  // namespace balocco
