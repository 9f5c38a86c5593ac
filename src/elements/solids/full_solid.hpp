// Fully integrated solids, one template over shape and quadrature (full_solid_shapes.hpp, nodal_shapes.hpp). The explicit
// kernel is in full_solid_explicit.hpp, the tangent in full_solid_static.hpp: each type compiles them apart.
#pragma once

#include <algorithm>
#include <array>

#include "elements/aligned_vector.hpp"
#include "elements/element_group.hpp"
#include "elements/solids/full_solid_kernel.hpp"
#include "elements/record_reference.hpp"
#include "elements/solids/solid_output.hpp"
#include "elements/solids/solid_reference.hpp"

namespace balocco {

template <class Shape>
class FullSolid final : public ElementGroup {
 public:
  explicit FullSolid(const GroupInput& input);

  int history_size() const override { return law_row(Shape::points); }
  int law_field_row(std::string_view field, int point) const override {
    const int row = field_row(*material_.law, field);
    return row < 0 ? row : law_row(point) + row;
  }
  void initialize_history(std::span<double> history) const override {
    std::fill(history.begin(), history.end(), 0.0);
    history[0] = 1.0;
  }
  double density() const override { return material_.density; }
  void lumped_volume(std::int32_t element, std::span<double> volume) const override {
    for (int node = 0; node < Shape::nodes; ++node) volume[node] = Shape::mass_share[node] * reference(element)[Record::volume];
  }
  StableIncrement add_forces(std::span<const PackRun> runs, const ExplicitCycle& cycle,
                             std::span<double> history) const override;
  bool linearize(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history,
                 std::span<double> new_history, std::span<double> force, std::span<double> stiffness) const override;
  ElementEnergies energies(std::int32_t element, const NodalMotion& motion,
                           std::span<const double> history) const override;
  void energies(std::int32_t first, const NodalMotion& motion, std::span<const double> group_history,
                std::span<ElementEnergies> of_lanes) const override {
    for (std::size_t lane = 0; lane < of_lanes.size(); lane += pack_size)
      pack_energies(first + static_cast<std::int32_t>(lane), motion, group_history, of_lanes.subspan(lane).template first<pack_size>());
  }
  int point_components(std::string_view variable) const override { return solid_output_components(material_, variable); }
  void point_output(std::string_view variable, std::int32_t element, int integration_point, const NodalMotion& motion,
                    std::span<const double> history, std::span<double> values) const override {
    const auto k = kinematics_of(element, motion, history);
    solid_output(variable, material_, k.modified[integration_point], law_history(history, integration_point), values);
  }
  int integration_points() const override { return Shape::points; }
  std::size_t bytes_per_element() const override {
    return sizeof(double) * (Record::size + history_size()) + sizeof(std::int32_t) * (2 * Shape::nodes + 1);
  }

 private:
  using Record = FullSolidRecord<Shape>;
  static_assert(!Shape::explicit_steps || Shape::points * pack_size <= PointBatch<PointKind::solid>::capacity);
  template <class T>
  using Coefficients = std::array<Vector3<T>, Shape::modes>;
  template <class T>
  using Tensors = std::array<Matrix3<T>, Shape::points>;

  using Tangents = std::array<std::array<double, 81>, Shape::points>;

  // Jbar, viscous dissipation and mean stress after the last increment, amplitudes of bubbles; then the law's, by point.
  static constexpr int first_bubble = 3, own_history = has_bubbles<Shape> ? 12 : 3;

  int law_row(int point) const { return own_history + point * material_.law->history_size(); }
  template <class T>
  std::span<T> law_history(std::span<T> history, int point) const {
    return history.subspan(law_row(point), material_.law->history_size());
  }
  /// Stresses and bounds of all points of a pack of elements.
  void respond(std::int32_t element, double increment, PointBatch<PointKind::solid>& points,
               std::span<double> history) const;
  void pack_energies(std::int32_t element, const NodalMotion& motion, std::span<const double> history,
                     std::span<ElementEnergies, pack_size> of_lanes) const;
  Coefficients<Pack> gather_coefficients(std::int32_t element, const double* nodal) const;
  Pack add_pack(std::int32_t element, const ExplicitCycle& cycle, PointBatch<PointKind::solid>& points,
                std::span<double> history) const;
  /// Adds beta * (initial stiffness : rate) to the stresses; returns the power.
  Pack add_damping(std::int32_t element, const ExplicitCycle& cycle, const FullSolidKinematics<Pack, Shape>& k,
                   Tensors<Pack>& stress) const;
  Pack stable_increment(const Coefficients<Pack>& c, const FullSolidKinematics<Pack, Shape>& k, const Tensors<Pack>& stress,
                        const PointBatch<PointKind::solid>& points, const Pack& viscous_slope, const Pack& damping_beta,
                        const PackReference& reference) const;
  /// Bound of the elastic stiffness; `dilatation` is V |d(ln Jbar)/dx|^2.
  Pack stiffness_bound(const Coefficients<Pack>& c, const FullSolidKinematics<Pack, Shape>& k, const Tensors<Pack>& stress,
                       const PointBatch<PointKind::solid>& points, const Pack& dilatation, const PackReference& reference) const;
  /// Largest eigenvalue of sum_q w (F^-T : dF)^2 over the nodes of a free element, masses weighed in; at least that of V tau^2.
  Pack dilatation_bound(const FullSolidKinematics<Pack, Shape>& k, const Pack& of_mean, const PackReference& reference) const;
  void stiffness_of_mean(const FullSolidKinematics<double, Shape>& k, const LaneReference& record, const Tensors<double>& stress,
                         const Tangents& tangent, std::span<double> stiffness) const;
  void stiffness_of_points(const LaneReference& record, const Tangents& tangent, std::span<double> stiffness) const;
  template <class T>
  Coefficients<T> coefficients_of(std::int32_t element, const double* position) const;
  /// Of one element with its own history.
  FullSolidKinematics<double, Shape> kinematics_of(std::int32_t element, const NodalMotion& motion,
                                                   std::span<const double> history) const {
    BubbleAmplitudes<double> amplitude{};
    if constexpr (has_bubbles<Shape>)
      for (int i = 0; i < 9; ++i) amplitude[i / 3][i % 3] = history[first_bubble + i];
    return full_solid_kinematics<Shape>(coefficients_of<double>(element, motion.position), reference(element), amplitude);
  }
  /// Of a pack of elements with the history of the group.
  FullSolidKinematics<Pack, Shape> pack_kinematics(std::int32_t element, const Coefficients<Pack>& c,
                                                   std::span<const double> history) const {
    return full_solid_kinematics<Shape>(c, pack_reference(element), pack_amplitudes(element, history));
  }
  BubbleAmplitudes<Pack> pack_amplitudes(std::int32_t element, std::span<const double> history) const {
    BubbleAmplitudes<Pack> amplitude{};
    if constexpr (has_bubbles<Shape>)
      for (int i = 0; i < 9; ++i)
        amplitude[i / 3][i % 3].copy_from(&history[(first_bubble + i) * static_cast<std::ptrdiff_t>(padded_size_) + element],
                                          std::experimental::element_aligned);
    return amplitude;
  }
  // Of shapes with bubbles, full_solid_bubbles.hpp.
  void settle_bubbles(std::int32_t element, const Coefficients<Pack>& c, double increment, PointBatch<PointKind::solid>& points,
                      std::span<double> history) const;
  bool linearize_with_bubbles(std::int32_t element, const NodalMotion& motion, std::span<const double> old_history,
                              std::span<double> new_history, std::span<double> force, std::span<double> stiffness) const;
  void store_flexibility(std::int32_t lane);

  PackReference pack_reference(std::int32_t element) const {
    return {records_.data() + static_cast<std::size_t>(element) * Record::size};
  }
  LaneReference reference(std::int32_t element) const {
    return {records_.data() + static_cast<std::size_t>(element / pack_size) * pack_size * Record::size +
            element % pack_size};
  }

  SolidMaterial material_;
  double natural_laplacian_;  // largest eigenvalue of sum_q dN_I/dxi . dN_J/dxi
  AlignedVector<double> records_;  // [pack][component][lane]
  mutable std::vector<double> kept_history_;  // bubbles: of the law in a pack while they settle
};

template <class Shape>
template <class T>
auto FullSolid<Shape>::coefficients_of(std::int32_t element, const double* position) const -> Coefficients<T> {
  std::array<Vector3<T>, Shape::nodes> nodes;
  for (int node = 0; node < Shape::nodes; ++node) {
    const double* x = position + 4 * static_cast<std::ptrdiff_t>(connectivity_[element * Shape::nodes + node]);
    for (int i = 0; i < 3; ++i) {
      if constexpr (std::is_same_v<T, double>)
        nodes[node][i] = x[i];
      else
        nodes[node][i] = T(x[i], 3 * node + i);
    }
  }
  return Shape::coefficients(nodes);
}

}  // namespace balocco
