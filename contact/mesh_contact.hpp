// Contact of the places of a slave surface (its nodes, or points of its faces) with the faces of deformable elements: finite sliding,
// Coulomb friction with elastic stick. The force of a place acts on the nodes of the slave by its weights, its opposite on those of the
// master's face by the shape functions at the foot.
//
// Normal force of a place: t = max(0, multiplier - stiffness * gap), the stiffness being its area times the slope that the deck gives
// (PRESSURE-OVERCLOSURE=LINEAR; the multiplier is zero then; of EXPONENTIAL and TABULAR see model/pressure_law.hpp), or in explicit
// steps that of the layer of slave elements behind it (slave_surface.hpp), in implicit steps 20 times as much, with a multiplier that the
// solver augments. Where the deck gives LINEAR a tension s, nodes have the law of CalculiX's node-to-face springs, pressure
// k d (1/2 + arctan(d / e) / pi) of the overclosure d with e = pi s / k, which pulls with s at great clearance (CalculiX CrunchiX User's
// Manual, "Node-to-Face Penalty Contact"). An infinite tension is PRESSURE-OVERCLOSURE=TIED: the places that lie on the master, to 5 % of
// the edge of its faces, have the pressure k d, which pulls too, and stick. Friction: a tangential spring from the anchor, a place of the
// master that moves with its material, cut at mu * t.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact_law.hpp"
#include "domain.hpp"
#include "master_faces.hpp"
#include "model/model.hpp"
#include "model/results.hpp"
#include "model/state.hpp"

namespace balocco {

/// Which nodes a contact place couples: decides the pattern of the stiffness.
struct MeshPairing {
  std::int32_t face = -1, anchor_face = -1;  // of the master; -1: none
  bool operator==(const MeshPairing&) const = default;
};

/// Forces of a contact place on its nodes, and their derivatives by the nodes' positions.
struct MeshTangent {
  bool closed = false;
  std::vector<std::int32_t> nodes;     // local: of the slave, of the master's face, of that of the anchor where it is another one
  std::vector<double> slave_shares;    // of each of them in a motion of the place: 1 of those of the slave, 0 of the others
  std::vector<double> force;           // 3 a node
  std::vector<double> derivative;      // row-major, 3 rows and columns a node
  Vector3<double> slip{};              // over the increment
};

/// What a pair sees of a cycle: nodal arrays (4 a node) and the increments before and behind the instant.
struct MeshCycle {
  const double* position = nullptr;
  const double* velocity = nullptr;  // over the increment before
  double previous = 0.0, next = 0.0;
};

class MeshContact {
 public:
  MeshContact() = default;
  /// Places on this rank, which knows all nodes of both surfaces. @throws InputError where the surfaces cannot form a pair.
  MeshContact(const Model& model, std::int32_t pair, const Domain& domain);

  std::int32_t size() const { return static_cast<std::int32_t>(places_.size()); }
  /// Whether this rank adds the forces of a place.
  bool owned(std::int32_t place) const { return places_[place].owned; }
  /// From now on the places press and rub so.
  void set_interaction(const Interaction& interaction);
  void set_friction(double coefficient) { friction_ = coefficient; }
  double area(std::int32_t place) const { return places_[place].area; }
  /// Of both surfaces, local.
  std::span<const std::int32_t> all_nodes() const { return nodes_; }
  std::span<const std::int32_t> nodes(std::int32_t place) const { return places_[place].nodes; }
  std::span<const double> weights(std::int32_t place) const { return places_[place].weights; }

  /// When a step starts or goes on: how far places may move in an iteration or a cycle decides how far faces are looked for.
  void prepare(const double* position, bool implicit);
  /// Keeps an eye on where the surfaces are, before the other functions are called with these positions.
  void follow(const double* position);
  /// The faces that a place would be coupled with at these positions.
  MeshPairing pairing(std::int32_t place, const double* position, const ContactPoint& old) const;
  /// Nodes that a place with this pairing couples, in the order of MeshTangent::nodes.
  void coupled_nodes(std::int32_t place, const MeshPairing& pairing, std::vector<std::int32_t>& nodes) const;

  /// At the start of a step: places of a pair that is not `active` open, and open places stand over the surface where they are.
  void start_step(const double* position, bool active, std::vector<ContactPoint>& points) const;
  /// Where a step brings another law of pressure: closed places begin with that alone.
  void forget_springs(bool implicit, std::vector<ContactPoint>& points) const;
  /// Gives places the springs of an implicit step, or of an explicit one; the forces of closed ones stay.
  void choose_springs(const double* position, bool implicit, std::vector<ContactPoint>& points) const;

  /// Explicit: advances the places that this rank owns and adds their forces, rounded with each node's constant, to the nodes of both
  /// surfaces. Call before the halo sums.
  void add_forces(const MeshCycle& cycle, std::vector<ContactPoint>& points, double* force);
  /// Adds the stiffness of the springs that act on each node of the surfaces, each counted with all that it moves, to `sum`: over the mass
  /// of the node it bounds the square of a frequency (Gershgorin). Wherever places may come.
  void add_spring_stiffness(std::span<double> sum) const;
  /// Deepest place of this rank below the surface, of those that are open or of all, and its first node.
  struct Deepest {
    double depth = 0.0;
    std::int32_t node = -1;  // local
  };
  Deepest deepest(const double* position, const std::vector<ContactPoint>& points, bool open_alone) const;

  /// Force and derivative of a place whose history at the start of the increment is `old`, for the nodes of `pairing`, which the place
  /// may have left; `updated` receives the history. `sticks`, `last_slip`: see RigidContact::linearize.
  void linearize(std::int32_t place, const MeshPairing& pairing, const double* position, const ContactPoint& old, ContactPoint& updated,
                 bool sticks, const Vector3<double>& last_slip, MeshTangent& tangent) const;

  /// Adds the spring's part to the multipliers of places that are not soft. @return greatest gap or penetration of a closed place on
  /// this rank before.
  double augment(const double* position, std::vector<ContactPoint>& points) const;
  /// Takes from the multipliers what pushes across a gap.
  void lower_multipliers(const double* position, std::vector<ContactPoint>& points) const;

  /// Of a place, for output; forces on the slave. A place that `state` says is open has no force.
  struct Output {
    double gap = 0.0, pressure = 0.0, shear = 0.0, slip = 0.0;
    Vector3<double> normal_force{}, friction_force{}, at{};
    double spring_energy = 0.0;
    Vector3<double> normal{}, displacement{};  // across it, of the slave relative to the master since the place closed
    bool closed = false;
  };
  Output output(std::int32_t place, const double* position, const ContactPoint& state) const;
  /// Takes the forces of a place from those that hold its nodes, 4 values a node.
  void take_forces(std::int32_t place, const double* position, const ContactPoint& state, std::span<double> holding) const;
  /// Resultant over all ranks. Collective, exact.
  ContactResultant resultant(const Communicator& communicator, const double* position, const std::vector<ContactPoint>& points) const;

 private:
  struct Place {
    std::vector<std::int32_t> nodes;  // local
    std::vector<double> weights;
    double area = 0.0, stiffness = 0.0;
    double penalty = 0.0;  // stiffness of hard contact, where any step has such
    double straight_from = std::numeric_limits<double>::infinity();  // see PressureLaw::at
    double spacing = 0.0;  // area that there is for each place: `area`, or of node-based surfaces the square of the nearest distance
    bool owned = false;
  };
  /// Of the spring that `state` has.
  double stiffness(const Place& place, const ContactPoint& state) const {
    return state.implicit_spring > 0.0 ? state.implicit_spring : place.stiffness;
  }
  PenaltyParameters parameters(const Place& place, const ContactPoint& state) const;
  Vector3<double> at(const Place& place, const double* position) const;
  Vector3<double> anchor_of(const double* position, const ContactPoint& point) const;
  bool has_anchor(const ContactPoint& point) const { return (tied_ || friction_ > 0.0) && point.anchor[0] >= 0.0; }
  /// Whether a place under a normal force rubs or is held.
  bool holds_across(double normal_force) const { return tied_ || normal_force > 0.0; }
  /// See add_tangential_spring(): Coulomb's limit does not cut what is tied.
  template <class T>
  double add_across(const PenaltyParameters& law, const Vector3<T>& stretch, ContactPoint& point, ContactForce<T>& force) const {
    if (!tied_) return add_tangential_spring(law, stretch, point, force);
    force.tangential_stiffness = law.tangential_spring();
    force.friction = -T(law.tangential_spring()) * stretch;
    return 1.0;
  }
  /// Force of the normal spring and its derivative by the gap; an open place that touches has no force, but a derivative.
  struct NormalSpring {
    double force = 0.0, slope = 0.0;
    bool closed = false;
  };
  double straight_from(const Place& place, const ContactPoint& state) const {
    return state.implicit_spring > 0.0 ? std::numeric_limits<double>::infinity() : place.straight_from;
  }
  /// Nothing where the place is open.
  std::optional<NormalSpring> spring_at(const Place& place, const FacePlace& foot, const ContactPoint& state) const;
  double spring_energy(const Place& place, const ContactPoint& state, double gap) const;
  void keep_force(const double* position, const Place& place, double spring, ContactPoint& point) const;
  double lacking_force(const double* position, const Place& place) const;
  /// Of an implicit step, as ContactPoint has it.
  double implicit_spring(const Place& place) const { return soft_ && !curved_ ? 0.0 : (soft_ ? 1.0 : stiff_factor) * place.stiffness; }
  template <int face_nodes>
  void linearize_on(std::int32_t place, const FacePlace& foot, const NormalSpring& spring, const double* position,
                    const ContactPoint& old, ContactPoint& updated, bool sticks, const Vector3<double>& last_slip, MeshTangent& tangent) const;
  void lower_multiplier(const Place& place, const FacePlace& foot, ContactPoint& point) const;
  void advance(const MeshCycle& cycle, const Place& place, ContactPoint& point, double* force) const;
  double mean_force(const MeshCycle& cycle, const Place& place, const FacePlace& foot, const ContactPoint& point) const;
  /// A place gives way by `slip`: its anchor goes with it.
  void slide(const double* position, const Vector3<double>& slip, const Vector3<double>& where, const FacePlace& foot,
             ContactPoint& point) const;
  void set_anchor(const double* position, const Vector3<double>& where, const FacePlace& otherwise, ContactPoint& point) const;
  void open(const FacePlace& foot, ContactPoint& point) const;

  MasterFaces faces_;
  std::vector<std::int32_t> nodes_;  // local, of both surfaces
  std::vector<double> located_;      // where they were when the faces were located, 3 a node
  std::vector<double> master_area_;  // per local node: share of the area of the master, undeformed
  std::vector<Place> places_;
  double friction_ = 0.0, elastic_slip_ = 0.0, stick_slope_ = 0.0;
  double shear_stress_limit_ = std::numeric_limits<double>::infinity();
  bool soft_ = false;           // the deck gives a law of pressure, which is not augmented then
  bool of_faces_ = false;
  bool tied_ = false;
  bool curved_ = false;         // which is not a straight line:
  PressureLaw law_;
  double penalty_scale_ = 1.0;  // with which penalties were found
  double tension_width_ = 0.0;  // overclosure over which a spring that may pull becomes stiff; 0: none may
  double spring_clearance_ = 0.0;
};

}  // namespace balocco
