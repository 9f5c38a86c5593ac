#include "builders/car/deck_text.hpp"

#include "model/diagnostics.hpp"

namespace balocco::car {

void DeckText::numbers(const std::vector<std::int64_t>& all) {
  constexpr std::size_t per_line = 12;
  for (std::size_t i = 0; i < all.size(); ++i) {
    text_ += std::to_string(all[i]);
    text_ += i + 1 == all.size() || (i + 1) % per_line == 0 ? "\n" : ", ";
  }
}

std::int64_t DeckText::named_node(const std::string& name, const Vector& place) {
  const auto id = next_node();
  line("*NODE, NSET={}", name);
  node(id, place);
  named_[name] = {id, place};
  return id;
}

const DeckText::Named& DeckText::find(const std::string& name) const {
  const auto found = named_.find(name);
  if (found == named_.end())
    throw InputError(fmt::format("the car's description has no [mount] {}, which its suspension needs; add it", name));
  return found->second;
}

std::int64_t DeckText::node_of(const std::string& name) const {
  return find(name).id;
}

const Vector& DeckText::place_of(const std::string& name) const {
  return find(name).place;
}

}  // namespace balocco::car
