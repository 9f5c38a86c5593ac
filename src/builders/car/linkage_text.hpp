// Rigid parts and connectors of the suspension in the deck, under names that an engineer reads.
#pragma once

#include <string>
#include <vector>

#include "builders/car/deck_text.hpp"

namespace balocco::car {

/// A rigid part, its inertia that of a uniform box.
struct RigidPart {
  std::string name;
  double mass = 0.0;             // g; 0: what it carries has masses of its own
  Vector centre;                 // of gravity
  std::array<double, 3> size{};  // of the box, mm
  std::string surface;           // analytical surface that it carries; may be empty
};

/// Force over travel or velocity of one component: straight (stiffness alone) or by rows (force, travel).
struct Characteristic {
  int component = 1;
  double slope = 0.0;
  std::vector<std::array<double, 2>> table;  // (force, travel or velocity), rising
};

struct Behaviour {
  std::string name;
  std::vector<Characteristic> elasticity, damping;
  double free_length = 0.0;  // of component 1, mm; 0: as it stands
};

class LinkageText {
 public:
  explicit LinkageText(DeckText& deck) : deck_(deck) {}

  /// Nodes of rigid parts become `NAME_POINT`. Inertia and the *RIGID BODY are written when the part is closed.
  std::int64_t point(const std::string& name, const Vector& place) { return deck_.named_node(name, place); }
  /// The part's centre becomes node `NAME`, which carries the points.
  void rigid(const RigidPart& part, const std::vector<std::int64_t>& points);
  void behaviour(const Behaviour& behaviour);
  /// `orientation` and `behaviour` may be empty.
  void connector(const std::string& name, const std::string& type, std::int64_t first, std::int64_t second,
                 const std::string& orientation, const std::string& behaviour);
  /// Local direction 1 along `axis`.
  void orientation(const std::string& name, const Vector& axis);

 private:
  void curve(const char* kind, const Characteristic& characteristic);
  DeckText& deck_;
};

}  // namespace balocco::car
