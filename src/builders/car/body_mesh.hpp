// The body in white and the chassis as a mesh: parts of shells, and the spot welds that join them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "builders/car/sheet.hpp"

namespace balocco::car {

/// One pressing. Its nodes follow one another.
struct Part {
  std::string name, gauge, assembly;        // gauge: the name without its side
  int first_node = 0, nodes = 0, columns = 0;  // of the sheet's grid, row by row
  std::vector<std::array<int, 4>> quadrilaterals;
};

/// Nodes of different parts that a weld makes move as one; the first carries the others.
using Weld = std::vector<int>;

class BodyMesh {
 public:
  /// Parts added from here on belong to the assembly: what stays one piece if all of it is rigid. The first is BODY.
  void begin_assembly(const std::string& name) { assembly_ = name; }
  void add(const Sheet& sheet);
  /// A part of the left side and its mirror image: NAME_LEFT and NAME_RIGHT.
  void add_both(const Sheet& left);

  /// Joins two parts wherever they touch within `gap`, at least `pitch` apart. A weld may take a third and a fourth part in, but no
  /// part twice: every weld stays a small system of its own. Names without sides join parts of the same side, or both to the
  /// middle.
  /// @return how many places were joined.
  int weld(const std::string& first, const std::string& second, double gap, double pitch);

  const std::vector<Vector>& nodes() const { return nodes_; }
  const std::vector<Part>& parts() const { return parts_; }
  const Part& part_of(int node) const { return parts_[part_of_[node]]; }
  /// Welds of two and more nodes, in the order of making.
  std::vector<Weld> welds() const;
  const Part* find(const std::string& name) const;
  /// Nodes of the named parts (sides left out: both) that no weld uses, within `reach` of a place, in rising order.
  std::vector<int> free_nodes(const std::vector<std::string>& parts, const Vector& place, double reach) const;
  /// Parts that no chain of welds joins to the first one of their assembly.
  std::vector<std::string> loose_parts() const;

 private:
  int weld_pair(int first, int second, double gap, double pitch);
  bool join(int a, int b);

  std::string assembly_ = "BODY";
  std::vector<Vector> nodes_;
  std::vector<int> part_of_, weld_of_;
  std::vector<Part> parts_;
  std::vector<Weld> welds_;
};

}  // namespace balocco::car
