// The register of material laws and the interface through which element kernels drive them.
//
// A law is a plain aggregate with one templated stress function (T = Pack in the explicit loop, Dual in the implicit
// solver). Elements and laws meet in small batches of material points, so compile time grows with elements + laws.
// Adding a law = its own header and source file in this folder, ending in one line of registration.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "math/scalar.hpp"

namespace balocco {

struct Material;  // model/model.hpp

/// Kinematics seen by a law.
/// solid: deformation gradient F (row-major 9) -> first Piola-Kirchhoff stress P (9).
/// The others: Green-Lagrange strain -> second Piola-Kirchhoff stress, all other stresses being zero:
/// plane: E11 E22 2E12 in the material directions -> S11 S22 S12;  line: E -> S;
/// fibre: E11 2E12 -> S11 S12 (a point of a beam's section: axial and one shear strain).
enum class PointKind { solid, plane, line, fibre };

constexpr int strain_size(PointKind kind) {
  return kind == PointKind::solid ? 9 : kind == PointKind::plane ? 3 : kind == PointKind::fibre ? 2 : 1;
}

/// An increment of time so long that every viscous stress relaxes and every rate vanishes: that of statics.
inline constexpr double quasi_static = std::numeric_limits<double>::infinity();

/// Up to `capacity` material points, structure of arrays, small enough to stay in L1.
template <PointKind kind>
struct PointBatch {
  static constexpr int capacity = 64;
  static constexpr int size_of_strain = strain_size(kind);
  int first = 0;  // the law works on points first .. first + count - 1; both are multiples of pack_size
  int count = 0;
  double increment = 0.0;  // time that led from the old history to these strains; 0: none passed, nothing flows
  alignas(64) double strain[size_of_strain][capacity];
  alignas(64) double stress[size_of_strain][capacity];
  /// Upper bounds of the tangent that the stable increment needs. solid: second variation of the energy density
  /// <= volumetric * (F^-T : dF)^2 + 2 * shear * dF : dF. Others: <= 2 * shear * dE : dE, volumetric unused.
  alignas(64) double volumetric_modulus[capacity];
  alignas(64) double shear_modulus[capacity];
  double* history = nullptr;  // history[component * history_stride + point - first]; in: old, out: new
  std::ptrdiff_t history_stride = 0;
};

/// Energies per reference volume.
struct EnergyDensity {
  double recoverable = 0.0;
  double plastic = 0.0;  // dissipated
  double viscous = 0.0;  // dissipated
  double heat = 0.0;     // work that thermal expansion has done on the material: what came into it beside the work of forces
};

/// A part of a law's history. Scalars are output variables by their names; each history is zero in the undeformed state.
struct HistoryField {
  std::string name;
  int first = 0, components = 1;
};

template <PointKind kind>
class Law {
 public:
  static constexpr int n = strain_size(kind);
  virtual ~Law() = default;
  virtual int history_size() const { return 0; }
  virtual std::vector<HistoryField> history_fields() const { return {}; }
  /// Stress, moduli and new history of a batch.
  virtual void stress(PointBatch<kind>& points) const = 0;
  /// Stress and its exact derivative (row-major n x n, unless `stiffness` is empty) at one point, `increment` after the
  /// old history; `history` is old on entry and new on return.
  virtual void tangent(std::span<const double, n> strain, double increment, std::span<double> history,
                       std::span<double, n> stress, std::span<double> stiffness) const = 0;
  /// Derivatives, by the strain, of the rows of the history from `row` on that `increment` after the old one closes at `strain`: n for
  /// each row, as many rows as `slopes` has room for.
  virtual void history_slopes(std::span<const double, n> strain, double increment, std::span<const double> old_history, int row,
                              std::span<double> slopes) const;
  /// Whether the shear bound of a solid is |F^-1|^2 times one of the spatial gradient, d2W <= volumetric (tr l)^2 + 2 shear l : l
  /// with l = dF F^-1, which is the sharper one then.
  virtual bool bounds_spatial_gradient() const { return false; }
  /// Energies of the state that `history` closed at `strain`.
  virtual EnergyDensity energy_density(std::span<const double, n> strain, std::span<const double> history) const = 0;
  /// The same bits for every point of a batch, with history[component * stride + point - first].
  virtual void energy_densities(const PointBatch<kind>& points, const double* history, std::ptrdiff_t stride,
                                std::span<EnergyDensity> densities) const {
    std::array<double, n> strain;
    std::vector<double> own(static_cast<std::size_t>(history_size()));
    for (int i = 0; i < points.count; ++i) {
      for (int k = 0; k < n; ++k) strain[k] = points.strain[k][points.first + i];
      for (std::size_t k = 0; k < own.size(); ++k) own[k] = history[static_cast<std::ptrdiff_t>(k) * stride + i];
      densities[static_cast<std::size_t>(i)] = energy_density(strain, own);
    }
  }
  /// Ratio of current to reference thickness of a plane point or section of a line (1 where the law has no say).
  virtual double transverse_stretch(std::span<const double, n> strain, std::span<const double> history) const = 0;
};

template <PointKind kind>
void Law<kind>::history_slopes(std::span<const double, n>, double, std::span<const double>, int, std::span<double> slopes) const {
  for (double& component : slopes) component = 0.0;
}

/// Row of a scalar of a law's history, an output variable by that name; -1 if the law has none.
template <PointKind kind>
int history_scalar(const Law<kind>& law, std::string_view name) {
  for (const auto& field : law.history_fields())
    if (field.components == 1 && field.name == name) return field.first;
  return -1;
}

/// One parameter of a law or option, declared once: read by the deck reader, its messages and the manual.
struct ParameterSpec {
  std::string name;
  double minimum, maximum;  // exclusive bounds
  std::string description;
};

/// Exclusive bounds of parameters.
inline constexpr double unbounded = 1e300;
inline constexpr double from_zero = -std::numeric_limits<double>::min();  // lets 0 itself pass

/// What makes a law of a material; null where the law has no such form.
template <PointKind kind>
using LawMaker = std::unique_ptr<Law<kind>> (*)(const Material&);

/// A law: the one keyword of a material that gives its elastic response. Options below modify it (material_option.hpp).
struct MaterialLaw {
  std::string name;     // "neo-hooke"
  std::string keyword;  // "HYPERELASTIC"
  std::string variant;  // "NEO HOOKE" or "TYPE=LAMINA"'s value; empty for the keyword's default
  int order = 0;        // N of the keyword line that the variant belongs to; 0: it has none
  std::vector<ParameterSpec> parameters;
  std::vector<std::string> options;  // names of the options that this law can take
  LawMaker<PointKind::solid> solid = nullptr;
  LawMaker<PointKind::plane> plane = nullptr;
  LawMaker<PointKind::line> line = nullptr;
  LawMaker<PointKind::fibre> fibre = nullptr;
  /// Plane-stress stiffness Q (row-major 3 x 3, material directions) for lamination theory; null where not linear
  /// elastic.
  void (*lamina_stiffness)(std::span<const double> parameters, std::span<double, 9> stiffness) = nullptr;
  /// Moduli G13 and G23 of transverse shear in shells; null: both are the shear modulus in the plane, dS12 / d(2E12) at rest.
  std::array<double, 2> (*transverse_shear)(std::span<const double> parameters) = nullptr;

  template <PointKind kind>
  LawMaker<kind> maker() const {
    if constexpr (kind == PointKind::solid) return solid;
    if constexpr (kind == PointKind::plane) return plane;
    if constexpr (kind == PointKind::line) return line;
    if constexpr (kind == PointKind::fibre) return fibre;
  }
};

/// The law of that name, or nullptr.
const MaterialLaw* find_material_law(std::string_view name);
/// All registered laws, sorted by name.
std::vector<const MaterialLaw*> material_laws();

/// The law of a material in one form, with all its options; null if it has no law or no such form.
/// @throws InputError if its parameters do not fit together
template <PointKind kind>
std::unique_ptr<Law<kind>> make_law(const Material& material);

struct RegisterLaw {
  explicit RegisterLaw(MaterialLaw law);
};

}  // namespace balocco
