// The register of material laws and the interface through which element kernels drive them.
//
// A law is a plain aggregate with one templated stress function (T = Pack in the explicit loop, Dual in the implicit
// solver). Elements and laws meet in small batches of material points, so compile time grows with elements + laws.
// Adding a law = its own header and source file in this folder, ending in one line of registration.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "math/pack.hpp"

namespace balocco {

/// Kinematics seen by a law. solid: deformation gradient F (row-major 9) -> first Piola-Kirchhoff stress P (9).
/// plane: Green-Lagrange strain E11 E22 2E12 in the material directions -> second Piola-Kirchhoff S11 S22 S12 (plane
/// stress). line: Green-Lagrange strain E -> second Piola-Kirchhoff stress S (uniaxial stress).
enum class PointKind { solid, plane, line };

constexpr int strain_size(PointKind kind) {
  return kind == PointKind::solid ? 9 : kind == PointKind::plane ? 3 : 1;
}

/// Up to `capacity` material points, structure of arrays, small enough to stay in L1.
template <PointKind kind>
struct PointBatch {
  static constexpr int capacity = 64;
  static constexpr int size_of_strain = strain_size(kind);
  int count = 0;  // a multiple of pack_size
  alignas(64) double strain[size_of_strain][capacity];
  alignas(64) double stress[size_of_strain][capacity];
  /// Upper bounds of the tangent that the stable increment needs. solid: second variation of the energy density
  /// <= volumetric * (F^-T : dF)^2 + 2 * shear * dF : dF. plane, line: <= 2 * shear * dE : dE, volumetric unused.
  alignas(64) double volumetric_modulus[capacity];
  alignas(64) double shear_modulus[capacity];
  double* history = nullptr;  // history[component * history_stride + point]; in: old, out: new
  std::ptrdiff_t history_stride = 0;
};

template <PointKind kind>
class Law {
 public:
  static constexpr int n = strain_size(kind);
  virtual ~Law() = default;
  virtual int history_size() const = 0;
  /// Stress, moduli and new history of a batch.
  virtual void stress(PointBatch<kind>& points) const = 0;
  /// Stress and its exact derivative (row-major n x n) at one point; `history` is old on entry and new on return.
  virtual void tangent(std::span<const double, n> strain, std::span<double> history, std::span<double, n> stress,
                       std::span<double, n * n> stiffness) const = 0;
  /// Recoverable energy per reference volume.
  virtual double energy_density(std::span<const double, n> strain, std::span<const double> history) const = 0;
  /// Ratio of current to reference thickness of a plane point or section of a line (1 where the law has no say).
  virtual double transverse_stretch(std::span<const double, n> strain) const = 0;
};

/// One parameter of a law, declared once: read by the deck reader, its messages and the manual.
struct ParameterSpec {
  std::string name;
  double minimum, maximum;  // exclusive bounds
  std::string description;
};

struct MaterialLaw {
  std::string name;     // "neo-hooke"
  std::string keyword;  // "HYPERELASTIC"
  std::string variant;  // "NEO HOOKE" or "TYPE=LAMINA"'s value; empty for the keyword's default
  std::vector<ParameterSpec> parameters;
  std::unique_ptr<Law<PointKind::solid>> (*solid)(std::span<const double>) = nullptr;  // null: no such form
  std::unique_ptr<Law<PointKind::plane>> (*plane)(std::span<const double>) = nullptr;
  std::unique_ptr<Law<PointKind::line>> (*line)(std::span<const double>) = nullptr;
  /// Plane-stress stiffness Q (row-major 3 x 3, material directions) for lamination theory; null where not linear
  /// elastic.
  void (*lamina_stiffness)(std::span<const double> parameters, std::span<double, 9> stiffness) = nullptr;
  /// Moduli G13 and G23 of transverse shear in shells; null: both are the shear modulus in the plane, dS12 / d(2E12) at rest.
  std::array<double, 2> (*transverse_shear)(std::span<const double> parameters) = nullptr;
};

/// The law of that name, or nullptr.
const MaterialLaw* find_material_law(std::string_view name);
/// All registered laws, sorted by name.
std::vector<const MaterialLaw*> material_laws();

struct RegisterLaw {
  explicit RegisterLaw(MaterialLaw law);
};

}  // namespace balocco
