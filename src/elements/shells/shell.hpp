// Shells S4 (2 x 2 points), S4R (one point, the rest of its fields as physical hourglass control) and S3R: finite
// membrane strain and rotation, transverse shear, sections integrated through the thickness.
#pragma once

#include <algorithm>
#include <vector>

#include "elements/aligned_vector.hpp"
#include "elements/element_group.hpp"
#include "elements/shells/shell_kernel.hpp"
#include "elements/shells/shell_reference.hpp"
#include "sections/shell_section.hpp"

namespace balocco {

/// History of an element: the section's (point by point, layer by layer), the area ratio, the energy dissipated by
/// viscosity, and with stiffness-proportional damping the mean strains E11 E22 2E12 K11 K22 2K12. Integration points
/// are counted layer by layer from SNEG to SPOS at each point of the surface in turn.
template <int corners, int points>
class ShellGroup final : public ElementGroup {
 public:
  explicit ShellGroup(const GroupInput& input);

  int history_size() const override;
  void initialize_history(std::span<double> history) const override;
  void lumped_volume(std::int32_t element, std::span<double> volume) const override;
  double density() const override { return section_.density; }
  void lumped_rotary_inertia(std::int32_t element, std::span<double> inertia) const override;
  /// That of the plate around each corner: the same about all axes in its surface, none about the corner's director.
  void material_rotary_inertia(std::int32_t element, std::span<double> tensors) const override;
  StableIncrement add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                             std::span<double> history) const override;
  bool linearize(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history,
                 std::span<double> new_history, std::span<double> force, std::span<double> stiffness) const override;
  ElementEnergies energies(std::int32_t element, const NodalMotion& motion,
                           std::span<const double> history) const override;
  int point_components(std::string_view variable) const override;
  void point_output(std::string_view variable, std::int32_t element, int integration_point, const NodalMotion& motion,
                    std::span<const double> history, std::span<double> values) const override;
  void mean_point_output(std::string_view variable, std::int32_t element, const NodalMotion& motion, std::span<const double> history,
                         std::span<double> values) const override;
  int integration_points() const override { return points * layers(); }
  int law_field_row(std::string_view field, int integration_point) const override;
  std::size_t bytes_per_element() const override;

 private:
  using Record = ShellRecord<corners, points>;
  struct Block;
  template <class T>
  using Rotations = std::array<Matrix3<T>, corners>;

  /// What an element's points of the surface see.
  template <class T>
  struct SurfaceStrain {
    std::array<T, 3> membrane, curvature;
  };

  /// A point of the surface: its strains, the thickness there, and how much of it bears transverse shear.
  struct Place {
    SurfaceStrain<double> strain;
    double thickness, shear_thickness;
  };

  int layers() const { return section_.layers.empty() ? 1 : static_cast<int>(section_.layers.size()); }
  int area_ratio_row() const { return points * section_.history_size; }
  int dissipation_row() const { return area_ratio_row() + 1; }
  int viscous_row() const { return dissipation_row() + 1; }
  int strain_row() const { return viscous_row() + 1; }
  bool damped() const { return section_.damping_beta > 0.0; }
  double* record(std::int32_t element) {
    return record_.data() + static_cast<std::size_t>(element / pack_size) * (Record::size * pack_size) +
           element % pack_size;
  }
  const double* record(std::int32_t element) const { return const_cast<ShellGroup*>(this)->record(element); }

  template <class T>
  static SurfaceStrain<T> strain_at(const double* record, int point, const ShellModes<T, corners>& strain);
  template <class T>
  static void add_resultants(const double* record, int point, const SurfaceStrain<T>& resultants,
                             ShellModes<T, corners>& stress);
  template <class T>
  static void add_hourglass(const double* record, const ShellModes<T, corners>& strain, ShellModes<T, corners>& stress);

  template <class T>
  bool internal_force(const double* record, const ShellKernel<T, corners>& kernel, double increment, std::span<double> history,
                      ShellForces<T, corners>& nodal) const;
  ShellKernel<double, corners> kernel_at(std::int32_t element, const NodalMotion& motion) const;
  void stiffness_at_rest(std::int32_t element, const ShellGeometry& geometry, std::span<double> stiffness) const;

  void output_at(std::string_view variable, std::int32_t element, int integration_point, const ShellModes<double, corners>& strain,
                 std::span<const double> history, std::span<double> values) const;
  void layer_output(std::string_view variable, int point, int layer, const Place& at, std::span<const double> history,
                    std::span<double> values) const;
  void section_output(std::string_view variable, int point, const Place& at, const std::array<double, 2>& shear,
                      std::span<const double> history, std::span<double> values) const;

  void add_linear_point(int point, Block& block) const;
  void add_layers(int point, Block& block, double increment, std::span<double> history) const;
  void add_viscosity(Block& block, int pack, const ExplicitCycle& cycle, std::span<double> history) const;
  Pack stable_increment(const Block& block, int pack, const ExplicitCycle& cycle) const;
  Pack given_up(const Block& block, int pack, std::span<const double> history) const;
  void begin(int pack, Block& block, const ExplicitCycle& cycle) const;
  void finish(Block& block, const ExplicitCycle& cycle, std::span<double> history, StableIncrement& stable) const;

  ShellSection section_;
  std::vector<int> failed_rows_;                    // failure_rows()
  AlignedVector<double> record_;                    // Record::size packs per pack of elements
  std::vector<double> nodal_volume_, nodal_inertia_, plate_inertia_;  // of each corner of each element; the last not raised
};

// The strain of a point of the surface is the mean and, where there are several points, what the modes add there; the
// forces of a point do the same work on both.
template <int corners, int points>
template <class T>
auto ShellGroup<corners, points>::strain_at(const double* record, int point, const ShellModes<T, corners>& strain)
    -> SurfaceStrain<T> {
  SurfaceStrain<T> here{strain.membrane, strain.curvature};
  if constexpr (points > 1)
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < 2; ++a) {
        const auto mode = reference_value<T>(record, Record::point + point * Record::point_size + 2 + 2 * i + a);
        here.membrane[i] = here.membrane[i] + mode * strain.membrane_mode[a];
        here.curvature[i] = here.curvature[i] + mode * strain.bending_mode[a];
      }
  return here;
}

template <int corners, int points>
template <class T>
void ShellGroup<corners, points>::add_resultants(const double* record, int point, const SurfaceStrain<T>& resultants,
                                                 ShellModes<T, corners>& stress) {
  const auto area = reference_value<T>(record, Record::point + point * Record::point_size);
  for (int i = 0; i < 3; ++i) {
    const T n = area * resultants.membrane[i], m = area * resultants.curvature[i];
    stress.membrane[i] = stress.membrane[i] + n;
    stress.curvature[i] = stress.curvature[i] + m;
    if constexpr (points > 1)
      for (int a = 0; a < 2; ++a) {
        const auto mode = reference_value<T>(record, Record::point + point * Record::point_size + 2 + 2 * i + a);
        stress.membrane_mode[a] = stress.membrane_mode[a] + mode * n;
        stress.bending_mode[a] = stress.bending_mode[a] + mode * m;
      }
  }
}

template <int corners, int points>
template <class T>
void ShellGroup<corners, points>::add_hourglass(const double* record, const ShellModes<T, corners>& strain,
                                                ShellModes<T, corners>& stress) {
  if constexpr (Record::one_point_quadrilateral) {
    const auto k = [&](int i) { return reference_value<T>(record, Record::hourglass + i); };
    const auto &s = strain.membrane_mode, &t = strain.bending_mode;
    stress.membrane_mode = {k(0) * s[0] + k(2) * s[1] + k(3) * t[0] + k(5) * t[1],
                            k(2) * s[0] + k(1) * s[1] + k(5) * t[0] + k(4) * t[1]};
    stress.bending_mode = {k(3) * s[0] + k(5) * s[1] + k(6) * t[0] + k(8) * t[1],
                           k(5) * s[0] + k(4) * s[1] + k(8) * t[0] + k(7) * t[1]};
  }
}

}  // namespace balocco
