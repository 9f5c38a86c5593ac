// C3D8R: the one-point brick with uniform strain and physical hourglass stiffness.
#pragma once

#include <array>

#include "elements/aligned_vector.hpp"
#include "elements/element_group.hpp"
#include "elements/solids/reduced_brick_flow.hpp"
#include "elements/solids/reduced_brick_kernel.hpp"
#include "elements/solids/solid_reference.hpp"

namespace balocco {

inline constexpr int nodes_per_brick = 8;

class ReducedBrick final : public ElementGroup {
 public:
  explicit ReducedBrick(const GroupInput& input);

  int history_size() const override { return law_row_ + material_.law->history_size(); }
  void initialize_history(std::span<double> history) const override;
  int law_field_row(std::string_view field, int) const override {
    const int row = field_row(*material_.law, field);
    return row < 0 ? row : law_row_ + row;
  }
  void lumped_volume(std::int32_t element, std::span<double> volume) const override;
  double density() const override { return material_.density; }
  StableIncrement add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                             std::span<double> history) const override;
  bool linearize(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history,
                 std::span<double> new_history, std::span<double> force, std::span<double> stiffness) const override;
  ElementEnergies energies(std::int32_t element, const NodalMotion& motion,
                           std::span<const double> history) const override;
  void energies(std::int32_t first, const NodalMotion& motion, std::span<const double> group_history,
                std::span<ElementEnergies> of_lanes) const override;
  int point_components(std::string_view variable) const override;
  void point_output(std::string_view variable, std::int32_t element, int integration_point, const NodalMotion& motion,
                    std::span<const double> history, std::span<double> values) const override;
  int integration_points() const override { return 1; }
  std::size_t bytes_per_element() const override;

 private:
  /// Jacobian, viscous dissipation and viscous mean stress after the last increment; then what HourglassFlow keeps, if anything
  /// yields; then the law's.
  static constexpr int own_history = 3;
  using Hourglass = BrickHourglass;

  template <Hourglass hourglass, bool damped>
  StableIncrement add_packs(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                            std::span<double> history) const;
  template <Hourglass hourglass, bool damped>
  Pack add_pack(std::int32_t element, const ExplicitCycle& cycle, PointBatch<PointKind::solid>& points,
                std::span<double> history) const;

  std::array<Vector3<Pack>, nodes_per_brick> gather_nodes(std::int32_t element, const double* nodal) const;
  void pack_energies(std::int32_t element, const NodalMotion& motion, std::span<const double> history,
                     std::span<ElementEnergies, pack_size> of_lanes) const;
  static ElementEnergies element_energies(double volume, const EnergyDensity& density, double hourglass, double dissipation) {
    return {.strain = volume * density.recoverable,
            .hourglass = hourglass,
            .viscous = dissipation + volume * density.viscous,
            .plastic = volume * density.plastic,
            .heat = volume * density.heat};
  }
  /// Energy of the hourglass stresses, with what their flow has dissipated; `history(k)`: component k of the element's history.
  template <class T, class Reference>
  T artificial_energy(const HexahedronCoefficients<T>& c, const Matrix3<T>& f, const Reference& reference, const auto& history) const {
    if (!flow_.active()) {
      const auto q = hourglass_vectors(c, f, reference);
      return with_moduli(reference, [&](const auto& shape) { return hourglass_energy(c, q, shape, hourglass_ != Hourglass::scalar); });
    }
    const FlowedReference<T, Reference> shape(reference, flow_, own_history, history);
    const T elastic = hourglass_energy(hourglass_strains(c, hourglass_vectors(c, f, shape)), shape);
    const T given_up = history(own_history + HourglassFlow::dissipated);
    return given_up + (flow_.failure < 0 ? elastic : select(history(flow_.failure) > 0.0, T(0.0), elastic));
  }

  /// Force (and stiffness) of one element over any scalar: T = double or Dual<24>. `history(k)`: component k of the element's history
  /// whose law's part is new.
  template <class T>
  std::array<Vector3<T>, 8> static_forces(const HexahedronCoefficients<T>& c, const Matrix3<T>& f, const Matrix3<T>& stress,
                                          const LaneReference& reference, const auto& history) const;
  /// Lets the hourglass shape flow: `history` has the law's new part, the rest of it is old.
  void advance_shape(const HexahedronCoefficients<double>& c, const Matrix3<double>& f, const Matrix3<double>& stress,
                     const LaneReference& reference, std::span<double> history) const;
  /// hourglass_return() of hourglass vectors before their flow.
  template <class T>
  HourglassReturn<T> return_of(const HexahedronCoefficients<T>& c, const Matrix3<T>& f, const Matrix3<T>& stress,
                               const HourglassTrial<T>& trial, const LaneReference& reference, const auto& history) const {
    const T plastic_strain = history(flow_.plastic_strain) + history(own_history + HourglassFlow::hardening);
    return hourglass_return(centre_mises(stress, f), plastic_strain, c, trial.stress, trial.energy,
                            T(reference[brick_record::volume]), flow_);
  }
  template <class T>
  HexahedronCoefficients<T> coefficients_of(std::int32_t element, const double* position) const;
  /// Calls `use` with a record whose hourglass moduli are there to be read, where nothing flows.
  auto with_moduli(const auto& reference, auto&& use) const {
    return hourglass_ == Hourglass::isotropic ? use(IsotropicShape{reference, poisson_}) : use(reference);
  }
  /// Of the pack that an element is in.
  const double* record(std::int32_t element) const {
    return records_.data() + static_cast<std::size_t>(element / pack_size) * pack_size * static_cast<std::size_t>(record_size_);
  }
  LaneReference reference(std::int32_t element) const { return {record(element) + element % pack_size}; }

  SolidMaterial material_;
  HourglassFlow flow_;
  Hourglass hourglass_;
  double poisson_;  // of isotropic hourglass moduli
  int record_size_;
  int law_row_;  // where the law's history begins
  AlignedVector<double> records_;  // [pack][component][lane]
};

}  // namespace balocco
