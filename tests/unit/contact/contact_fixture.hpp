// A contact pair with all that its functions ask for, where a test moves one node against the road.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "constraints/rigid_body.hpp"
#include "contact_model.hpp"
#include "rigid_contact.hpp"

namespace balocco::test {

/// A pair with all that its functions ask for; node 0 (a corner of the plate) is the point that most tests move.
struct Contact {
  Model model;
  Domain domain;
  RigidContact pair;
  RigidBodyState master;
  std::vector<double> position;
  std::vector<ContactPoint> points;

  explicit Contact(const AnalyticalSurface& surface = road({line({-300, 0}, {300, 0})}), double mu = friction,
                   std::optional<double> elastic_slip = std::nullopt)
      : model(make_model(surface, mu, elastic_slip)),
        domain(whole(model)),
        pair(model, 0, domain),
        master(initial_rigid_bodies(model)[0]),
        position(positions(model, domain)),
        points(pair.size()) {
    start_step();
  }

  static Model make_model(const AnalyticalSurface& surface, double mu, std::optional<double> elastic_slip) {
    Model model = plate_on_road(1, surface);
    model.interactions[0].friction = mu;
    model.interactions[0].elastic_slip = elastic_slip;
    return model;
  }

  double k() const { return pair.normal_stiffness(0); }
  /// Of node 0, in the frame of the master body.
  Point position_of() const {
    return {position[0] - master.position[0], position[1] - master.position[1], position[2] - master.position[2]};
  }
  void place(const Point& at) { std::copy(at.begin(), at.end(), position.begin()); }
  void start_step(bool active = true) { pair.start_step(position.data(), master, active, points); }
  /// A step starts with node 0 standing there.
  void start_at(const Point& at) {
    place(at);
    start_step();
  }

  /// Force of the explicit loop on node 0, with a rounding constant so fine that it hides nothing.
  Point force() {
    std::vector<double> sum(position.size(), 0.0);
    for (std::size_t i = 3; i < sum.size(); i += 4) sum[i] = rounding_constant(1e-3 * k());
    pair.add_forces(position.data(), master, points, sum.data());
    return {sum[0], sum[1], sum[2]};
  }
  ContactTangent tangent(ContactPoint& updated) const {
    return pair.linearize(0, position.data(), master, points[0], updated);
  }
};

inline double norm(const Point& a) {
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

}  // namespace balocco::test
