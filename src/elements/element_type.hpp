// The register of element types. Adding one = its own header and source file in this folder, ending in one line:
//   static const RegisterElement registered({.name = "C3D8R", ...});
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "elements/element_group.hpp"
#include "model/model.hpp"

namespace balocco {

enum class Shape {
  point,
  line,
  triangle,
  quadrilateral,
  tetrahedron,
  wedge,
  hexahedron,
  quadratic_tetrahedron,  // corners, then the middles of the edges
  quadratic_wedge,
  quadratic_hexahedron
};

struct ElementType {
  std::string name;  // as the deck says it, upper case
  Shape shape = Shape::point;
  int nodes = 1;
  int integration_points = 1;
  bool turns = false;  // its nodes rotate: 6 freedoms a node
  Section::Kind section = Section::Kind::solid;
  /// Local node numbers of the corners of each face, counter-clockwise seen from outside (membranes: SPOS then SNEG).
  std::vector<std::vector<int>> faces;
  /// Quadratic elements: of each face the nodes behind its corners, in the middle of the edges that begin there.
  std::vector<std::vector<int>> face_midsides = {};
  bool implicit_only = false;  // explicit steps do not compute it
  /// Nanoseconds of one core per element and explicit cycle, in the middle of the laws that balocco_bench measures (elastic to
  /// Mooney-Rivlin, about a third to either side): estimates and the weights of the partition live on it.
  double cycle_cost = 100.0;
  /// Builds the force kernel of one section's elements on one rank; null for MASS and ROTARYI, which only carry inertia.
  std::unique_ptr<ElementGroup> (*make_group)(const GroupInput&) = nullptr;
  /// Integrals of N_I N_J over the reference volume (row-major, square), from which implicit steps make consistent masses and
  /// loads; null: they lump both, as explicit steps do.
  void (*shape_products)(std::span<const Point> nodes, std::span<double> products) = nullptr;
  /// Values of the shape functions at an integration point, one a node; null: the type tells no COORD.
  void (*point_shapes)(int point, std::span<double> values) = nullptr;
};

/// All local nodes of a face, corners first.
std::vector<int> nodes_of_face(const ElementType& type, int face);

/// The type of that name (upper case), or nullptr.
const ElementType* find_element_type(std::string_view name);

/// All registered types, sorted by name: for messages that name the nearest known word.
std::vector<const ElementType*> element_types();

/// True for analytical surfaces and for those of R3D3 and R3D4 alone: what can be the master of a contact pair.
bool is_rigid(const Model& model, const Surface& surface);
/// True for surfaces of the faces of elements that deform.
bool deforms(const Model& model, const Surface& surface);

struct RegisterElement {
  explicit RegisterElement(ElementType type);
};

}  // namespace balocco
