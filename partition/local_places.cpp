#include "local_places.hpp"

#include "elements/slave_places.hpp"

namespace balocco {

std::vector<LocalPlace> local_slave_places(const Model& model, std::int32_t pair, const Domain& domain) {
  const auto homes = homes_of_places(model, model.contact_pairs[pair]);
  std::vector<LocalPlace> places;
  for (std::size_t row = 0; row < homes.size(); ++row)
    if (const auto node = domain.local_node[homes[row]]; node >= 0) places.push_back({static_cast<std::int64_t>(row), node});
  return places;
}

}  // namespace balocco
