// Where the time of an explicit step goes.
#pragma once

#include <array>
#include <chrono>

namespace balocco {

enum class Phase { loads, elements, halo, contact, bodies, increment, update, output };

class PhaseTimers {
 public:
  static constexpr std::size_t count = 8;
  static constexpr std::array<const char*, count> names{"loads",  "elements",  "halo",   "contact",
                                                        "bodies", "increment", "update", "output"};

  /// Runs `work` and books its time on `phase`.
  template <class Work>
  void measure(Phase phase, Work work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    seconds_[static_cast<std::size_t>(phase)] += passed.count();
  }

  double seconds(Phase phase) const { return seconds_[static_cast<std::size_t>(phase)]; }
  double total() const {
    double sum = 0.0;
    for (const double s : seconds_) sum += s;
    return sum;
  }

 private:
  std::array<double, count> seconds_{};
};

}  // namespace balocco
