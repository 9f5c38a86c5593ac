// The yield stress of a metal: static hardening curve and dependence on the plastic strain rate.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "math/scalar.hpp"

namespace balocco {

struct Material;

/// A value and its slope.
template <class V>
struct Sloped {
  V value, slope;
};

/// Hardening curve by straight pieces: start + sum slope_k min(max(p - p_k, 0), width_k), then constant.
struct PiecewiseCurve {
  struct Piece {
    double start, width, slope;
  };
  double first = 0.0;
  std::vector<Piece> pieces;
  double rate = 0.0;  // plastic strain rate at which it was measured

  /// Rows of stress and plastic strain, the first strain being zero.
  static PiecewiseCurve from_rows(const std::vector<std::vector<double>>& rows, double rate);

  template <class V>
  Sloped<V> operator()(const V& p) const {
    Sloped<V> sum{V(first), V(0.0)};
    for (const Piece& piece : pieces) {
      const V inside = p - piece.start;
      sum.value = sum.value + piece.slope * maximum(V(0.0), piece.width - maximum(piece.width - inside, V(0.0)));
      sum.slope = sum.slope + select(inside >= 0.0 && inside < piece.width, V(piece.slope), V(0.0));
    }
    return sum;
  }
};

/// Stress as a function of the equivalent plastic strain p and its rate.
struct FlowStress {
  enum class Hardening { table, saturation, johnson_cook };
  enum class Rate { none, table, power_law, johnson_cook };

  Hardening hardening = Hardening::table;
  Rate rate = Rate::none;
  std::vector<PiecewiseCurve> curves;             // one, or by rising rate
  double yield = 0.0, modulus = 0.0, exponent = 0.0;  // Voce: yield + modulus (1 - exp(-exponent p)); Johnson-Cook: A B n
  double rate_parameter = 0.0, rate_exponent = 0.0;   // power law: D n; Johnson-Cook: rate at which it starts, C

  /// @throws InputError if tables are not in order or options do not fit together
  static FlowStress of(const Material& material);

  bool depends_on_rate() const { return rate != Rate::none; }
  /// Increments of plastic strain are searched as scale * y^n where the slope against them is infinite at zero.
  double search_exponent() const { return rate == Rate::power_law ? rate_exponent : 1.0; }

  /// Stress after plastic strain `p` reached by `dp` in `increment`, with its slope against dp. The increment is not zero.
  template <class V>
  Sloped<V> operator()(const V& p, const V& dp, double increment) const {
    const double inverse = 1.0 / increment;  // zero in statics
    if (rate == Rate::table) return between_curves(p, inverse * dp, inverse);
    const Sloped<V> still = static_curve(p);
    if (rate == Rate::none || inverse == 0.0) return still;
    const V speed = inverse * dp;
    V factor, slope;
    if (rate == Rate::power_law) {
      const V overstress = power(maximum((1.0 / rate_parameter) * speed, V(0.0)), 1.0 / rate_exponent);
      factor = 1.0 + overstress;
      slope = (1.0 / rate_exponent) * overstress / maximum(dp, V(std::numeric_limits<double>::min()));
    } else {
      const V ratio = maximum((1.0 / rate_parameter) * speed, V(1.0));
      factor = 1.0 + rate_exponent * logarithm(ratio);
      slope = select(ratio > 1.0, rate_exponent / dp, V(0.0));
    }
    return {still.value * factor, still.slope * factor + still.value * slope};
  }

  /// The least stress at rate zero, at whatever plastic strain.
  double least() const;

  /// Mises stress above which a point yields. One that rests on its yield surface is elastic until it moves on: rounding does not
  /// choose its tangent, with which a load that turns back would find no equilibrium.
  template <class V>
  V yield_stress(const V& p) const {
    constexpr double beyond_rounding = 1.0 + 1e-10;
    return beyond_rounding * static_curve(p).value;
  }

  /// At rate zero.
  template <class V>
  Sloped<V> static_curve(const V& p) const {
    if (hardening == Hardening::table) return curves[0](p);
    if (hardening == Hardening::saturation) {
      const V decay = modulus * exponential(-exponent * p);
      return {yield + (modulus - decay), exponent * decay};
    }
    const V positive = maximum(p, V(1e-12));  // the slope at zero is infinite
    const V hardened = modulus * power(positive, exponent);
    return {yield + hardened, exponent * hardened / positive};
  }

 private:
  template <class V>
  Sloped<V> between_curves(const V& p, const V& speed, double inverse) const {
    Sloped<V> sum = curves[0](p), last = sum;
    for (std::size_t k = 1; k < curves.size(); ++k) {
      const double width = 1.0 / (curves[k].rate - curves[k - 1].rate);
      const V place = width * (speed - curves[k - 1].rate), share = minimum(maximum(place, V(0.0)), V(1.0));
      const Sloped<V> next = curves[k](p);
      const V rise = next.value - last.value;
      sum.value = sum.value + share * rise;
      sum.slope = sum.slope + share * (next.slope - last.slope) +
                  select(place > 0.0 && place < 1.0, (inverse * width) * rise, V(0.0));
      last = next;
    }
    return sum;
  }
  template <class V>
  static V minimum(const V& a, const V& b) {
    return -maximum(-a, -b);
  }
};

}  // namespace balocco
