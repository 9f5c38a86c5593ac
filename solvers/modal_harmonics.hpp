// Generalised coordinates of modes under harmonic forces.
#pragma once

#include <Eigen/Dense>

namespace balocco {

/// Modes of generalised mass 1, n of them.
struct ModalEquations {
  Eigen::VectorXd stiffness;   // eigenvalues: circular frequencies squared
  Eigen::VectorXd structural;  // damping factors s of the stiffness (1 + i s)
  Eigen::MatrixXd damping;     // viscous: force by velocity, between any two modes
};

struct ModalHarmonics {
  Eigen::VectorXcd amplitude;
  /// Row of a mode that is excited at its own frequency and not damped, so that its amplitude has no bound; -1: none. An undamped mode
  /// that nothing excites there (less than 1e-6 of all forces) is at rest.
  Eigen::Index unbounded = -1;
};

/// Solves (k (1 + i s) - omega^2 + i omega c) q = f at a circular frequency; a force f exp(i omega t) moves the modes by q exp(i omega t).
ModalHarmonics modal_harmonics(const ModalEquations& equations, double omega, const Eigen::VectorXcd& force);

}  // namespace balocco
