// Sums over the places of a contact pair, exact in any order.
#pragma once

#include <algorithm>
#include <array>

#include "communicator.hpp"
#include "math/exact_sum.hpp"
#include "math/tensor.hpp"
#include "model/results.hpp"

namespace balocco {

class ContactResultantSum {
 public:
  /// A place that this rank owns; forces on the slave.
  void add(const Vector3<double>& at, double gap, double pressure, double area, const Vector3<double>& normal_force,
           const Vector3<double>& friction_force) {
    penetration_ = std::max(penetration_, -gap);
    if (!(pressure > 0.0)) return;
    const auto moment = cross(at, normal_force + friction_force);
    const double force = pressure * area;
    for (int k = 0; k < 3; ++k) {
      sums_[k].add(normal_force[k]);
      sums_[3 + k].add(friction_force[k]);
      sums_[6 + k].add(moment[k]);
      sums_[9 + k].add(force * at[k]);
    }
    sums_[12].add(area);
    sums_[13].add(force);
  }

  /// Over all ranks. Collective.
  ContactResultant total(const Communicator& communicator) {
    communicator.sum(sums_);
    ContactResultant result;
    const double pressure = sums_[13].value();
    for (int k = 0; k < 3; ++k) {
      result.normal_force[k] = sums_[k].value();
      result.friction_force[k] = sums_[3 + k].value();
      result.moment[k] = sums_[6 + k].value();
      if (pressure > 0.0) result.center[k] = sums_[9 + k].value() / pressure;
    }
    result.area = sums_[12].value();
    result.greatest_penetration = communicator.maximum(penetration_);
    return result;
  }

 private:
  std::array<ExactSum, 14> sums_;  // normal force, friction force, moment, pressure x place, area, pressure
  double penetration_ = 0.0;
};

}  // namespace balocco
