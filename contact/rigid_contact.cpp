#include "rigid_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact_resultant.hpp"
#include "master_frame.hpp"
#include "model/diagnostics.hpp"
#include "model/interaction_in_step.hpp"
#include "slave_surface.hpp"

namespace balocco {

namespace {

template <class T>
Vector3<double> values(const Vector3<T>& vector) {
  return {value_of(vector[0]), value_of(vector[1]), value_of(vector[2])};
}

/// Friction of the same force whose derivative is that of its spring, wherever its anchor is.
template <class T>
void stick(const Vector3<T>& place, const Vector3<double>& normal, ContactForce<T>& contact) {
  auto motion = place;
  for (int i = 0; i < 3; ++i) motion[i] = motion[i] - value_of(place[i]);
  const T across = motion[0] * normal[0] + motion[1] * normal[1] + motion[2] * normal[2];
  for (int i = 0; i < 3; ++i)
    contact.friction[i] = value_of(contact.friction[i]) - contact.tangential_stiffness * (motion[i] - across * normal[i]);
}

InputError refused(const Model& model, const ContactPair& pair, const std::string& what) {
  return InputError(fmt::format("{}: error: *CONTACT PAIR: {}", model.where(pair.location), what));
}

/// Row of the rigid body whose surface the master is. @throws InputError if there is none.
std::int32_t find_master_body(const Model& model, const ContactPair& pair) {
  const Surface& master = model.surfaces[pair.master];
  if (master.kind == Surface::Kind::nodes || (master.kind == Surface::Kind::analytical && !master.analytical))
    throw refused(model, pair,
                  fmt::format("the master surface {} is not rigid; make it one with *SURFACE, TYPE=CYLINDER, REVOLUTION or "
                              "SEGMENTS and *RIGID BODY, ANALYTICAL SURFACE={}, or of the sides of R3D3 and R3D4 elements",
                              master.name, master.name));
  const auto carries = [&](const RigidBody& body) {
    if (master.analytical) return body.analytical_surface == pair.master;
    return !master.faces.empty() && std::ranges::count(body.elements, master.faces.front().element) > 0;
  };
  const auto body = std::ranges::find_if(model.rigid_bodies, carries);
  if (body == model.rigid_bodies.end())
    throw refused(model, pair,
                  fmt::format("the master surface {} belongs to no rigid body; write *RIGID BODY, {}, REF NODE=...", master.name,
                              master.analytical ? "ANALYTICAL SURFACE=" + master.name : "ELSET= with its elements"));
  auto elements = body->elements;
  std::ranges::sort(elements);
  for (const FaceRef& face : master.faces)
    if (!std::ranges::binary_search(elements, face.element))
      throw refused(model, pair,
                    fmt::format("the facets of the master surface {} belong to different rigid bodies, or element {} to none; "
                                "give each body a surface and a pair of its own",
                                master.name, model.elements[face.element.table].id[face.element.row]));
  return static_cast<std::int32_t>(body - model.rigid_bodies.begin());
}

}  // namespace

RigidContact::RigidContact(const Model& model, std::int32_t pair, const Domain& domain) {
  const ContactPair& contact = model.contact_pairs[pair];
  const Surface& slave = model.surfaces[contact.slave];
  const Surface& master = model.surfaces[contact.master];
  master_body_ = find_master_body(model, contact);
  const Point reference = initial_rigid_bodies(model)[master_body_].position;
  surface_ = MasterSurface(model, master, reference);
  if (surface_.empty())
    throw refused(model, contact,
                  fmt::format("the master surface {} has no length or area; give it segments or facets", master.name));
  if (contact.interaction >= 0) penalty_scale_ = model.interactions[contact.interaction].penalty_scale;
  const SlaveNodes all = slave_nodes(model, contact);
  if (faces_away(model, slave, surface_, reference))
    throw refused(
        model, contact,
        fmt::format(
            "the contact surface {} faces away from {}: none of its faces looks towards the rigid surface; name "
            "the other side of its elements (SPOS or SNEG, another of S1 to S6), or list the profile of {} in the "
            "opposite direction (its outward normal is to the left of it)",
            slave.name, master.name, master.name));
  for (std::size_t i = 0; i < all.rows.size(); ++i) {
    const std::int32_t node = domain.local_node[all.rows[i]];
    if (node < 0) continue;
    nodes_.push_back(node);
    owned_.push_back(domain.owned[node]);
    area_.push_back(all.area[i]);
    penalty_.push_back(all.stiffness[i]);
  }
  stiffness_.resize(nodes_.size());
  straight_from_.resize(nodes_.size());
  set_interaction(interaction_in_step(model, contact, -1));
}

void RigidContact::set_interaction(const Interaction& interaction) {
  friction_ = interaction.friction;
  shear_stress_limit_ = interaction.shear_stress_limit;
  elastic_slip_ = interaction.elastic_slip.value_or(0.0);
  law_ = interaction.behavior;
  const double scale = interaction.penalty_scale / penalty_scale_;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto spring = contact_spring(law_, area_[i], scale * penalty_[i]);
    stiffness_[i] = spring.stiffness;
    straight_from_[i] = spring.straight_from;
  }
}

void RigidContact::start_step(const double* position, const RigidBodyState& master, bool active,
                              std::vector<ContactPoint>& points) const {
  const MasterFrame frame(master);
  for (std::int32_t i = 0; i < size(); ++i) {
    const auto place = frame.inverse * frame.arm(position + 4 * static_cast<std::ptrdiff_t>(nodes_[i]));
    if (!active || points[i].closed == 0.0) open(points[i], place);
    // A stiff spring without a force begins here, if the step brings friction.
    const bool unloaded = points[i].stiff_spring > 0.0 && points[i].closed > 0.0 && points[i].stiff_friction == Point{};
    if (!unloaded) continue;
    const auto normal = surface_.nearest(place).normal;
    points[i].anchor = (place + dot(Vector3<double>{points[i].anchor} - place, normal) * normal).component;
  }
}

void RigidContact::add_forces(const double* position, const RigidBodyState& master, std::vector<ContactPoint>& points,
                              double* force) const {
  const MasterFrame frame(master);
  for (std::int32_t i = 0; i < size(); ++i) {
    if (points[i].stiff_spring > 0.0) continue;
    const double* x = position + 4 * static_cast<std::ptrdiff_t>(nodes_[i]);
    const auto contact = contact_force(surface_, parameters(i, points[i]), frame.inverse * frame.arm(x), points[i]);
    if (!contact.closed) continue;
    const auto global = frame.rotation * (contact.normal + contact.friction);
    double* sum = force + 4 * static_cast<std::ptrdiff_t>(nodes_[i]);
    for (int k = 0; k < 3; ++k) sum[k] += rounded(global[k], sum[3]);
  }
}

RigidContact::Deepest RigidContact::deepest(const double* position, const RigidBodyState& master,
                                            const std::vector<ContactPoint>& points, Which which) const {
  const MasterFrame frame(master);
  Deepest deepest;
  for (std::int32_t i = 0; i < size(); ++i) {
    const auto place = frame.inverse * frame.arm(position + 4 * static_cast<std::ptrdiff_t>(nodes_[i]));
    if (surface_.surely_outside(place) || (which == Which::open && points[i].closed > 0.0)) continue;
    const double depth = -surface_.nearest(place).distance;
    if (depth > deepest.depth) deepest = {depth, nodes_[i]};
  }
  return deepest;
}

bool RigidContact::past_end(const double* position, const RigidBodyState& master,
                            const std::vector<ContactPoint>& points) const {
  const MasterFrame frame(master);
  for (std::int32_t i = 0; i < size(); ++i)
    if (points[i].closed > 0.0 &&
        surface_.past_end(frame.inverse * frame.arm(position + 4 * static_cast<std::ptrdiff_t>(nodes_[i]))))
      return true;
  return false;
}

void RigidContact::add_master_resultant(const double* position, const RigidBodyState& master,
                                        const std::vector<ContactPoint>& points,
                                        std::span<ExactSum, 6> force_and_moment) const {
  const MasterFrame frame(master);
  for (std::int32_t i = 0; i < size(); ++i) {
    if (!owned_[i]) continue;
    const auto arm = frame.arm(position + 4 * static_cast<std::ptrdiff_t>(nodes_[i]));
    const auto contact = acting_force(i, frame.inverse * arm, points[i]);
    if (!contact.closed) continue;
    const auto on_slave = frame.rotation * (contact.normal + contact.friction);
    const auto moment = cross(arm, on_slave);
    for (int k = 0; k < 3; ++k) {
      force_and_moment[k].add(-on_slave[k]);
      force_and_moment[3 + k].add(-moment[k]);
    }
  }
}

ContactTangent RigidContact::linearize(std::int32_t point, const double* position, const RigidBodyState& master,
                                       const ContactPoint& old, ContactPoint& updated, bool sticks,
                                       const Vector3<double>& last_slip) const {
  using Scalar = Dual<9>;
  const MasterFrame frame(master);
  const auto arm = frame.arm(position + 4 * static_cast<std::ptrdiff_t>(nodes_[point]));
  Vector3<Scalar> moved, spin;
  for (int i = 0; i < 3; ++i) {
    moved[i] = Scalar(arm[i], i);
    moved[i].derivative[3 + i] = -1.0;  // the master moves the other way
    spin[i] = Scalar(0.0, 6 + i);
  }
  // exp(spin) to first order about zero: the body frame sees the arm turned back, and the force turns along.
  const auto place = constant<Scalar>(frame.inverse) * (moved - cross(spin, moved));
  updated = old;
  auto contact = contact_force(surface_, parameters(point, old), place, updated);
  ContactTangent tangent{.node = nodes_[point], .closed = contact.closed, .slip = frame.rotation * contact.slip};
  if (!contact.closed) return tangent;
  if (sticks || dot(last_slip, tangent.slip) < 0.0) stick(place, surface_.nearest(values(place)).normal, contact);
  const auto global = constant<Scalar>(frame.rotation) * (contact.normal + contact.friction);
  const auto turned = global + cross(spin, global);
  for (int i = 0; i < 3; ++i) {
    tangent.force[i] = turned[i].value;
    std::copy_n(turned[i].derivative.begin(), 9, tangent.derivative.begin() + 9 * i);
  }
  return tangent;
}

void RigidContact::lower_multipliers(const double* position, const RigidBodyState& master, std::vector<ContactPoint>& points) const {
  const MasterFrame frame(master);
  for (std::int32_t i = 0; i < size(); ++i) {
    if (!(points[i].multiplier > 0.0)) continue;
    const double gap = surface_.nearest(frame.inverse * frame.arm(position + 4 * static_cast<std::ptrdiff_t>(nodes_[i]))).distance;
    points[i].multiplier = std::max(0.0, points[i].multiplier - parameters(i, points[i]).stiffness * std::max(0.0, gap));
  }
}

double RigidContact::augment(const double* position, const RigidBodyState& master,
                             std::vector<ContactPoint>& points) const {
  const MasterFrame frame(master);
  double greatest = 0.0;
  if (is_soft()) return greatest;
  for (std::int32_t i = 0; i < size(); ++i) {
    const auto arm = frame.arm(position + 4 * static_cast<std::ptrdiff_t>(nodes_[i]));
    const double gap = surface_.nearest(frame.inverse * arm).distance;
    points[i].multiplier = std::max(0.0, points[i].multiplier - parameters(i, points[i]).stiffness * gap);
    if (points[i].multiplier > 0.0) greatest = std::max(greatest, std::abs(gap));
  }
  return greatest;
}

namespace {

/// Energy that the normal spring holds.
double normal_energy(const PenaltyParameters& spring, double multiplier, double gap) {
  if (spring.law != nullptr) return spring.energy_of_law(multiplier, -gap);
  // A multiplier holds without a stretch: nothing is stored where the gap is zero.
  const double stretched = std::max(0.0, multiplier - spring.stiffness * gap), held = std::max(0.0, multiplier);
  return 0.5 * (stretched * stretched - held * held) / spring.stiffness;
}

}  // namespace

RigidContact::Output RigidContact::output(std::int32_t point, const double* position, const RigidBodyState& master,
                                          const ContactPoint& state) const {
  const MasterFrame frame(master);
  const auto arm = frame.arm(position + 4 * static_cast<std::ptrdiff_t>(nodes_[point]));
  const auto place = frame.inverse * arm;
  const auto contact = acting_force(point, place, state);
  Output output;
  output.gap = surface_.nearest(place).distance;
  output.slip = state.slip;
  if (!contact.closed || state.closed == 0.0) return output;
  const double square = dot(contact.friction, contact.friction);
  output.pressure = contact.pressure / area_[point];
  output.shear = std::sqrt(square) / area_[point];
  output.normal_force = (frame.rotation * contact.normal).component;
  output.friction_force = (frame.rotation * contact.friction).component;
  output.spring_energy = normal_energy(parameters(point, state), state.multiplier, output.gap);
  if (contact.tangential_stiffness > 0.0) output.spring_energy += 0.5 * square / contact.tangential_stiffness;
  return output;
}

ContactResultant RigidContact::resultant(const Communicator& communicator, const double* position,
                                         const RigidBodyState& master, const std::vector<ContactPoint>& points) const {
  ContactResultantSum sum;
  for (std::int32_t i = 0; i < size(); ++i) {
    if (!owned_[i]) continue;
    const Output at = output(i, position, master, points[i]);
    const double* x = position + 4 * static_cast<std::ptrdiff_t>(nodes_[i]);
    sum.add({x[0], x[1], x[2]}, at.gap, at.pressure, area_[i], {at.normal_force}, {at.friction_force});
  }
  return sum.total(communicator);
}

void RigidContact::add_spring_stiffness(const std::vector<bool>& stiff, std::span<double> sum) const {
  // The instants of the loop are not those at which a spring closes and opens: the energy of a blow that this makes goes as the square
  // of the increment, and is within a hundredth at an eighth of what stability allows.
  const double exact = is_soft() ? 64.0 : 1.0;
  for (std::int32_t i = 0; i < size(); ++i)
    if (!stiff[i]) sum[nodes_[i]] += exact * stiffness_[i];
}

}  // namespace balocco
