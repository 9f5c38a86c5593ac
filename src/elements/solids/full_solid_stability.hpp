// The stable increment of a fully integrated solid with mean dilatation: never above 2 / omega_max of the free element.
#pragma once

#include "elements/bulk_viscosity.hpp"
#include "elements/solids/full_solid_kernel.hpp"
#include "materials/law_of.hpp"
#include "materials/stretch.hpp"

namespace balocco {

/// The initial-stress part of the stiffness of points with mean dilatation. With l = dF F^-1, t = tr l, tau = d(ln Jbar), s =
/// (Jbar / J)^(1/3), Kirchhoff's stress T = p 1 + T' of Fbar = s F at a point, r = J / Jbar and pm the mean of p over the element:
///   Pbar : d2Fbar = tr T (d2s / s) + 2 (ds / s) T : l,  ds / s = (tau - t) / 3,  d2 ln J = -l : l^T,
///   d2 ln Jbar = mean(r (t^2 - l : l^T)) - tau^2,
///   sum w Pbar : d2Fbar = -(2/3) pm V tau^2 + sum w [(pm r - p/3) t^2 + (p - pm r) l : l^T + (2/3)(tau - t) T' : l'],
///   (2/3) |tau - t| |l'| <= tau^2 / 3 + 0.911 |l|^2.
/// So a uniform pressure, which mean dilatation turns into (2/3) pm sum w (t^2 - tau^2), costs nothing where it compresses.
template <class T>
struct InitialStress {
  T pressure = T(0.0), deviator = T(0.0);  // p and |T'|

  InitialStress() = default;
  InitialStress(const Matrix3<T>& modified, const Matrix3<T>& stress) {
    const auto component = [&](int i, int j) {
      return stress(i, 0) * modified(j, 0) + stress(i, 1) * modified(j, 1) + stress(i, 2) * modified(j, 2);
    };
    const T xx = component(0, 0), yy = component(1, 1), zz = component(2, 2);
    const T xy = component(0, 1), xz = component(0, 2), yz = component(1, 2);
    pressure = (1.0 / 3.0) * (xx + yy + zz);
    const T x = xx - pressure, y = yy - pressure, z = zz - pressure;
    deviator = square_root(x * x + y * y + z * z + 2.0 * (xy * xy + xz * xz + yz * yz));
  }

  T per_gradient(const T& mean, const T& ratio) const { return absolute(pressure - mean * ratio) + 0.911 * deviator; }  // |l|^2
  T per_trace(const T& mean, const T& ratio) const { return mean * ratio - (1.0 / 3.0) * pressure; }                  // t^2
  T per_dilatation(const T& mean) const { return (1.0 / 3.0) * deviator - (2.0 / 3.0) * mean; }                       // tau^2
};

// With h = s dF, t = F^-T : dF , tau = d(ln Jbar), all of C those of Fbar, and F : h = (I1/3) t + y, |y| <= eta |h|:
//   dFbar = h - (t/3) Fbar + (tau/3) Fbar,  Fbar^-T : dFbar = tau,
//   |dFbar|^2 <= |h|^2 (1 + (2/3) eta sqrt(tr C^-1) + eta/3) + tau^2 (I1/9 + eta/3) - (I1/9) t^2,
//   sum w t^2 >= V tau^2 / mean((J/Jbar)^2)  (Cauchy-Schwarz: tau is the mean of t weighted with J),
//   t^2 <= 3 |l|^2,  |l|^2 <= |h|^2 / (smallest eigenvalue of C), and the initial stress as above,
//   sum w |dF|^2 <= (largest eigenvalue of the Laplacian) sum |v_I|^2,  tau^2 <= |d(ln Jbar)/dx|^2 sum |v_I|^2.
// At rest this is volumetric V |b|^2 + 2 shear * Laplacian: exact for cubes of any Poisson's ratio.
template <class T>
struct FullSolidBound {
  T mean_pressure;         // pm
  T distortion = T(0.0);   // largest factor of s^2 |dF|^2
  T dilatation = T(0.0);   // largest factor of tau^2, the part below removed
  T relief = T(1e300);     // smallest factor of -t^2
  T mean_square = T(0.0);  // mean of (J / Jbar)^2

  void add_point(const Matrix3<T>& modified, const InitialStress<T>& initial, const TangentBound<T>& bound, const T& scale,
                 const T& ratio, const T& fraction) {
    const Invariants<T> c = invariants(modified);
    const T inverse_square = 1.0 / (c.jacobian * c.jacobian);
    const T trace_of_inverse = c.second * inverse_square;
    const T eta = square_root(maximum(c.first * ((1.0 / 9.0) * (c.first * trace_of_inverse) - 1.0), T(0.0)));
    const T root = (0.5 / 1.7320508075688772) * (trace_of_inverse + 3.0);  // >= sqrt(tr C^-1)
    const T twice = 2.0 * bound.shear;
    const T of_trace = twice * ((1.0 / 9.0) * c.first) - initial.per_trace(mean_pressure, ratio);
    const T of_gradient = initial.per_gradient(mean_pressure, ratio) + 3.0 * maximum(-of_trace, T(0.0));
    const T per_distortion = twice * (1.0 + eta * ((2.0 / 3.0) * root + 1.0 / 3.0)) +
                             of_gradient * largest_eigenvalue_bound(trace_of_inverse, c.first * inverse_square);
    const T per_dilatation = bound.volumetric + twice * ((1.0 / 9.0) * c.first + (1.0 / 3.0) * eta) +
                             initial.per_dilatation(mean_pressure);
    distortion = maximum(distortion, (scale * scale) * per_distortion);
    dilatation = maximum(dilatation, per_dilatation);
    relief = -maximum(-relief, -maximum(of_trace, T(0.0)));
    mean_square = mean_square + fraction * (ratio * ratio);
  }

  /// Factor of V tau^2.
  T volumetric() const { return dilatation - relief / mean_square; }
};

// For laws that bound the spatial gradient l = dF F^-1 (metals), where FullSolidBound grows with the square of the largest strain.
// With lbar = dFbar Fbar^-1 = dev l + (tau/3) 1 and the shear bound G of the law per |lbar|^2:
//   d2W <= volumetric tau^2 + 2 G (|l|^2 - t^2/3 + tau^2/3), and the initial stress as above,
//   sum w |l|^2 <= (largest eigenvalue of sum w grad N_I . grad N_J, deformed) sum |v_I|^2: of that in natural coordinates times the
//   largest w |dxi/dx|^2, or of the reference one times the largest |F^-1|^2, whichever is less.
template <class T>
struct SpatialSolidBound {
  T mean_pressure;
  T distortion = T(0.0);        // largest factor of |l|^2
  T dilatation = T(0.0);        // largest factor of tau^2, the part below removed
  T relief = T(1e300);          // smallest factor of -t^2
  T mean_square = T(0.0);       // mean of (J / Jbar)^2
  T stretch = T(0.0);           // largest |F^-1|^2
  T natural_stretch = T(0.0);   // largest w |dxi/dx|^2

  /// `natural` is dx/dxi, `weight` the reference volume of the point, the others as in FullSolidBound.
  void add_point(const Matrix3<T>& modified, const Matrix3<T>& natural, const InitialStress<T>& initial, const TangentBound<T>& bound,
                 const T& scale, const T& ratio, const T& weight, const T& fraction) {
    const Invariants<T> c = invariants(modified), x = invariants(natural);
    const T inverse_square = 1.0 / (c.jacobian * c.jacobian), natural_square = 1.0 / (x.jacobian * x.jacobian);
    const T n2 = largest_eigenvalue_bound(c.second * inverse_square, c.first * inverse_square);
    const T twice = 2.0 * bound.shear / n2;
    const T of_trace = (1.0 / 3.0) * twice - initial.per_trace(mean_pressure, ratio);
    distortion = maximum(distortion, twice + initial.per_gradient(mean_pressure, ratio) + 3.0 * maximum(-of_trace, T(0.0)));
    dilatation = maximum(dilatation, bound.volumetric + (1.0 / 3.0) * twice + initial.per_dilatation(mean_pressure));
    relief = -maximum(-relief, -maximum(of_trace, T(0.0)));
    mean_square = mean_square + fraction * (ratio * ratio);
    stretch = maximum(stretch, (scale * scale) * n2);
    natural_stretch = maximum(
        natural_stretch, weight * largest_eigenvalue_bound(x.second * natural_square, x.first * natural_square));
  }

  /// Factor of V tau^2.
  T volumetric() const { return dilatation - relief / mean_square; }
  /// Factor of sum |v_I|^2, from the largest eigenvalues of the two Laplacians.
  T distortional(const T& reference_laplacian, double natural_laplacian) const {
    return -distortion * maximum(-reference_laplacian * stretch, -natural_laplacian * natural_stretch);
  }
};

}  // namespace balocco
