#include "consistent_loads.hpp"

#include "elements/consistent_mass.hpp"
#include "loads/body_load.hpp"

namespace balocco {

bool loads_are_consistent(const Analysis& analysis) {
  const auto& steps = analysis.model.steps;
  const auto step = static_cast<std::size_t>(analysis.current.step);
  return step >= steps.size() || !std::holds_alternative<ExplicitProcedure>(steps[step].procedure);
}

void add_centrifugal_coupling(const Analysis& analysis, const BodyLoad& load, double magnitude, const double* position,
                              double* force) {
  const auto& model = analysis.model;
  for (const auto& group : analysis.element_groups) {
    ConsistentMass mass(model, *group);
    if (!mass.exists()) continue;
    const auto count = static_cast<std::size_t>(group->nodes_per_element());
    std::vector<Vector3<double>> acceleration(count);
    for (std::int32_t element = 0; element < group->size(); ++element) {
      if (!acts_on(model, load, {group->table(), group->row(element)})) continue;
      const auto nodes = group->nodes(element);
      for (std::size_t i = 0; i < count; ++i)
        acceleration[i] =
            body_force(load, magnitude, group->density(), position + 4 * static_cast<std::ptrdiff_t>(nodes[i]));
      const auto products = mass.products(element);
      for (std::size_t i = 0; i < count; ++i) {
        double* const sum = force + 4 * static_cast<std::ptrdiff_t>(nodes[i]);
        for (std::size_t j = 0; j < count; ++j) {
          const auto addend = products[count * i + j] * (acceleration[j] - acceleration[i]);
          for (int k = 0; k < 3; ++k) sum[k] += rounded(addend[k], sum[3]);
        }
      }
    }
  }
}

}  // namespace balocco
