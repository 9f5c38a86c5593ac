// What a sum of natural modes does beside moving: damping couples the modes, and held freedoms react.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "implicit_mass.hpp"
#include "implicit_system.hpp"

namespace balocco {

/// Forces on the generalised coordinates of the modes (of generalised mass 1), and on this rank's held freedoms.
struct ModalLoads {
  Eigen::VectorXd on_modes, on_held;
};

class ModalForces {
 public:
  /// `modes` of generalised mass 1, as the analysis' last frequency step found them where the state stands. Collective.
  ModalForces(Analysis& analysis, const std::vector<Mode>& modes);

  /// Dashpots, connectors' damping and the materials' Rayleigh damping, between any two modes.
  const Eigen::MatrixXd& damping() const { return damping_; }
  /// Loads of an instant, where the state stands. Collective.
  ModalLoads loads(const Step& step, double step_time, double total_time);
  /// Mass times accelerations of all nodes, 3 values a local node of displacements and of rotations, where the modes were found. Collective.
  ModalLoads inertia(const std::vector<double>& displacement, const std::vector<double>& rotation);
  /// Accelerations, and what held freedoms react with beside `loads`, for whoever writes results.
  void show(const Eigen::VectorXd& amplitude, const Eigen::VectorXd& velocity, const Eigen::VectorXd& acceleration,
            const Eigen::VectorXd& held_loads);
  /// Forces of the constraints go with the modes.
  void show_multipliers(const Eigen::VectorXd& amplitude) const;

 private:
  using PerMode = std::vector<std::vector<double>>;  // of each mode, a value a slot

  void find_motions();
  PerMode empty() const { return PerMode(modes_.size(), std::vector<double>(static_cast<std::size_t>(system_.map().slots()), 0.0)); }
  void add_product(std::span<const Inertial> freedoms, std::span<const double> block, const std::vector<double>& displacement,
                   const std::vector<double>& rotation, std::vector<double>& product) const;
  void add_products(std::span<const Inertial> freedoms, std::span<const double> block, PerMode& products) const;
  void add_element_damping(const ElementGroup& group, std::size_t index, PerMode& products) const;
  PerMode stiffness_products();
  PerMode damping_products();
  PerMode mass_products();
  ModalLoads project(const std::vector<double>& slots) const;
  Eigen::MatrixXd held(const PerMode& products) const;
  void project_damping(const PerMode& products);

  Analysis& analysis_;
  const std::vector<Mode>& modes_;
  const Step& modes_step_;
  ImplicitSystem system_;
  std::vector<NodeMotion> motion_, spin_;       // of nodes, where the modes were found
  std::vector<std::int32_t> held_slots_;
  Eigen::MatrixXd by_motion_, by_velocity_, by_acceleration_;  // forces of held slots (rows) from those of each mode
  Eigen::MatrixXd damping_;
};

}  // namespace balocco
