#include "hilbert.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace balocco {

namespace {

constexpr int bits = 20;

/// Grid cell -> Hilbert index in transposed form, after J. Skilling, "Programming the Hilbert curve", AIP Conf. Proc.
/// 707 (2004): undo the rotations from the coarsest level down, then Gray-encode.
void to_transposed_index(std::array<std::uint32_t, 3>& axis) {
  for (std::uint32_t level = 1U << (bits - 1); level > 1; level >>= 1) {
    const std::uint32_t lower = level - 1;
    for (auto& coordinate : axis) {
      if (coordinate & level) {
        axis[0] ^= lower;
      } else {
        const std::uint32_t exchanged = (axis[0] ^ coordinate) & lower;
        axis[0] ^= exchanged;
        coordinate ^= exchanged;
      }
    }
  }
  for (std::size_t i = 1; i < 3; ++i) axis[i] ^= axis[i - 1];
  std::uint32_t parity = 0;
  for (std::uint32_t level = 1U << (bits - 1); level > 1; level >>= 1)
    if (axis[2] & level) parity ^= level - 1;
  for (auto& coordinate : axis) coordinate ^= parity;
}

}  // namespace

std::uint64_t hilbert_index(const Point& point, const BoundingBox& box) {
  // One scale for all axes keeps cells cubic, so that locality is the same in every direction.
  double edge = 0.0;
  for (std::size_t c = 0; c < 3; ++c) edge = std::max(edge, box.high[c] - box.low[c]);
  const double scale = edge > 0.0 ? static_cast<double>((1U << bits) - 1) / edge : 0.0;
  std::array<std::uint32_t, 3> axis{};
  for (std::size_t c = 0; c < 3; ++c) axis[c] = static_cast<std::uint32_t>((point[c] - box.low[c]) * scale);
  to_transposed_index(axis);
  std::uint64_t index = 0;
  for (int bit = bits - 1; bit >= 0; --bit)
    for (const std::uint32_t coordinate : axis) index = (index << 1) | ((coordinate >> bit) & 1U);
  return index;
}

}  // namespace balocco
