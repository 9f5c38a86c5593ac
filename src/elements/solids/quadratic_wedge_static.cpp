#include "elements/solids/full_solid_static.hpp"
#include "elements/solids/nodal_shapes.hpp"

namespace balocco {

template bool FullSolid<QuadraticWedgeShape>::linearize(std::int32_t, const NodalMotion&, std::span<const double>,
                                                        std::span<double>, std::span<double>, std::span<double>) const;
template ElementEnergies FullSolid<QuadraticWedgeShape>::energies(std::int32_t, const NodalMotion&, std::span<const double>) const;

}  // namespace balocco
