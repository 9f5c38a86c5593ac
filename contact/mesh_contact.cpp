#include "mesh_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "contact_resultant.hpp"
#include "elements/slave_places.hpp"
#include "elements/surface_nodes.hpp"
#include "model/diagnostics.hpp"
#include "model/interaction_in_step.hpp"
#include "slave_surface.hpp"

namespace balocco {

namespace {

/// An open place as near as this, of the faces' edge, has the stiffness of a closed one but no force: so a body that only touches is
/// held against being pressed, whatever rounding says.
constexpr double touching = 1e-6;
/// Up to which CalculiX's springs pull, of the edge of the area of a node.
constexpr double default_clearance = 1e-3;
/// Up to which a place is tied, of the faces' edge: the tolerance of Abaqus's *TIE.
constexpr double tied_within = 0.05;

std::vector<double> stiffness_per_area(const Model& model, const ContactPair& pair) {
  const SlaveNodes slave = slave_nodes(model, pair);
  std::vector<double> density(static_cast<std::size_t>(model.nodes.size()), 0.0);
  for (std::size_t i = 0; i < slave.rows.size(); ++i) density[slave.rows[i]] = slave.stiffness[i] / slave.area[i];
  return density;
}

/// Squares of the distance from each node to the nearest other one, in the order of `rows`.
std::vector<double> nearest_squares(const Model& model, const std::vector<std::int32_t>& rows) {
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto at = [&](std::size_t i) { return model.nodes.coordinates[rows[order[i]]]; };
  std::ranges::sort(order, {}, [&](std::size_t i) { return model.nodes.coordinates[rows[i]][0]; });
  std::vector<double> squares(rows.size(), std::numeric_limits<double>::max());
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const auto a = at(i), b = at(j);
      const double ahead = (b[0] - a[0]) * (b[0] - a[0]);
      if (ahead > squares[order[i]]) break;
      const double square = ahead + (b[1] - a[1]) * (b[1] - a[1]) + (b[2] - a[2]) * (b[2] - a[2]);
      for (const auto k : {order[i], order[j]}) squares[k] = std::min(squares[k], square);
    }
  return squares;
}

void refuse_turned_surfaces(const Model& model, const ContactPair& pair) {
  const auto &slave = model.surfaces[pair.slave], &master = model.surfaces[pair.master];
  if (!faces_away(model, slave, master)) return;
  throw InputError(fmt::format("{}: error: *CONTACT PAIR: the surfaces {} and {} face the same way: none of the faces of {} looks towards "
                               "the nearest of {}; name the other side of the elements of one of them (SPOS or SNEG, another of S1 to S6)",
                               model.where(pair.location), slave.name, master.name, slave.name, master.name));
}

}  // namespace

MeshContact::MeshContact(const Model& model, std::int32_t row, const Domain& domain) {
  const ContactPair& pair = model.contact_pairs[row];
  refuse_turned_surfaces(model, pair);
  const auto nodes = surface_nodes(model, model.surfaces[pair.slave]);
  if (nodes.empty() || domain.local_node[nodes.front()] >= 0) faces_ = MasterFaces(model, model.surfaces[pair.master], domain.local_node);
  of_faces_ = pair.of_faces;
  std::vector<double> density(static_cast<std::size_t>(model.nodes.size()), 0.0);
  if (needs_penalty_stiffness(model, pair)) density = stiffness_per_area(model, pair);
  if (pair.interaction >= 0) penalty_scale_ = model.interactions[pair.interaction].penalty_scale;
  const bool of_nodes = model.surfaces[pair.slave].faces.empty();
  const auto squares = of_nodes ? nearest_squares(model, nodes) : std::vector<double>{};
  const auto masters = surface_nodes(model, model.surfaces[pair.master]);
  std::size_t row_of_node = 0;
  for (auto& from : slave_places(model, pair)) {
    const double square = of_nodes ? squares[row_of_node++] : from.area;
    if (domain.local_node[from.nodes.front()] < 0) continue;
    auto& place = places_.emplace_back();
    for (std::size_t i = 0; i < from.nodes.size(); ++i) {
      place.nodes.push_back(domain.local_node[from.nodes[i]]);
      place.penalty += from.area * from.weights[i] * density[from.nodes[i]];
    }
    place.weights = std::move(from.weights);
    place.area = from.area;
    place.spacing = square;
    // A node of the master itself is never off it.
    const bool of_master = !pair.of_faces && std::ranges::binary_search(masters, from.nodes.front());
    place.owned = domain.owned[place.nodes.front()] && !of_master;
  }
  for (const auto surface : {pair.slave, pair.master})
    for (const auto node : surface_nodes(model, model.surfaces[surface]))
      if (const auto local = domain.local_node[node]; local >= 0) nodes_.push_back(local);
  master_area_.resize(domain.local_node.size());
  for (const auto& from : slave_places(model, {.slave = pair.master, .master = pair.master}))
    if (const auto local = domain.local_node[from.nodes.front()]; local >= 0) master_area_[local] = from.area;
  set_interaction(interaction_in_step(model, pair, -1));
}

void MeshContact::set_interaction(const Interaction& interaction) {
  friction_ = interaction.friction;
  shear_stress_limit_ = interaction.shear_stress_limit;
  elastic_slip_ = interaction.elastic_slip.value_or(0.0);
  stick_slope_ = interaction.stick_slope.value_or(0.0);
  law_ = interaction.behavior;
  soft_ = law_.is_soft();
  curved_ = soft_ && law_.kind != PressureLaw::Kind::linear;
  tied_ = std::isinf(law_.tension);
  tension_width_ = law_.kind == PressureLaw::Kind::linear && !of_faces_ ? std::numbers::pi * law_.tension / law_.slope : 0.0;
  spring_clearance_ = law_.spring_clearance;
  const double scale = interaction.penalty_scale / penalty_scale_;
  for (auto& place : places_) {
    const auto spring = contact_spring(law_, place.area, scale * place.penalty);
    place.stiffness = spring.stiffness;
    place.straight_from = spring.straight_from;
  }
}

void MeshContact::prepare(const double* position, bool implicit) {
  constexpr double in_iterations = 2.0, in_cycles = 0.5;  // of the faces' edge
  // A law may push afar.
  faces_.set_reach(std::max((implicit ? in_iterations : in_cycles) * faces_.edge(), curved_ ? -2.0 * law_.start() : 0.0));
  located_.clear();
  follow(position);
}

void MeshContact::follow(const double* position) {
  const double most = 0.5 * faces_.reach();
  bool moved = located_.empty();
  for (std::size_t i = 0; i < nodes_.size() && !moved; ++i) {
    const double* x = position + 4 * static_cast<std::ptrdiff_t>(nodes_[i]);
    double square = 0.0;
    for (int k = 0; k < 3; ++k) square += (x[k] - located_[3 * i + k]) * (x[k] - located_[3 * i + k]);
    moved = !(square < most * most);
  }
  if (!moved || nodes_.empty()) return;
  located_.resize(3 * nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) std::copy_n(position + 4 * static_cast<std::ptrdiff_t>(nodes_[i]), 3, &located_[3 * i]);
  faces_.locate(position);
}

PenaltyParameters MeshContact::parameters(const Place& place, const ContactPoint& state) const {
  return {.stiffness = stiffness(place, state),
          .tangential = stick_slope_ * place.area,
          .friction = friction_,
          .elastic_slip = elastic_slip_,
          .shear_limit = shear_stress_limit_ * place.area,
          .law = curved_ ? &law_ : nullptr,
          .area = place.area,
          .straight_from = straight_from(place, state)};
}

Vector3<double> MeshContact::at(const Place& place, const double* position) const {
  Vector3<double> sum{};
  for (std::size_t i = 0; i < place.nodes.size(); ++i) {
    const double* x = position + 4 * static_cast<std::ptrdiff_t>(place.nodes[i]);
    sum = sum + place.weights[i] * Vector3<double>{x[0], x[1], x[2]};
  }
  return sum;
}

Vector3<double> MeshContact::anchor_of(const double* position, const ContactPoint& point) const {
  return faces_.at(position, static_cast<std::int32_t>(point.anchor[0]), point.anchor[1], point.anchor[2]);
}

std::optional<MeshContact::NormalSpring> MeshContact::spring_at(const Place& place, const FacePlace& foot,
                                                                const ContactPoint& state) const {
  if (foot.face < 0) return std::nullopt;
  const double k = stiffness(place, state), overclosure = -foot.distance;
  if (tension_width_ > 0.0) {
    const double clearance = spring_clearance_ > 0.0 ? spring_clearance_ : default_clearance * std::sqrt(place.area);
    if (foot.distance > clearance) return std::nullopt;
    const double x = overclosure / tension_width_, share = 0.5 + std::atan(x) / std::numbers::pi;
    return NormalSpring{k * overclosure * share, -k * (share + x / (std::numbers::pi * (1.0 + x * x))), true};
  }
  if (tied_) {
    if (state.closed == 0.0 && std::abs(foot.distance) > tied_within * faces_.edge()) return std::nullopt;
    return NormalSpring{k * overclosure, -k, true};
  }
  if (curved_) {
    const auto found = law_.at(overclosure, straight_from(place, state));
    const double force = state.multiplier + place.area * found.pressure;
    return force > 0.0 ? std::optional(NormalSpring{force, -place.area * found.slope, true}) : std::nullopt;
  }
  const double force = state.multiplier + k * overclosure;
  if (force > 0.0) return NormalSpring{force, -k, true};
  if (force > -k * touching * faces_.edge()) return NormalSpring{0.0, -k, false};
  return std::nullopt;
}

double MeshContact::spring_energy(const Place& place, const ContactPoint& state, double gap) const {
  const double k = stiffness(place, state), e = tension_width_;
  if (e > 0.0) return k * (0.25 * gap * gap + (0.5 * (gap * gap + e * e) * std::atan(-gap / e) + 0.5 * e * gap) / std::numbers::pi);
  if (tied_) return 0.5 * k * gap * gap;
  if (curved_) return parameters(place, state).energy_of_law(state.multiplier, -gap);
  // A multiplier holds without a stretch: nothing is stored where the gap is zero.
  const double force = std::max(0.0, state.multiplier - k * gap), held = std::max(0.0, state.multiplier);
  return 0.5 * (force * force - held * held) / k;
}

void MeshContact::open(const FacePlace& foot, ContactPoint& point) const {
  point.multiplier = point.closed = 0.0;
  point.stiff_friction = {};
  point.anchor = {static_cast<double>(foot.face), foot.xi, foot.eta};
}

void MeshContact::slide(const double* position, const Vector3<double>& slip, const Vector3<double>& where, const FacePlace& foot,
                        ContactPoint& point) const {
  point.stiff_friction = (Vector3<double>{point.stiff_friction} + slip).component;
  set_anchor(position, where, foot, point);
}

/// The anchor goes to the place of the surface that is nearest to `where`.
void MeshContact::set_anchor(const double* position, const Vector3<double>& where, const FacePlace& otherwise, ContactPoint& point) const {
  auto there = faces_.nearest(position, where);
  if (there.face < 0) there = otherwise;
  point.anchor = {static_cast<double>(there.face), there.xi, there.eta};
}

MeshPairing MeshContact::pairing(std::int32_t index, const double* position, const ContactPoint& old) const {
  const auto& place = places_[index];
  const auto foot = faces_.nearest(position, at(place, position));
  if (!spring_at(place, foot, old)) return {};
  const auto anchor = static_cast<std::int32_t>(old.anchor[0]);
  return {.face = foot.face, .anchor_face = has_anchor(old) && anchor != foot.face ? anchor : -1};
}

void MeshContact::coupled_nodes(std::int32_t place, const MeshPairing& pairing, std::vector<std::int32_t>& nodes) const {
  nodes = places_[place].nodes;
  for (const auto face : {pairing.face, pairing.anchor_face})
    if (face >= 0) nodes.insert(nodes.end(), faces_.nodes(face).begin(), faces_.nodes(face).end());
}

void MeshContact::start_step(const double* position, bool active, std::vector<ContactPoint>& points) const {
  for (std::int32_t i = 0; i < size(); ++i)
    if (!active || points[i].closed == 0.0) open(faces_.nearest(position, at(places_[i], position)), points[i]);
}

double MeshContact::augment(const double* position, std::vector<ContactPoint>& points) const {
  double greatest = 0.0;
  if (soft_) return greatest;
  for (std::int32_t i = 0; i < size(); ++i) {
    const auto foot = faces_.nearest(position, at(places_[i], position));
    auto& multiplier = points[i].multiplier;
    multiplier = foot.face < 0 ? 0.0 : std::max(0.0, multiplier - stiffness(places_[i], points[i]) * foot.distance);
    if (multiplier > 0.0) greatest = std::max(greatest, std::abs(foot.distance));
  }
  return greatest;
}

void MeshContact::lower_multipliers(const double* position, std::vector<ContactPoint>& points) const {
  for (std::int32_t i = 0; i < size(); ++i) {
    if (!(points[i].multiplier > 0.0)) continue;
    const auto foot = faces_.nearest(position, at(places_[i], position));
    const double gap = foot.face < 0 ? faces_.reach() : std::max(0.0, foot.distance);
    points[i].multiplier = std::max(0.0, points[i].multiplier - stiffness(places_[i], points[i]) * gap);
  }
}

MeshContact::Output MeshContact::output(std::int32_t index, const double* position, const ContactPoint& state) const {
  const auto& place = places_[index];
  Output output{.slip = state.slip, .at = at(place, position)};
  const auto foot = faces_.nearest(position, output.at);
  output.gap = foot.face < 0 ? faces_.reach() : foot.distance;
  const auto spring = spring_at(place, foot, state);
  if (!spring || state.closed == 0.0) return output;
  const auto law = parameters(place, state);
  ContactForce<double> contact;
  contact.pressure = spring->force;
  output.closed = true;
  output.normal = foot.normal;
  if (has_anchor(state) && holds_across(contact.pressure)) {
    auto scratch = state;
    auto stretch = output.at - anchor_of(position, state);
    stretch = stretch - dot(stretch, foot.normal) * foot.normal;
    add_across(law, stretch, scratch, contact);
    output.displacement = stretch + Vector3<double>{state.stiff_friction};
  }
  output.normal_force = contact.pressure * foot.normal;
  output.friction_force = contact.friction;
  output.pressure = contact.pressure / place.area;
  const double square = dot(contact.friction, contact.friction);
  output.shear = std::sqrt(square) / place.area;
  output.spring_energy = spring_energy(place, state, foot.distance);
  if (contact.tangential_stiffness > 0.0) output.spring_energy += 0.5 * square / contact.tangential_stiffness;
  return output;
}

void MeshContact::take_forces(std::int32_t index, const double* position, const ContactPoint& state, std::span<double> holding) const {
  const auto& place = places_[index];
  const auto found = output(index, position, state);
  if (!found.closed) return;
  const auto force = found.normal_force + found.friction_force;
  const auto foot = faces_.nearest(position, found.at);
  const auto nodes = faces_.nodes(foot.face);
  const auto shapes = face_shapes(nodes.size(), foot.xi, foot.eta);
  for (int k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < place.nodes.size(); ++i)
      holding[4 * static_cast<std::size_t>(place.nodes[i]) + k] -= place.weights[i] * force[k];
    for (std::size_t a = 0; a < nodes.size(); ++a) holding[4 * static_cast<std::size_t>(nodes[a]) + k] += shapes.value[a] * force[k];
  }
}

ContactResultant MeshContact::resultant(const Communicator& communicator, const double* position,
                                        const std::vector<ContactPoint>& points) const {
  ContactResultantSum sum;
  for (std::int32_t i = 0; i < size(); ++i) {
    if (!owned(i)) continue;
    const auto place = output(i, position, points[i]);
    sum.add(place.at, place.gap, place.pressure, area(i), place.normal_force, place.friction_force);
  }
  return sum.total(communicator);
}

}  // namespace balocco
