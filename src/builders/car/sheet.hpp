// Sheets: pressings as structured grids of quadrilaterals, and the ways in which the body's parts are drawn.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "builders/car/curve.hpp"

namespace balocco::car {

/// A grid of points, row by row. `closed`: the last column joins the first, as in a tube.
struct Sheet {
  std::string part;
  int rows = 0, columns = 0;
  bool closed = false;
  bool turned = false;  // elements face the other way: mirror images keep the order of their nodes
  std::vector<Vector> points = {};

  const Vector& at(int row, int column) const { return points[row * columns + column]; }
};

using Surface = std::function<Vector(double, double)>;

/// The grid of a surface at the stations u (rows) and v (columns).
Sheet sheet_on(const std::string& part, const std::vector<double>& u, const std::vector<double>& v, const Surface& surface);

/// Between two lines, straight across; as fine as `size` along and across.
Sheet between(const std::string& part, const Curve& first, const Curve& second, double size);

/// The line along which a member runs, and its axes there: `out` is where its outer half bulges, `across` lies in its flange plane.
struct Frame {
  Vector place, along, out, across;
};

/// Frames of a line at stations `size` apart. `outward` at a place need only be roughly across the line.
std::vector<Frame> frames(const Curve& line, double size, const std::function<Vector(const Vector&)>& outward);

/// A hat section, mm: a web of `width` at `depth` from the plane of its two flanges. The width at the member's end differs from
/// that at its start where `end_width` is not 0.
struct Hat {
  double width = 0.0, depth = 0.0, flange = 0.0, end_width = 0.0;
};

/// The hat along a member, bulging to its `out` side (to the other one with a negative depth).
Sheet hat_along(const std::string& part, const std::vector<Frame>& member, const Hat& hat, double size);

/// A rectangular tube along a member, of `width` across and `height` outwards, centred on its line.
Sheet tube_along(const std::string& part, const std::vector<Frame>& member, double width, double height, double size);

/// The same part on the other side, node for node; its elements face outwards there too.
Sheet mirrored(const Sheet& sheet, const std::string& part);

}  // namespace balocco::car
