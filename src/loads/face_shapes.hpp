// Faces that pressure acts on: shape functions at the points of a quadrature, for the corners and then the middles of the edges.
#pragma once

#include <array>

namespace balocco {

/// A point of a face: shape functions times the weight, and their derivatives.
template <int nodes>
struct FacePoint {
  std::array<double, nodes> weighted{}, by_xi{}, by_eta{};
};

inline constexpr std::array<std::array<int, 2>, 4> face_corners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

/// Four nodes, 2 x 2 Gauss points: exact for the cubic integrand.
struct BilinearFace {
  static constexpr int nodes = 4;
  static constexpr std::array<FacePoint<nodes>, 4> points() {
    constexpr double gauss = 0.57735026918962576451;  // 1 / sqrt(3)
    std::array<FacePoint<nodes>, 4> points{};
    for (int q = 0; q < 4; ++q)
      for (int i = 0; i < nodes; ++i) {
        const auto [xi, eta] = face_corners[i];
        const double along_xi = 1.0 + xi * gauss * face_corners[q][0], along_eta = 1.0 + eta * gauss * face_corners[q][1];
        points[q].weighted[i] = 0.25 * along_xi * along_eta;
        points[q].by_xi[i] = 0.25 * xi * along_eta;
        points[q].by_eta[i] = 0.25 * eta * along_xi;
      }
    return points;
  }
};

/// Eight nodes, 3 x 3 Gauss points.
struct SerendipityFace {
  static constexpr int nodes = 8;
  static constexpr std::array<FacePoint<nodes>, 9> points() {
    constexpr double far = 0.77459666924148337704;  // sqrt(3 / 5)
    constexpr std::array<double, 3> place{-far, 0.0, far}, weight{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    std::array<FacePoint<nodes>, 9> points{};
    for (int q = 0; q < 9; ++q) {
      const double x = place[q % 3], y = place[q / 3], w = weight[q % 3] * weight[q / 3];
      for (int i = 0; i < 4; ++i) {
        const auto [xi, eta] = face_corners[i];
        const double along_x = 1.0 + xi * x, along_y = 1.0 + eta * y;
        points[q].weighted[i] = 0.25 * w * along_x * along_y * (xi * x + eta * y - 1.0);
        points[q].by_xi[i] = 0.25 * xi * along_y * (2.0 * xi * x + eta * y);
        points[q].by_eta[i] = 0.25 * eta * along_x * (xi * x + 2.0 * eta * y);
      }
      for (int i = 0; i < 4; ++i) {  // edge i from corner i: along xi where i is even
        const double side = i == 0 || i == 3 ? -1.0 : 1.0, along = i % 2 == 0 ? x : y, across = i % 2 == 0 ? y : x;
        const double value = 0.5 * (1.0 - along * along) * (1.0 + side * across);
        const double slope = -along * (1.0 + side * across), slope_across = 0.5 * side * (1.0 - along * along);
        points[q].weighted[4 + i] = w * value;
        points[q].by_xi[4 + i] = i % 2 == 0 ? slope : slope_across;
        points[q].by_eta[4 + i] = i % 2 == 0 ? slope_across : slope;
      }
    }
    return points;
  }
};

/// Six nodes of a triangle, seven points exact to the fifth degree (Radon 1948).
struct QuadraticTriangleFace {
  static constexpr int nodes = 6;
  static constexpr std::array<FacePoint<nodes>, 7> points() {
    constexpr double root = 3.87298334620741688518;  // sqrt(15)
    constexpr double a = (6.0 - root) / 21.0, b = (6.0 + root) / 21.0, third = 1.0 / 3.0;
    constexpr double w_a = (155.0 - root) / 2400.0, w_b = (155.0 + root) / 2400.0;
    constexpr double station[7][3] = {{third, third, 9.0 / 80.0}, {a, a, w_a}, {1.0 - 2.0 * a, a, w_a}, {a, 1.0 - 2.0 * a, w_a},
                                      {b, b, w_b}, {1.0 - 2.0 * b, b, w_b}, {b, 1.0 - 2.0 * b, w_b}};
    constexpr double by_xi[3] = {-1.0, 1.0, 0.0}, by_eta[3] = {-1.0, 0.0, 1.0};  // of the barycentric coordinates
    std::array<FacePoint<nodes>, 7> points{};
    for (int q = 0; q < 7; ++q) {
      const double l[3] = {1.0 - station[q][0] - station[q][1], station[q][0], station[q][1]}, w = station[q][2];
      for (int i = 0; i < 3; ++i) {
        const int next = (i + 1) % 3;
        points[q].weighted[i] = w * l[i] * (2.0 * l[i] - 1.0);
        points[q].by_xi[i] = (4.0 * l[i] - 1.0) * by_xi[i];
        points[q].by_eta[i] = (4.0 * l[i] - 1.0) * by_eta[i];
        points[q].weighted[3 + i] = w * 4.0 * l[i] * l[next];
        points[q].by_xi[3 + i] = 4.0 * (l[i] * by_xi[next] + l[next] * by_xi[i]);
        points[q].by_eta[3 + i] = 4.0 * (l[i] * by_eta[next] + l[next] * by_eta[i]);
      }
    }
    return points;
  }
};

}  // namespace balocco
