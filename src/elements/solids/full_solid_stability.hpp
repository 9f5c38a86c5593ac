// The stable increment of a fully integrated solid with mean dilatation: never above 2 / omega_max of the free element.
#pragma once

#include "elements/bulk_viscosity.hpp"
#include "elements/solids/full_solid_kernel.hpp"
#include "materials/law_of.hpp"
#include "materials/stretch.hpp"

namespace balocco {

// With h = s dF, t = F^-T : dF at a point, tau = d(ln Jbar), all of C those of Fbar, and F : h = (I1/3) t + y, |y| <=
// eta |h|:
//   dFbar = h - (t/3) Fbar + (tau/3) Fbar,  Fbar^-T : dFbar = tau,
//   |dFbar|^2 <= |h|^2 (1 + (2/3) eta sqrt(tr C^-1) + eta/3) + tau^2 (I1/9 + eta/3) - (I1/9) t^2,
//   sum w t^2 >= V tau^2 / mean((J/Jbar)^2)  (Cauchy-Schwarz: tau is the mean of t weighted with J),
//   Pbar : d2Fbar <= |Pbar| [ (|h|^2 n^2 7/3 + tau^2 5/9) |Fbar| + (|h|^2 (1/3 + 2/sqrt(3) n) + tau^2/3) ],  n =
//   |Fbar^-1|, sum w |dF|^2 <= (largest eigenvalue of the Laplacian) sum |v_I|^2,  tau^2 <= |d(ln Jbar)/dx|^2 sum
//   |v_I|^2.
// At rest this is volumetric V |b|^2 + 2 shear * Laplacian: exact for cubes of any Poisson's ratio.
template <class T>
struct FullSolidBound {
  T distortion = T(0.0);   // largest factor of s^2 |dF|^2
  T dilatation = T(0.0);   // largest factor of tau^2, the part below removed
  T relief = T(1e300);     // smallest factor of -t^2
  T mean_square = T(0.0);  // mean of (J / Jbar)^2

  void add_point(const Matrix3<T>& modified, const Matrix3<T>& stress, const TangentBound<T>& bound, const T& scale,
                 const T& ratio, const T& fraction) {
    const Invariants<T> c = invariants(modified);
    const T inverse_square = 1.0 / (c.jacobian * c.jacobian);
    const T trace_of_inverse = c.second * inverse_square;
    const T eta = square_root(maximum(c.first * ((1.0 / 9.0) * (c.first * trace_of_inverse) - 1.0), T(0.0)));
    const T root = (0.5 / 1.7320508075688772) * (trace_of_inverse + 3.0);  // >= sqrt(tr C^-1)
    const T n2 = largest_eigenvalue_bound(trace_of_inverse, c.first * inverse_square);
    const T n = 0.5 * (n2 + 1.0), size = 0.5 * (c.first + 3.0) / 1.7320508075688772;  // >= |Fbar^-1|_2 and >= |Fbar|
    const T geometric = square_root(double_contraction(stress, stress));
    const T twice = 2.0 * bound.shear;
    const T per_distortion = twice * (1.0 + eta * ((2.0 / 3.0) * root + 1.0 / 3.0)) +
                             geometric * ((7.0 / 3.0) * (n2 * size) + (1.0 / 3.0) + 1.1547005383792517 * n);
    const T per_dilatation = bound.volumetric + twice * ((1.0 / 9.0) * c.first + (1.0 / 3.0) * eta) +
                             geometric * ((5.0 / 9.0) * size + (1.0 / 3.0));
    distortion = maximum(distortion, (scale * scale) * per_distortion);
    dilatation = maximum(dilatation, per_dilatation);
    relief = -maximum(-relief, -(twice * ((1.0 / 9.0) * c.first)));
    mean_square = mean_square + fraction * (ratio * ratio);
  }

  /// Factor of V tau^2.
  T volumetric() const { return dilatation - relief / mean_square; }
};

// For laws that bound the spatial gradient l = dF F^-1 (metals), where FullSolidBound grows with the square of the largest strain.
// With t = tr l, lbar = dFbar Fbar^-1 = dev l + (tau/3) 1, the shear bound G of the law per |lbar|^2 and Kirchhoff's stress T:
//   d2W <= volumetric tau^2 + 2 G (|l|^2 - t^2/3 + tau^2/3),
//   Pbar : d2Fbar = T : (2 d l + d^2 1) + (tr T / 3)(d2 ln Jbar - d2 ln J),  d = (tau - t)/3,  d2 ln J = -l : l^T,
//     d2 ln Jbar = mean(J/Jbar (t^2 - l : l^T)) - tau^2,  |t^2 - l : l^T| <= 2 |l|^2,  |tr T| <= sqrt(3) |T|,
//     <= |T| [(1.49 + 1.155 J/Jbar) |l|^2 + 0.72 tau^2],
//   sum w |l|^2 <= (largest eigenvalue of sum w grad N_I . grad N_J, deformed) sum |v_I|^2: of that in natural coordinates times the
//   largest w |dxi/dx|^2, or of the reference one times the largest |F^-1|^2, whichever is less.
template <class T>
struct SpatialSolidBound {
  T distortion = T(0.0);        // largest factor of |l|^2
  T dilatation = T(0.0);        // largest factor of tau^2, the part below removed
  T relief = T(1e300);          // smallest factor of -t^2
  T mean_square = T(0.0);       // mean of (J / Jbar)^2
  T stretch = T(0.0);           // largest |F^-1|^2
  T natural_stretch = T(0.0);   // largest w |dxi/dx|^2
  T geometric = T(0.0), largest_ratio = T(0.0);  // largest |T| and J / Jbar

  /// `natural` is dx/dxi, `weight` the reference volume of the point, the others as in FullSolidBound.
  void add_point(const Matrix3<T>& modified, const Matrix3<T>& natural, const Matrix3<T>& stress, const TangentBound<T>& bound,
                 const T& scale, const T& ratio, const T& weight, const T& fraction) {
    const Invariants<T> c = invariants(modified), x = invariants(natural);
    const T inverse_square = 1.0 / (c.jacobian * c.jacobian), natural_square = 1.0 / (x.jacobian * x.jacobian);
    const T n2 = largest_eigenvalue_bound(c.second * inverse_square, c.first * inverse_square);
    const T twice = 2.0 * bound.shear / n2;
    distortion = maximum(distortion, twice);
    dilatation = maximum(dilatation, bound.volumetric + (1.0 / 3.0) * twice);
    relief = -maximum(-relief, (-1.0 / 3.0) * twice);
    mean_square = mean_square + fraction * (ratio * ratio);
    stretch = maximum(stretch, (scale * scale) * n2);
    natural_stretch = maximum(
        natural_stretch, weight * largest_eigenvalue_bound(x.second * natural_square, x.first * natural_square));
    const T square = double_contraction(stress, stress) * largest_eigenvalue_bound(c.first, c.second);
    geometric = maximum(geometric, square_root(square));
    largest_ratio = maximum(largest_ratio, ratio);
  }

  /// Factor of V tau^2.
  T volumetric() const { return dilatation - relief / mean_square + 0.72 * geometric; }
  /// Factor of sum |v_I|^2, from the largest eigenvalues of the two Laplacians.
  T distortional(const T& reference_laplacian, double natural_laplacian) const {
    const T factor = distortion + geometric * (1.49 + 1.155 * largest_ratio);
    return -factor * maximum(-reference_laplacian * stretch, -natural_laplacian * natural_stretch);
  }
};

}  // namespace balocco
