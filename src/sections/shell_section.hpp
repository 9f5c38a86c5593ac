// What a shell kernel needs to know about its section: the points through the thickness, their laws, and the moduli at
// rest. Heights and stiffnesses are relative to the thickness, because *NODAL THICKNESS may give each element its own.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "sections/lamination.hpp"

namespace balocco {

/// An integration point through the thickness, counted from SNEG to SPOS.
struct ShellLayer {
  int ply = 0;          // of ShellSection::plies
  int history = 0;      // where its own begins in that of a point of the surface
  double height = 0.0;  // above the surface of the nodes
  double weight = 0.0;  // the weights of all layers sum to 1
};

/// What the layers of a ply have in common.
struct ShellPly {
  std::shared_ptr<const Law<PointKind::plane>> law;
  bool turned = false;              // its own directions are not those of the section
  double cosine = 1.0, sine = 0.0;  // of the angle between them
  double initial_modulus = 0.0;     // 2 * shear_modulus that the law tells at rest
  double bottom = 0.0, top = 0.0;   // heights
};

/// Stiffness of the six resultants: N = h membrane E + h^2 coupling K, M = h^2 coupling E + h^3 bending K.
struct ShellStiffness {
  PlaneStiffness membrane{}, coupling{}, bending{};
};

struct ShellSection {
  std::vector<ShellPly> plies;
  std::vector<ShellLayer> layers;  // empty: a general section, only `stiffness` speaks
  double thickness = 0.0;
  bool nodal_thickness = false;
  int history_size = 0;               // of a point of the surface: of all layers
  bool linear = false;                // `stiffness` holds for every strain
  ShellStiffness stiffness, damping;  // at rest; damping: each ply's times its beta
  double damping_beta = 0.0;          // the largest of the plies
  std::array<double, 3>
      shear{};           // 11, 22, 12: transverse shear force = h shear (2E13, 2E23), shear correction included
  double density = 0.0;  // mass / (area h)
  double rotary = 0.0;   // moment of inertia about the nodes / (mass h^2)
  double bottom = -0.5, top = 0.5;  // heights
};

/// @throws InputError naming the section if a material is missing, has no plane-stress law, or a stiffness is not
/// positive.
ShellSection shell_section(const Model& model, const Section& section);

/// Strain (E11, E22, 2E12) of a layer at `z` above the nodes, in the directions of its ply.
template <class T>
std::array<T, 3> layer_strain(const ShellPly& ply, const T& z, const std::array<T, 3>& membrane,
                              const std::array<T, 3>& curvature) {
  const T e11 = membrane[0] + z * curvature[0], e22 = membrane[1] + z * curvature[1],
          e12 = membrane[2] + z * curvature[2];
  if (!ply.turned) return {e11, e22, e12};
  const double c = ply.cosine, s = ply.sine;
  return {(c * c) * e11 + (s * s) * e22 + (c * s) * e12, (s * s) * e11 + (c * c) * e22 - (c * s) * e12,
          (2.0 * c * s) * (e22 - e11) + (c * c - s * s) * e12};
}

/// Stress (S11, S22, S12) of a ply's directions in those of the section.
template <class T>
std::array<T, 3> stress_in_section(const ShellPly& ply, const std::array<T, 3>& stress) {
  if (!ply.turned) return stress;
  const double c = ply.cosine, s = ply.sine;
  const T twist = (2.0 * c * s) * stress[2];
  return {(c * c) * stress[0] + (s * s) * stress[1] - twist, (s * s) * stress[0] + (c * c) * stress[1] + twist,
          (c * s) * (stress[0] - stress[1]) + (c * c - s * s) * stress[2]};
}

/// Resultants (N, M) per length of a strain (E, K), and their derivative (row-major 6 x 6) unless it is empty, `increment` after the
/// history of the point, which is old on entry and new on return.
void shell_resultants(const ShellSection& section, double thickness, const std::array<double, 6>& strain,
                      double increment, std::span<double> history, std::array<double, 6>& resultants, std::span<double> stiffness);

/// Recoverable energy per area.
EnergyDensity shell_energy(const ShellSection& section, double thickness, const std::array<double, 6>& strain,
                           std::span<const double> history);

/// Nodes and weights of Simpson's (odd count) or Gauss's rule on [-1/2, 1/2].
struct QuadraturePoint {
  double position, weight;
};
std::vector<QuadraturePoint> thickness_rule(int points, bool gauss);

}  // namespace balocco
