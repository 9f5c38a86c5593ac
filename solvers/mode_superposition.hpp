// What procedures that superpose natural modes have in common: the modes themselves, their damping, and how a sum of them is shown.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "analysis.hpp"

namespace balocco {

/// The modes that the last frequency step found, made to have a generalised mass of 1. @throws AnalysisError where there are none.
std::vector<Mode> modes_of_unit_mass(const Analysis& analysis, const Step& step);

/// Of each mode the viscous damping that *MODAL DAMPING gives it, force by generalised velocity: 2 xi omega + alpha + beta omega^2.
Eigen::VectorXd modal_damping(const std::vector<ModalDamping>& given, const std::vector<Mode>& modes);

/// Of each mode its structural damping factor, without a dimension.
Eigen::VectorXd structural_damping(const std::vector<ModalDamping>& given, const std::vector<Mode>& modes);

/// Makes displacements, rotations and velocities of the state those of a sum of modes about the reference configuration.
void show_superposition(Analysis& analysis, const std::vector<Mode>& modes, const Eigen::VectorXd& amplitude, const Eigen::VectorXd& velocity);

}  // namespace balocco
