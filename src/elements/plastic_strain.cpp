#include "elements/plastic_strain.hpp"

#include <cmath>

namespace balocco {

std::array<double, 6> plastic_strain(const std::array<double, 6>& logarithmic, const std::array<double, 6>& cauchy, double young,
                                     double poisson) {
  const double jacobian = std::exp(logarithmic[0] + logarithmic[1] + logarithmic[2]);
  const double trace = cauchy[0] + cauchy[1] + cauchy[2];
  std::array<double, 6> plastic;
  for (int a = 0; a < 3; ++a)
    plastic[a] = logarithmic[a] - jacobian * ((1.0 + poisson) * cauchy[a] - poisson * trace) / young;
  for (int a = 3; a < 6; ++a) plastic[a] = logarithmic[a] - jacobian * 2.0 * (1.0 + poisson) * cauchy[a] / young;
  return plastic;
}

}  // namespace balocco
