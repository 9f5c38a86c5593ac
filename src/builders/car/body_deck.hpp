// The body in white in the deck: parts with their sections, welds, materials, and the masses that hang on them.
#pragma once

#include "builders/car/body_mesh.hpp"
#include "builders/car/car_spec.hpp"
#include "builders/car/deck_text.hpp"

namespace balocco::car {

/// Mass, centre and moments of inertia of a collection of things, summed about the origin.
class Inertia {
 public:
  void add(double mass, const Vector& place);
  /// A box of uniform mass; its own inertia counts.
  void add_box(double mass, const Vector& place, const std::array<double, 3>& size);
  double mass() const { return mass_; }
  Vector centre() const { return (1.0 / mass_) * moment_; }
  /// About axes through the centre: roll (x), pitch (y), yaw (z), g mm2.
  std::array<double, 3> about_centre() const;
  std::array<double, 3> about_origin() const { return about({}); }

 private:
  std::array<double, 3> about(const Vector& place) const;
  double mass_ = 0.0;
  Vector moment_;
  std::array<double, 3> squares_{};  // sums of m x^2, m y^2, m z^2
};

void add_part(const CarSpec& spec, const BodyMesh& mesh, const Part& part, Inertia& inertia);

/// Whether the chosen fidelity makes the part rigid: all, all but strut houses and subframe, or none. The beam between the trailing
/// arms never is: it is the axle's spring in roll.
bool is_rigid(const CarSpec& spec, const Part& part);

/// Row i of the mesh becomes node i + 1: they come first in the deck.
/// Each assembly becomes an element set with its name; the chassis stands in a chapter of its own.
void write_body(const CarSpec& spec, const BodyMesh& mesh, DeckText& deck);
/// Masses and mounts; each becomes a node set of one node with its name.
void write_mounts(const CarSpec& spec, const BodyMesh& mesh, DeckText& deck);
void write_materials(const CarSpec& spec, DeckText& deck);
/// A box of uniform mass on a node: elements M_NAME, and I_NAME for its inertia.
void write_mass(const std::string& name, std::int64_t node, double mass, const std::array<double, 3>& size, DeckText& deck);
/// A coupling that spreads what acts on the named node over the mesh's nodes.
void write_coupling(const std::string& name, std::int64_t node, const std::vector<int>& carriers, DeckText& deck);

/// Moments of inertia of a uniform box about its centre, g mm2.
std::array<double, 3> box_inertia(double mass, const std::array<double, 3>& size);

/// Masses or mounts with their other sides, NAME_left and NAME_right.
std::vector<MountSpec> on_both_sides(const std::vector<MountSpec>& mounts);

}  // namespace balocco::car
