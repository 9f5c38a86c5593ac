// The loads of a step being written.
#include "deck/body_loads.hpp"
#include "deck/steady_state.hpp"
#include "deck/surface_loads.hpp"
#include "deck/writer.hpp"

namespace balocco::deck {

void Writer::loads(const Step& step) {
  // Of a static perturbation what comes on top of the state's loads.
  const bool on_top = std::holds_alternative<StaticPerturbationProcedure>(step.procedure);
  const auto is_said = [&](const auto& load) { return !on_top || load.magnitude != load.previous; };
  const auto said = [&](const auto& load) { return on_top ? load.magnitude - load.previous : load.magnitude; };
  std::string header;
  const auto head = [&](const std::string& keyword, std::int32_t amplitude) {
    const std::string wanted = keyword + amplitude_parameter(amplitude);
    if (wanted != header) line("{}", wanted);
    header = wanted;
  };
  for (const auto& load : step.concentrated_loads) {
    if (!is_said(load)) continue;
    head(fmt::format("*CLOAD{}{}", load.follower ? ", FOLLOWER" : "", part_parameter(load.imaginary)), load.amplitude);
    line("{}, {}, {}", node_id(load.node), load.dof + 1, said(load));
  }
  for (const auto& temperature : step.temperatures) {
    head("*TEMPERATURE", temperature.amplitude);
    line("{}, {}", node_id(temperature.node), temperature.magnitude);
  }
  for (auto load : step.surface_loads) {
    if (!is_said(load)) continue;
    head(fmt::format("*DSLOAD{}", surface_load_parameters(load)), load.amplitude);
    load.magnitude = said(load);
    line("{}, {}", quoted(model_.surfaces[load.surface].name), surface_load_text(load));
  }
  for (auto load : step.body_loads) {
    if (!is_said(load)) continue;
    head(fmt::format("*DLOAD{}", part_parameter(load.imaginary)), load.amplitude);
    load.magnitude = said(load);
    line("{}, {}", load.element_set < 0 ? "" : quoted(model_.element_sets[load.element_set].name), body_load_text(load));
  }
}

}  // namespace balocco::deck
