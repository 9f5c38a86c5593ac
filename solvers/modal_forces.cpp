#include "modal_forces.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "implicit_prescribed.hpp"
#include "model/diagnostics.hpp"
#include "step_driver.hpp"

namespace balocco {

namespace {

/// Adds a force on what `motion` moves to the slots that move it.
void scatter(const NodeMotion& motion, const double* force, std::vector<double>& slots) {
  for (int k = 0; k < motion.count; ++k)
    for (int i = 0; i < 3; ++i) slots[motion.slots[k]] += motion.direction[k][i] * force[i];
}

/// Stiffness-proportional damping of a section's material; plies count by their thickness.
double damping_beta(const Model& model, const Section& section) {
  if (section.material >= 0) return model.materials[section.material].damping_beta;
  double sum = 0.0, thickness = 0.0;
  for (const auto& ply : section.plies) {
    sum += ply.thickness * model.materials[ply.material].damping_beta;
    thickness += ply.thickness;
  }
  return thickness > 0.0 ? sum / thickness : 0.0;
}

}  // namespace

ModalForces::ModalForces(Analysis& analysis, const std::vector<Mode>& modes)
    : analysis_(analysis),
      modes_(modes),
      modes_step_(analysis.model.steps[analysis.step_of_modes]),
      system_(analysis, modes_step_, slots_of(prescribed_motions(analysis, modes_step_))) {
  const auto& map = system_.map();
  for (std::int32_t slot = 0; slot < map.first_multiplier(); ++slot)
    if (map.role(slot) == ImplicitDofMap::Role::prescribed) held_slots_.push_back(slot);
  const auto here = system_.configuration();
  if (analysis_.current.linear) system_.restore(system_.reference());
  find_motions();
  by_motion_ = held(stiffness_products());
  const auto damping = damping_products();
  by_velocity_ = held(damping);
  project_damping(damping);
  by_acceleration_ = held(mass_products());
  system_.restore(here);
}

void ModalForces::find_motions() {
  const auto& map = system_.map();
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node) {
    const auto body = analysis_.reference_of(node);
    motion_.push_back(map.motion(node));
    if (body >= 0)
      spin_.push_back(map.spin(body));
    else
      spin_.push_back(node < analysis_.domain.turning ? map.nodal_spin(node) : NodeMotion{});
  }
}

/// Block * motion of its freedoms in a shape, 3 values a node.
void ModalForces::add_product(std::span<const Inertial> freedoms, std::span<const double> block, const std::vector<double>& displacement,
                              const std::vector<double>& rotation, std::vector<double>& product) const {
  const std::size_t size = 3 * freedoms.size();
  for (std::size_t a = 0; a < freedoms.size(); ++a) {
    Point force{};
    for (std::size_t b = 0; b < freedoms.size(); ++b) {
      const double* const moved = &(freedoms[b].spins ? rotation : displacement)[3 * static_cast<std::size_t>(freedoms[b].node)];
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) force[i] += block[size * (3 * a + i) + 3 * b + j] * moved[j];
    }
    scatter((freedoms[a].spins ? spin_ : motion_)[freedoms[a].node], force.data(), product);
  }
}

void ModalForces::add_products(std::span<const Inertial> freedoms, std::span<const double> block, PerMode& products) const {
  for (std::size_t mode = 0; mode < modes_.size(); ++mode)
    add_product(freedoms, block, modes_[mode].displacement, modes_[mode].rotation, products[mode]);
}

/// About the state that the modes are about, with the forces of their constraints.
ModalForces::PerMode ModalForces::stiffness_products() {
  PerMode products;
  for (const auto& mode : modes_) {
    const bool sound = system_.assemble({.total_time = analysis_.current.total_time,
                                         .initial_loads = true,
                                         .load_stiffness = !analysis_.current.linear,
                                         .arms_turn = !analysis_.current.linear,
                                         .contact_sticks = true,
                                         .motion = mode.slots});
    if (!sound) throw AnalysisError(fmt::format("step '{}' cannot be taken up: {}", modes_step_.name, system_.trouble()));
    products.push_back(system_.stiffness().product());
    system_.exchange().sum(products.back());
  }
  return products;
}

/// What an element resists velocities with: the part of its stiffness that grows with velocity_slope, and BETA times the stiffness.
void ModalForces::add_element_damping(const ElementGroup& group, std::size_t index, PerMode& products) const {
  const auto& section = analysis_.model.sections[group.section()];
  const bool is_damper = section.kind == Section::Kind::dashpot || section.kind == Section::Kind::connector;
  const double beta = damping_beta(analysis_.model, section);
  if (!is_damper && beta == 0.0) return;
  const std::vector<double> still(4 * (static_cast<std::size_t>(analysis_.domain.size()) + 1), 0.0);
  auto motion = analysis_.current.motion();
  motion.velocity = motion.angular_velocity = is_damper ? still.data() : nullptr;
  const auto size = static_cast<std::size_t>(group.freedoms_per_node()) * group.nodes_per_element();
  std::vector<double> history(group.history_size()), unused(group.history_size()), force(size), block(size * size), faster(size * size);
  std::vector<Inertial> freedoms;
  for (std::int32_t element = 0; element < group.size(); ++element) {
    if (!analysis_.takes_part(group, element)) continue;
    freedoms.clear();
    for (const auto node : group.nodes(element)) {
      freedoms.push_back({node});
      if (group.freedoms_per_node() == 6) freedoms.push_back({node, true});
    }
    group.gather_history(element, analysis_.current.element_history[index], history);
    motion.velocity_slope = is_damper ? 1e-300 : 0.0;
    group.linearize(element, motion, history, unused, force, block);
    motion.velocity_slope = 1.0;
    if (is_damper) group.linearize(element, motion, history, unused, force, faster);
    for (std::size_t i = 0; i < block.size(); ++i) block[i] = is_damper ? faster[i] - block[i] : beta * block[i];
    add_products(freedoms, block, products);
  }
}

ModalForces::PerMode ModalForces::damping_products() {
  auto products = empty();
  for_each_inertia(analysis_, InertiaKind::damping, [&](auto freedoms, auto block) { add_products(freedoms, block, products); });
  for (std::size_t index = 0; index < analysis_.element_groups.size(); ++index)
    add_element_damping(*analysis_.element_groups[index], index, products);
  for (auto& product : products) system_.exchange().sum(product);
  return products;
}

ModalForces::PerMode ModalForces::mass_products() {
  auto products = empty();
  for_each_inertia(analysis_, InertiaKind::mass, [&](auto freedoms, auto block) { add_products(freedoms, block, products); });
  for (auto& product : products) system_.exchange().sum(product);
  return products;
}

Eigen::MatrixXd ModalForces::held(const PerMode& products) const {
  Eigen::MatrixXd rows(held_slots_.size(), products.size());
  for (Eigen::Index column = 0; column < rows.cols(); ++column)
    for (Eigen::Index row = 0; row < rows.rows(); ++row) rows(row, column) = products[column][held_slots_[row]];
  return rows;
}

void ModalForces::project_damping(const PerMode& products) {
  const auto count = static_cast<Eigen::Index>(modes_.size());
  damping_ = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index row = 0; row < count; ++row)
    for (Eigen::Index column = 0; column < count; ++column)
      for (const auto slot : system_.map().owned_free_slots())
        if (!system_.map().is_multiplier(slot)) damping_(row, column) += modes_[row].slots[slot] * products[column][slot];
  analysis_.communicator.sum(std::span<double>(damping_.data(), static_cast<std::size_t>(damping_.size())));
}

ModalLoads ModalForces::loads(const Step& step, double step_time, double total_time) {
  const auto& domain = analysis_.domain;
  std::vector<double> force(4 * (static_cast<std::size_t>(domain.size()) + 1), 0.0), moment(4 * static_cast<std::size_t>(domain.turning), 0.0);
  std::vector<Point> of_bodies(analysis_.model.rigid_bodies.size());
  add_external_forces(analysis_, step, step_time, total_time, analysis_.current.position.data(), {force.data(), moment.data()}, of_bodies);
  std::vector<double> slots(static_cast<std::size_t>(system_.map().slots()), 0.0);
  for (std::int32_t node = 0; node < domain.size(); ++node) {
    scatter(motion_[node], &force[4 * static_cast<std::size_t>(node)], slots);
    if (node < domain.turning) scatter(spin_[node], &moment[4 * static_cast<std::size_t>(node)], slots);
    const auto body = analysis_.reference_of(node);
    if (body >= 0 && domain.owned[node]) scatter(spin_[node], of_bodies[body].data(), slots);
  }
  system_.exchange().sum(slots);
  return project(slots);
}

ModalLoads ModalForces::inertia(const std::vector<double>& displacement, const std::vector<double>& rotation) {
  const auto here = system_.configuration();
  if (analysis_.current.linear) system_.restore(system_.reference());
  std::vector<double> slots(static_cast<std::size_t>(system_.map().slots()), 0.0);
  for_each_inertia(analysis_, InertiaKind::mass,
                   [&](auto freedoms, auto block) { add_product(freedoms, block, displacement, rotation, slots); });
  system_.restore(here);
  system_.exchange().sum(slots);
  return project(slots);
}

/// Forces on slots, summed over ranks.
ModalLoads ModalForces::project(const std::vector<double>& slots) const {
  ModalLoads loads{Eigen::VectorXd::Zero(static_cast<Eigen::Index>(modes_.size())), Eigen::VectorXd(held_slots_.size())};
  for (std::size_t i = 0; i < held_slots_.size(); ++i) loads.on_held[static_cast<Eigen::Index>(i)] = slots[held_slots_[i]];
  auto& sums = loads.on_modes;
  for (Eigen::Index mode = 0; mode < sums.size(); ++mode)
    for (const auto slot : system_.map().owned_free_slots())
      if (!system_.map().is_multiplier(slot)) sums[mode] += modes_[mode].slots[slot] * slots[slot];
  analysis_.communicator.sum(std::span<double>(sums.data(), static_cast<std::size_t>(sums.size())));
  return loads;
}

void ModalForces::show(const Eigen::VectorXd& amplitude, const Eigen::VectorXd& velocity, const Eigen::VectorXd& acceleration,
                       const Eigen::VectorXd& held_loads) {
  const Eigen::VectorXd held = by_motion_ * amplitude + by_velocity_ * velocity + by_acceleration_ * acceleration - held_loads;
  std::vector<double> residual(static_cast<std::size_t>(system_.map().slots()), 0.0);
  for (std::size_t i = 0; i < held_slots_.size(); ++i) residual[held_slots_[i]] = held[static_cast<Eigen::Index>(i)];
  show_reactions(analysis_, system_.map(), residual);
  for (std::int32_t node = 0; node < analysis_.domain.size(); ++node)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto body = analysis_.reference_of(node);
      const auto from = 3 * static_cast<std::size_t>(node) + i, to = 4 * static_cast<std::size_t>(node) + i;
      for (std::size_t mode = 0; mode < modes_.size(); ++mode) {
        const double rate = acceleration[static_cast<Eigen::Index>(mode)];
        analysis_.acceleration[to] += rate * modes_[mode].displacement[from];
        if (node < analysis_.domain.turning) analysis_.angular_acceleration[to] += rate * modes_[mode].rotation[from];
        if (body >= 0) analysis_.body_angular_acceleration[body][i] += rate * modes_[mode].rotation[from];
      }
    }
  analysis_.output_increment = 0.0;
}

void ModalForces::show_multipliers(const Eigen::VectorXd& amplitude) const {
  const auto& map = system_.map();
  for (auto slot = map.first_multiplier(); slot < map.slots(); ++slot) {
    double& sum = analysis_.current.multiplier[map.constraint_row(slot)];
    sum = 0.0;
    for (std::size_t mode = 0; mode < modes_.size(); ++mode) sum += amplitude[static_cast<Eigen::Index>(mode)] * modes_[mode].slots[slot];
  }
}

}  // namespace balocco
