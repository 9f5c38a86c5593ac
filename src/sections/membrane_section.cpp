#include "sections/membrane_section.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/diagnostics.hpp"

namespace balocco {

namespace {

void add_initial_moduli(MembraneSection& result) {
  std::vector<double> history(result.law->history_size(), 0.0);
  const std::array<double, 3> undeformed{};
  std::array<double, 3> stress;
  result.initial_modulus = undeformed_modulus(*result.law, history);
  result.law->tangent(undeformed, 0.0, history, stress, result.initial_stiffness);
}

}  // namespace

double undeformed_modulus(const Law<PointKind::plane>& law, std::span<const double> history) {
  PointBatch<PointKind::plane> points;
  points.count = pack_size;
  std::vector<double> histories(history.size() * pack_size);
  for (std::size_t c = 0; c < history.size(); ++c)
    std::fill_n(histories.begin() + static_cast<std::ptrdiff_t>(c * pack_size), pack_size, history[c]);
  points.history = histories.data();
  points.history_stride = pack_size;
  for (auto& component : points.strain) std::fill_n(component, pack_size, 0.0);
  law.stress(points);
  return 2.0 * points.shear_modulus[0];
}

MembraneSection membrane_section(const Model& model, const Section& section) {
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}: error: *MEMBRANE SECTION: {}", model.where(section.location), what));
  };
  MembraneSection result;
  if (!section.plies.empty()) {
    const Laminate stack = laminate(model, section);
    result.law = linear_plane_law(stack.stiffness);
    if (section.initially_stressed) result.law = initially_stressed(std::move(result.law));
    result.thickness = stack.thickness;
    result.density = stack.density;
    result.damping_stiffness = stack.damping_stiffness;
    for (const Ply& ply : section.plies)
      result.damping_beta = std::max(result.damping_beta, model.materials[ply.material].damping_beta);
    result.linear = true;
    add_initial_moduli(result);
  } else {
    if (section.material < 0) fail("it names no material; add MATERIAL=NAME");
    const Material& material = model.materials[section.material];
    result.law = law_of_section<PointKind::plane>(material, section);
    if (result.law == nullptr)
      fail(fmt::format("material {} has no plane-stress law; give it *ELASTIC or *HYPERELASTIC", material.name));
    result.thickness = section.thickness;
    result.density = material.density;
    result.damping_beta = material.damping_beta;
    result.linear = find_material_law(material.law)->lamina_stiffness != nullptr && material.options.empty() && !material.expansion;
    add_initial_moduli(result);
    for (int i = 0; i < 9; ++i) result.damping_stiffness[i] = material.damping_beta * result.initial_stiffness[i];
  }
  if (!(result.thickness > 0.0)) fail(fmt::format("its thickness is {}; it must be positive", result.thickness));
  return result;
}

}  // namespace balocco
