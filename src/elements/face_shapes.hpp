// Shape functions of the faces of solids and sheets, for the corners and then the middles of the edges; quadrilaterals over
// -1 <= xi, eta <= 1, triangles over xi, eta >= 0, xi + eta <= 1. And the quadratures with which pressure is integrated over them.
#pragma once

#include <array>

namespace balocco {

/// Shape functions at a place of a face, and their derivatives.
template <int nodes>
struct FaceShapes {
  std::array<double, nodes> value{}, by_xi{}, by_eta{};
};

/// A place of a quadrature.
struct FaceStation {
  double xi = 0.0, eta = 0.0, weight = 1.0;
};

inline constexpr std::array<std::array<int, 2>, 4> face_corners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

/// Four nodes, 2 x 2 Gauss points: exact for the cubic integrand.
struct BilinearFace {
  static constexpr int nodes = 4;
  static constexpr FaceShapes<nodes> at(double x, double y) {
    FaceShapes<nodes> shapes;
    for (int i = 0; i < nodes; ++i) {
      const auto [xi, eta] = face_corners[i];
      const double along_xi = 1.0 + xi * x, along_eta = 1.0 + eta * y;
      shapes.value[i] = 0.25 * along_xi * along_eta;
      shapes.by_xi[i] = 0.25 * xi * along_eta;
      shapes.by_eta[i] = 0.25 * eta * along_xi;
    }
    return shapes;
  }
  static constexpr std::array<FaceStation, 4> stations() {
    constexpr double gauss = 0.57735026918962576451;  // 1 / sqrt(3)
    std::array<FaceStation, 4> stations{};
    for (int q = 0; q < 4; ++q) stations[q] = {gauss * face_corners[q][0], gauss * face_corners[q][1], 1.0};
    return stations;
  }
};

/// Eight nodes, 3 x 3 Gauss points.
struct SerendipityFace {
  static constexpr int nodes = 8;
  static constexpr FaceShapes<nodes> at(double x, double y) {
    FaceShapes<nodes> shapes;
    for (int i = 0; i < 4; ++i) {
      const auto [xi, eta] = face_corners[i];
      const double along_x = 1.0 + xi * x, along_y = 1.0 + eta * y;
      shapes.value[i] = 0.25 * along_x * along_y * (xi * x + eta * y - 1.0);
      shapes.by_xi[i] = 0.25 * xi * along_y * (2.0 * xi * x + eta * y);
      shapes.by_eta[i] = 0.25 * eta * along_x * (xi * x + 2.0 * eta * y);
    }
    for (int i = 0; i < 4; ++i) {  // edge i from corner i: along xi where i is even
      const double side = i == 0 || i == 3 ? -1.0 : 1.0, along = i % 2 == 0 ? x : y, across = i % 2 == 0 ? y : x;
      const double slope = -along * (1.0 + side * across), slope_across = 0.5 * side * (1.0 - along * along);
      shapes.value[4 + i] = 0.5 * (1.0 - along * along) * (1.0 + side * across);
      shapes.by_xi[4 + i] = i % 2 == 0 ? slope : slope_across;
      shapes.by_eta[4 + i] = i % 2 == 0 ? slope_across : slope;
    }
    return shapes;
  }
  static constexpr std::array<FaceStation, 9> stations() {
    constexpr double far = 0.77459666924148337704;  // sqrt(3 / 5)
    constexpr std::array<double, 3> place{-far, 0.0, far}, weight{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    std::array<FaceStation, 9> stations{};
    for (int q = 0; q < 9; ++q) stations[q] = {place[q % 3], place[q / 3], weight[q % 3] * weight[q / 3]};
    return stations;
  }
};

/// Three nodes. Pressure takes it for a quadrilateral whose last two corners are one.
struct LinearTriangleFace {
  static constexpr int nodes = 3;
  static constexpr FaceShapes<nodes> at(double x, double y) { return {{1.0 - x - y, x, y}, {-1.0, 1.0, 0.0}, {-1.0, 0.0, 1.0}}; }
};

/// Six nodes of a triangle, seven points exact to the fifth degree (Radon 1948).
struct QuadraticTriangleFace {
  static constexpr int nodes = 6;
  static constexpr FaceShapes<nodes> at(double x, double y) {
    const auto [l, by_xi, by_eta] = LinearTriangleFace::at(x, y);
    FaceShapes<nodes> shapes;
    for (int i = 0; i < 3; ++i) {
      const int next = (i + 1) % 3;
      shapes.value[i] = l[i] * (2.0 * l[i] - 1.0);
      shapes.by_xi[i] = (4.0 * l[i] - 1.0) * by_xi[i];
      shapes.by_eta[i] = (4.0 * l[i] - 1.0) * by_eta[i];
      shapes.value[3 + i] = 4.0 * l[i] * l[next];
      shapes.by_xi[3 + i] = 4.0 * (l[i] * by_xi[next] + l[next] * by_xi[i]);
      shapes.by_eta[3 + i] = 4.0 * (l[i] * by_eta[next] + l[next] * by_eta[i]);
    }
    return shapes;
  }
  static constexpr std::array<FaceStation, 7> stations() {
    constexpr double root = 3.87298334620741688518;  // sqrt(15)
    constexpr double a = (6.0 - root) / 21.0, b = (6.0 + root) / 21.0, third = 1.0 / 3.0;
    constexpr double w_a = (155.0 - root) / 2400.0, w_b = (155.0 + root) / 2400.0;
    return {{{third, third, 9.0 / 80.0},
             {a, a, w_a},
             {1.0 - 2.0 * a, a, w_a},
             {a, 1.0 - 2.0 * a, w_a},
             {b, b, w_b},
             {1.0 - 2.0 * b, b, w_b},
             {b, 1.0 - 2.0 * b, w_b}}};
  }
};

/// Shape functions times the weight, and their derivatives, at the places of the quadrature.
template <class Face>
constexpr auto integration_points() {
  constexpr auto stations = Face::stations();
  std::array<FaceShapes<Face::nodes>, stations.size()> points{};
  for (std::size_t q = 0; q < stations.size(); ++q) {
    points[q] = Face::at(stations[q].xi, stations[q].eta);
    for (double& value : points[q].value) value *= stations[q].weight;
  }
  return points;
}

}  // namespace balocco
