#include "builders/car/deck_text.hpp"

namespace balocco::car {

void DeckText::numbers(const std::vector<std::int64_t>& all) {
  constexpr std::size_t per_line = 12;
  for (std::size_t i = 0; i < all.size(); ++i) {
    text_ += std::to_string(all[i]);
    text_ += i + 1 == all.size() || (i + 1) % per_line == 0 ? "\n" : ", ";
  }
}

}  // namespace balocco::car
