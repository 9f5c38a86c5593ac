// What a beam kernel needs to know about its cross-section.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "materials/material_law.hpp"
#include "model/model.hpp"

namespace balocco {

/// Area and second moments about the centroid: I11 = integral of x2^2, I22 of x1^2, I12 of x1 x2; torsion constant.
struct BeamArea {
  double area = 0.0, i11 = 0.0, i12 = 0.0, i22 = 0.0, torsion = 0.0;
};

/// A place in the section where stress is told: along n1 and n2 from the centroid; `lever` of the torsional shear stress there,
/// G * twist * lever (circular sections; others 0: their shear stress is not known from the torsion constant alone).
struct BeamPoint {
  double x1 = 0.0, x2 = 0.0, lever = 0.0;
};

/// A part of the section whose stress the material's law gives: strain E11 of stretch and bending, 2E12 = twist * lever.
struct BeamFibre {
  double x1 = 0.0, x2 = 0.0, lever = 0.0, area = 0.0;
};

/// Stiffness and inertia per length.
struct BeamSection {
  BeamArea shape;
  double youngs_modulus = 0.0, shear_modulus = 0.0;
  std::array<double, 2> shear_stiffness{};  // of shear along n1 and n2, shear factor included
  double density = 0.0, damping_beta = 0.0;
  std::vector<BeamPoint> points;
  // Of materials that do more than *ELASTIC or expand, and of sections with an initial stress; shear, and torsion of profiles that are not round, stay elastic.
  std::shared_ptr<const Law<PointKind::fibre>> law;
  std::vector<BeamFibre> fibres;
};

/// The area of a profile. Torsion: rectangles by Saint-Venant's series, closed sections after Bredt, open ones as thin strips.
BeamArea beam_area(const BeamProfile& profile);
/// Height of an I profile's centroid above its bottom.
double centroid_height(const BeamProfile& profile);

/// Quadrature of a profile: Simpson's rule with five points along sides, two points of Gauss across walls; round profiles: Gauss in
/// the square of the radius, eight angles. Exact for area and second moments, but for a general profile, which has none.
std::vector<BeamFibre> beam_fibres(const BeamProfile& profile);

/// @throws InputError naming the section where the material is missing or has no law for beams.
BeamSection beam_section(const Model& model, const Section& section);

/// n1, n2 and the axis, unit vectors, of an element from `a` to `b`: n2 is the axis times the given direction, n1 lies in its plane.
/// @return false if the direction runs along the axis
bool beam_frame(const Point& a, const Point& b, const Point& n1, std::array<Point, 3>& frame);

}  // namespace balocco
