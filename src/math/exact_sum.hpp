// Sums that do not depend on the order of their addends, hence not on the number of ranks.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace balocco {

/// The constant M = 1.5 * 2^52 * q for the smallest power of two q >= 2^-51 * `largest_sum`. Every addend rounded with
/// it is a multiple of q, so adding is exact, hence associative, as long as every partial sum stays below 2 *
/// `largest_sum`.
inline double rounding_constant(double largest_sum) {
  int exponent = 0;
  std::frexp(largest_sum, &exponent);
  return std::ldexp(1.5, exponent - 51 + 52);
}

/// `addend` rounded to a multiple of the quantum that belongs to `constant` = rounding_constant(...).
template <class T>
T rounded(const T& addend, const T& constant) {
  return (addend + constant) - constant;
}

/// Exact sum of any doubles (Kulisch's long accumulator): order-free, no scale to choose, about 2 ns an addend. For
/// energies and resultants; the words of two accumulators may be added as integers (MPI_SUM) to merge them.
class ExactSum {
 public:
  static constexpr int digit_count = 70;  // 32-bit digits that cover 2^-1074 .. 2^1024, with room for carries
  static constexpr int word_count = digit_count + 1;  // the last word counts addends that were no finite numbers

  void add(double addend) {
    const auto bits = std::bit_cast<std::uint64_t>(addend);
    const auto exponent = static_cast<int>(bits >> 52 & 0x7FF);
    if (exponent == 0x7FF) {  // infinite or not a number
      ++words_[digit_count];
      return;
    }
    const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
    const std::uint64_t mantissa = exponent == 0 ? fraction : fraction | std::uint64_t{1} << 52;
    const int lowest_bit = std::max(exponent, 1) - 1075 + bias;  // of the mantissa, an integer
    const int shift = lowest_bit % 32;
    auto* word = words_.data() + lowest_bit / 32;
    const auto magnitude = static_cast<unsigned __int128>(mantissa) << shift;
    const std::int64_t sign = bits >> 63 != 0 ? -1 : 1;
    word[0] += sign * static_cast<std::int64_t>(static_cast<std::uint32_t>(magnitude));
    word[1] += sign * static_cast<std::int64_t>(static_cast<std::uint32_t>(magnitude >> 32));
    word[2] += sign * static_cast<std::int64_t>(static_cast<std::uint32_t>(magnitude >> 64));
  }

  void clear() { words_.fill(0); }
  std::span<std::int64_t, word_count> words() { return words_; }

  /// The sum, rounded once (to nearest, ties to even), so that it scales with every power of two; not a number if any addend was not finite.
  double value() const {
    if (words_[digit_count] != 0) return std::numeric_limits<double>::quiet_NaN();
    const auto [bottom, last] = digits_in_use();
    auto digits = words_;
    const bool negative = carry(digits, bottom, last) < 0;
    if (negative) {
      for (int i = bottom; i <= last; ++i) digits[i] = -digits[i];
      carry(digits, bottom, last);
    }
    int top = last;
    while (top > bottom && digits[top] == 0) --top;
    // Three digits hold at least 65 bits from the first that is set; what lies below only tells how a tie is rounded.
    unsigned __int128 leading = 0;
    for (int i = top; i > top - 3; --i) leading = leading << 32 | static_cast<std::uint64_t>(i >= 0 ? digits[i] : 0);
    for (int i = top - 3; i >= bottom; --i)
      if (digits[i] != 0) leading |= 1U;
    const double sum = std::ldexp(static_cast<double>(leading), 32 * (top - 2) - bias);
    return negative ? -sum : sum;
  }

 private:
  struct Range {
    int first, last;
  };
  /// Found by eights: most of them are empty. The last digit is left for carries.
  Range digits_in_use() const {
    constexpr int at_once = 8;
    const auto is_empty = [&](int first) {
      std::int64_t bits = 0;
      for (int i = first; i < first + at_once; ++i) bits |= words_[i];
      return bits == 0;
    };
    constexpr int last_eight = digit_count - at_once;
    int first = 0, last = last_eight;
    while (first < last_eight && is_empty(first)) first = std::min(first + at_once, last_eight);
    while (last > first && is_empty(last)) last = std::max(last - at_once, first);
    return {first, std::min(last + at_once, digit_count - 1)};
  }

  /// Brings every digit but the last into [0, 2^32). @return the last, which has the sign of the sum.
  static std::int64_t carry(std::array<std::int64_t, word_count>& digits, int first, int last) {
    for (int i = first; i < last; ++i) {
      const std::int64_t excess = digits[i] >> 32;
      digits[i] -= excess * (std::int64_t{1} << 32);
      digits[i + 1] += excess;
    }
    return digits[last];
  }

  static constexpr int bias = 1152;  // a multiple of 32 beyond the lowest bit of a subnormal double
  std::array<std::int64_t, word_count> words_{};
};

}  // namespace balocco
