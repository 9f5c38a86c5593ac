// *ELASTIC, TYPE=ISOTROPIC with lines for several temperatures: the St. Venant-Kirchhoff law whose constants follow the temperature of a
// point. Young's modulus and Poisson's ratio are linear between the lines and constant beyond them (Abaqus, CalculiX).
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "materials/isotropic_elastic.hpp"

namespace balocco {

struct Material;  // model/model.hpp

/// The lines of a material, which stand one after the other in Material::parameters: young, poisson, temperature.
class ElasticTable {
 public:
  static constexpr std::size_t columns = 3;
  /// Whether the constants of a material follow the temperature.
  static bool is_in(const Material& material);

  explicit ElasticTable(std::span<const double> parameters) : parameters_(parameters) {}
  /// Lame's constants of the first line, of which the history of points keeps the differences.
  IsotropicElastic first() const { return IsotropicElastic::from_young(parameters_[0], parameters_[1]); }
  IsotropicElastic at(double temperature) const;
  /// Not less than any of its constants at any temperature.
  IsotropicElastic greatest() const;

 private:
  double value(std::size_t row, std::size_t column) const { return parameters_[columns * row + column]; }

  std::span<const double> parameters_;
};

/// Whether thermal strains or elastic constants make a material follow its temperature.
bool follows_temperature(const Material& material);

/// The solver sets the first two history fields, differences of lambda and mu from those of the first line of the table. The work of what
/// changes them, dW/d(lambda) and dW/d(mu) times their changes, is summed by the trapezoidal rule (EnergyDensity::heat).
struct ElasticByTemperature {
  static constexpr const char* changes_field = "LAME CHANGES";
  static constexpr int done_row = 2;  // behind them: the changes whose work is counted
  double lambda, mu;                    // of the first line
  double greatest_lambda, greatest_mu;  // at any temperature: the stable increment is that of the stiffest

  explicit ElasticByTemperature(const ElasticTable& table);

  template <class T>
  struct State {
    std::array<T, 2> changes{}, done{}, slopes{};
    T work{};
  };
  template <class S, class Visit>
  void fields(S& state, Visit&& visit) const {
    visit(changes_field, state.changes);
    visit("LAME DONE", state.done);
    visit("LAME SLOPES", state.slopes);
    visit("LAME WORK", state.work);
  }

  template <class T>
  Matrix3<T> stress(const Matrix3<T>& deformation_gradient, State<T>& state, double) const {
    Matrix3<T> second_piola = green_lagrange_strain(deformation_gradient);
    const T trace = second_piola(0, 0) + second_piola(1, 1) + second_piola(2, 2);
    const std::array<T, 2> slopes{0.5 * trace * trace, double_contraction(second_piola, second_piola)};
    for (std::size_t i = 0; i < 2; ++i)
      state.work = state.work + 0.5 * (state.slopes[i] + slopes[i]) * (state.changes[i] - state.done[i]);
    state.slopes = slopes;
    state.done = state.changes;
    const T pressure = (lambda + state.changes[0]) * trace;
    for (auto& s : second_piola.component) s = (2.0 * (mu + state.changes[1])) * s;
    for (int i = 0; i < 3; ++i) second_piola(i, i) = second_piola(i, i) + pressure;
    return deformation_gradient * second_piola;
  }

  template <class T>
  TangentBound<T> bound(const Matrix3<T>& deformation_gradient, const Matrix3<T>&) const {
    const Invariants<T> c = invariants(deformation_gradient);
    const T largest_strain = 0.5 * (largest_eigenvalue_bound(c.first, c.second) - 1.0);
    const T largest_stress = (0.5 * greatest_lambda) * maximum(c.first - 3.0, T(0.0)) + (2.0 * greatest_mu) * maximum(largest_strain, T(0.0));
    return quadratic_energy_bound(c, greatest_lambda, greatest_mu, largest_stress);
  }

  EnergyDensity energy(const Matrix3<double>& deformation_gradient, const State<double>& state) const {
    const IsotropicElastic now{lambda + state.changes[0], mu + state.changes[1]};
    return {now.energy(deformation_gradient), 0.0, 0.0, state.work};
  }
};

}  // namespace balocco
