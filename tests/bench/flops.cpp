#include "flops.hpp"

#include <cmath>
#include <vector>

#include "elements/bulk_viscosity.hpp"
#include "elements/solids/full_solid_stability.hpp"
#include "elements/solids/reduced_brick_kernel.hpp"
#include "elements/solids/reduced_brick_stability.hpp"
#include "materials/isotropic_elastic.hpp"
#include "materials/mooney_rivlin.hpp"
#include "materials/neo_hooke.hpp"

namespace balocco::bench {

namespace {

long count = 0;

/// A double that counts what is done to it.
struct Counted {
  double value = 0.0;

  Counted() = default;
  Counted(double v) : value(v) {}  // NOLINT: constants enter freely

  static Counted made(double v) {
    ++count;
    return Counted(v);
  }
  friend Counted operator+(Counted a, Counted b) { return made(a.value + b.value); }
  friend Counted operator-(Counted a, Counted b) { return made(a.value - b.value); }
  friend Counted operator*(Counted a, Counted b) { return made(a.value * b.value); }
  friend Counted operator/(Counted a, Counted b) { return made(a.value / b.value); }
  friend Counted operator-(Counted a) { return made(-a.value); }
  friend bool operator>(Counted a, Counted b) { return a.value > b.value; }
  friend Counted square_root(Counted a) { return made(std::sqrt(a.value)); }
  friend Counted maximum(Counted a, Counted b) { return made(a.value > b.value ? a.value : b.value); }
  friend Counted select(bool condition, Counted yes, Counted no) { return made(condition ? yes.value : no.value); }
};

struct CountedReference {
  Counted operator[](int) const { return Counted(0.1); }
};

template <class Nodes>
Nodes some_positions() {
  Nodes nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int d = 0; d < 3; ++d) nodes[i][d] = Counted(0.1 * static_cast<double>(i) + 0.3 * d);
  return nodes;
}

/// Rounding and subtraction at the nodes: 3 operations a component.
constexpr long scatter_flops(int nodes) {
  return 3L * 3 * nodes;
}

/// A shared intermediate of stress and bound is computed once by the compiler; the count takes it so: invariants and
/// the inverse cube root of a law are charged once.
template <class Law>
long law_flops(const Law& law, const Matrix3<Counted>& f) {
  count = 0;
  law.stress(f);
  law.bound(f);
  const long both = count;
  count = 0;
  const Invariants<Counted> shared = invariants(f);
  inverse_cube_root(shared.jacobian);
  return both - count;
}

template <class Law>
double reduced_brick(const Law& law) {
  const CountedReference reference;
  count = 0;
  const auto c = coefficients(some_positions<std::array<Vector3<Counted>, 8>>());
  const auto f = mean_deformation_gradient(c, reference);
  const Invariants<Counted> invariant = invariants(f);
  const BulkViscosity viscosity(0.06, 1.2, 1.0, 1.0);
  const Counted rate = volume_rate(invariant.jacobian, Counted(1.0), 1.0);
  const Counted mean_stress = viscosity.stress(Counted(1.0), rate);
  Matrix3<Counted> stress = f;
  for (int k = 0; k < 9; ++k)
    stress.component[k] = Counted(1.0) * (stress.component[k] + mean_stress * invariant.cofactor.component[k]);
  const auto q = hourglass_vectors(c, f, reference);
  nodal_forces(
      conjugates_with_stresses(c, q, hourglass_stresses(hourglass_strains(c, q), reference), stress, reference));
  const BrickStability<Counted> stability{1.0, 0.0};
  stability.increment(invariant, TangentBound<Counted>{1.0, 1.0}, q, viscosity.slope(Counted(1.0), rate), reference);
  const long kernel = count;
  return static_cast<double>(kernel + law_flops(law, f) + scatter_flops(8));
}

template <class Shape, class Law>
double full_solid(const Law& law) {
  const CountedReference reference;
  count = 0;
  const auto c = Shape::coefficients(some_positions<std::array<Vector3<Counted>, Shape::nodes>>());
  const auto k = full_solid_kinematics<Shape>(c, reference);
  std::array<Matrix3<Counted>, Shape::points> stress;
  Shape::nodal(full_solid_conjugates<Shape>(k, stress, Counted(0.0), reference));
  FullSolidBound<Counted> bound{Counted(0.0)};
  for (int q = 0; q < Shape::points; ++q)
    bound.add_point(k.modified[q], InitialStress<Counted>(k.modified[q], stress[q]), TangentBound<Counted>{1.0, 1.0}, k.scale[q], Counted(1.0), Counted(0.1));
  bound.volumetric();
  Shape::nodal(full_solid_conjugates<Shape>(k, stress, Counted(1.0), reference));
  const long kernel = count;
  return static_cast<double>(kernel + Shape::points * law_flops(law, k.modified[0]) + scatter_flops(Shape::nodes));
}

template <class Law>
double of_law(const std::string& type, const Law& law) {
  if (type == "C3D8R") return reduced_brick(law);
  if (type == "C3D8") return full_solid<HexahedronShape>(law);
  if (type == "C3D6") return full_solid<WedgeShape>(law);
  return 0.0;
}

}  // namespace

double flops_per_element(const std::string& type, const std::string& law) {
  if (law == "elastic") return of_law(type, IsotropicElastic{1.0, 1.0});
  if (law == "neo-hooke") return of_law(type, NeoHooke{1.0, 1.0});
  if (law == "mooney-rivlin") return of_law(type, MooneyRivlin{1.0, 1.0, 1.0});
  return 0.0;
}

}  // namespace balocco::bench
