// Beam B31: two nodes, finite rotations, flexible in shear; elastic sections, or fibres with laws (sections/beam_section.hpp).
//
// The kernel's one integration point bends with the curvature of the middle alone. What the linear moment over the element adds to
// the deflection, L^2 / (12 E I), is put to the shear flexibility (MacNeal's residual bending flexibility, Comput. Struct. 8 (1978)
// 175-183): one straight element is then exact for small deflections, and thin ones do not lock.
#pragma once

#include <vector>

#include "elements/aligned_vector.hpp"
#include "elements/beams/beam_kernel.hpp"
#include "elements/element_group.hpp"
#include "sections/beam_section.hpp"

namespace balocco {

/// History of an element: the energy dissipated by viscosity, its six strains and viscous resultants, then what the section's fibres
/// remember.
class BeamGroup final : public ElementGroup {
 public:
  /// @throws InputError if the section lacks a material or stiffness, n1 runs along the axis or the nodes coincide.
  explicit BeamGroup(const GroupInput& input);

  int history_size() const override { return fibre_row(static_cast<int>(section_data_.fibres.size())); }
  void initialize_history(std::span<double> history) const override;
  void lumped_volume(std::int32_t element, std::span<double> volume) const override;
  double density() const override { return section_data_.density; }
  /// At least the physical inertia, and so much that shear and bending never oscillate faster than waves along the axis:
  /// the stable increment of any beam is L / sqrt(E / rho).
  void lumped_rotary_inertia(std::int32_t element, std::span<double> inertia) const override;
  /// That of the section about its axes, over half of the length.
  void material_rotary_inertia(std::int32_t element, std::span<double> tensors) const override;
  StableIncrement add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                             std::span<double> history) const override;
  bool linearize(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history,
                 std::span<double> new_history, std::span<double> force, std::span<double> stiffness) const override;
  ElementEnergies energies(std::int32_t element, const NodalMotion& motion, std::span<const double> history) const override;
  int point_components(std::string_view variable) const override;
  void point_output(std::string_view variable, std::int32_t element, int integration_point, const NodalMotion& motion,
                    std::span<const double> history, std::span<double> values) const override;
  int integration_points() const override { return static_cast<int>(section_data_.points.size()); }
  int law_field_row(std::string_view field, int point) const override;
  std::size_t bytes_per_element() const override;

 private:
  /// Reference data of an element, a structure of arrays of packs: E (9), L, stiffness of shear 11 22 12, rotary inertia, square of
  /// the highest frequency.
  enum Row { frame = 0, length = 9, shear = 10, inertia = 13, frequency = 14, rows = 15 };
  double reference(std::int32_t element, int row) const {
    return records_[(element / pack_size * rows + row) * pack_size + element % pack_size];
  }
  double& reference(std::int32_t element, int row) {
    return records_[(element / pack_size * rows + row) * pack_size + element % pack_size];
  }
  const double* record(std::int32_t first) const { return records_.data() + first * rows; }

  /// History: dissipation, strains, viscous resultants after the last increment, then the fibres'.
  static constexpr int strain_row = 1, viscous_row = 7;
  int fibre_row(int fibre) const { return viscous_row + 6 + (section_data_.law ? fibre * section_data_.law->history_size() : 0); }
  void set_reference(const Model& model, std::int32_t element);
  std::array<double, 3> element_shear_stiffness(double length) const;
  void set_inertia(std::int32_t element, const std::array<double, 3>& shear);
  template <class T>
  BeamVector<T> resultants(const BeamVector<T>& strain, const std::array<T, 3>& shear) const;
  BeamKinematics<double> kinematics_at(std::int32_t element, const NodalMotion& motion) const;
  /// Resultants `increment` after the old `history` of the element, which is new on return.
  template <class T>
  BeamVector<T> response(std::int32_t element, const BeamVector<T>& strain, double increment, std::span<double> history) const;
  void add_fibres(std::int32_t first, const BeamVector<Pack>& strain, double increment, std::span<double> history,
                  BeamVector<Pack>& resultant) const;
  void add_pack(std::int32_t first, const ExplicitCycle& cycle, std::span<double> history, StableIncrement& stable) const;
  Pack add_viscosity(std::int32_t first, const BeamVector<Pack>& strain, const ExplicitCycle& cycle, std::span<double> history,
                     BeamVector<Pack>& resultant) const;

  BeamSection section_data_;
  AlignedVector<double> records_;  // [pack][row][lane]
};

template <class T>
BeamVector<T> BeamGroup::resultants(const BeamVector<T>& strain, const std::array<T, 3>& shear) const {
  const BeamArea& shape = section_data_.shape;
  const double e = section_data_.youngs_modulus;
  return {shear[0] * strain[0] + shear[2] * strain[1],
          shear[2] * strain[0] + shear[1] * strain[1],
          (e * shape.area) * strain[2],
          (e * shape.i11) * strain[3] - (e * shape.i12) * strain[4],
          (e * shape.i22) * strain[4] - (e * shape.i12) * strain[3],
          (section_data_.shear_modulus * shape.torsion) * strain[5]};
}

/// Longitudinal strain of a fibre: stretch of the axis and bending.
template <class T, class Place>
T fibre_strain(const BeamVector<T>& strain, const Place& at) {
  return strain[2] + at.x2 * strain[3] - at.x1 * strain[4];
}

/// Adds what a fibre under second Piola-Kirchhoff stresses (S11, S12) pulls and twists with; `along` as fibre_strain gives it.
template <class T>
void add_fibre(const BeamFibre& fibre, const T& along, const T& axial, const T& shearing, BeamVector<T>& resultant) {
  const T pull = fibre.area * (axial * (1.0 + along));
  resultant[2] = resultant[2] + pull;
  resultant[3] = resultant[3] + fibre.x2 * pull;
  resultant[4] = resultant[4] - fibre.x1 * pull;
  resultant[5] = resultant[5] + (fibre.area * fibre.lever) * shearing;
}

}  // namespace balocco
