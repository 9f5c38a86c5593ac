// The surfaces that the body's parts lie on: the skin from the designer's lines, and the floor.
#pragma once

#include "builders/car/car_spec.hpp"

namespace balocco::car {

class BodyShape {
 public:
  explicit BodyShape(const CarSpec& spec) : profile_(spec.profile), body_(spec.body) {}

  /// Half width of the skin.
  double side(double x, double z) const { return profile_.plan(x) * profile_.section(z); }
  /// The left skin at x and z, moved inwards along its normal by `depth`.
  Vector skin(double x, double z, double depth = 0.0) const;
  /// Outward normal of the left skin.
  Vector skin_normal(double x, double z) const;
  Vector waist(double x, double depth = 0.0) const { return skin(x, profile_.waist(x), depth); }
  /// Where the roof meets the side, to the left.
  Vector roof_edge(double x, double depth = 0.0) const { return skin(x, profile_.roof(x) - profile_.roof_crown, depth); }

  /// The pressed floor at x and a station across it: 0 at the left sill, 1 to 2 up the tunnel's left side, 2 to 3 over it, 5 at the
  /// right sill.
  Vector floor(double x, double station) const;
  double floor_height(double x, double y) const { return rear_height(x) - well(x, y); }
  double floor_half_width(double x) const;
  /// The firewall between its foot (0) and the cowl (1), at a station of the floor's.
  Vector firewall(double up, double station) const;
  Curve firewall_line(double y) const;
  /// The wheel arches' edge on the skin: `angle` from the front horizontal over the wheel, rad.
  Vector arch_point(double wheel_x, double radius, double angle, double y) const;
  double wheel_height() const { return profile_.wheel_height; }
  /// z of the lower edge of the skin at x: the sill, or the arch over a wheel.
  double arch_height(double wheel_x, double x, double otherwise) const;

 private:
  double rear_height(double x) const;
  double well(double x, double y) const;

  const ProfileSpec& profile_;
  const BodySpec& body_;
};

}  // namespace balocco::car
