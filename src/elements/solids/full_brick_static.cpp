#include "elements/solids/full_solid_static.hpp"

namespace balocco {

template bool FullSolid<HexahedronShape>::linearize(std::int32_t, const NodalMotion&, std::span<const double>,
                                                    std::span<double>, std::span<double>, std::span<double>) const;
template ElementEnergies FullSolid<HexahedronShape>::energies(std::int32_t, const NodalMotion&,
                                                              std::span<const double>) const;
template bool FullSolid<PlainHexahedronShape>::linearize(std::int32_t, const NodalMotion&, std::span<const double>,
                                                    std::span<double>, std::span<double>, std::span<double>) const;
template ElementEnergies FullSolid<PlainHexahedronShape>::energies(std::int32_t, const NodalMotion&,
                                                              std::span<const double>) const;

}  // namespace balocco
