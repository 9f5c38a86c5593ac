#include "elements/solids/full_solid_static.hpp"
#include "elements/solids/nodal_shapes.hpp"

namespace balocco {

template bool FullSolid<SerendipityShape<2>>::linearize(std::int32_t, const NodalMotion&, std::span<const double>,
                                                        std::span<double>, std::span<double>, std::span<double>) const;
template ElementEnergies FullSolid<SerendipityShape<2>>::energies(std::int32_t, const NodalMotion&, std::span<const double>) const;
template bool FullSolid<SerendipityShape<3>>::linearize(std::int32_t, const NodalMotion&, std::span<const double>,
                                                        std::span<double>, std::span<double>, std::span<double>) const;
template ElementEnergies FullSolid<SerendipityShape<3>>::energies(std::int32_t, const NodalMotion&, std::span<const double>) const;

}  // namespace balocco
