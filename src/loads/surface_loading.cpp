#include "loads/surface_loading.hpp"

#include "loads/pressure_faces.hpp"
#include "loads/tractions.hpp"

namespace balocco {

std::unique_ptr<SurfaceLoading> make_surface_loading(const Model& model, const SurfaceLoad& load, std::span<const std::int32_t> local_node,
                                                     const std::vector<std::vector<bool>>& element_is_local, std::int32_t scratch_node) {
  if (load.kind == SurfaceLoad::Kind::pressure)
    return std::make_unique<PressureFaces>(model, model.surfaces[load.surface], local_node, element_is_local, scratch_node);
  return std::make_unique<Tractions>(model, load, local_node, element_is_local);
}

}  // namespace balocco
