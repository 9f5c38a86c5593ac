#include "loads/body_load.hpp"

#include <algorithm>

namespace balocco {

bool acts_on_mass(const BodyLoad& load) { return load.kind != BodyLoad::Kind::volume_force; }

bool acts_on(const Model& model, const BodyLoad& load, ElementRef element) {
  if (load.element_set < 0) return true;
  const auto& elements = model.element_sets[load.element_set].elements;
  return std::binary_search(elements.begin(), elements.end(), element);
}

Vector3<double> body_force(const BodyLoad& load, double magnitude, double share, const double* position) {
  const double factor = magnitude * share;
  const auto& direction = load.direction;
  if (load.kind != BodyLoad::Kind::centrifugal)
    return {{factor * direction[0], factor * direction[1], factor * direction[2]}};
  Vector3<double> arm{};
  double along = 0.0;
  for (int i = 0; i < 3; ++i) {
    arm[i] = position[i] - load.point[i];
    along += arm[i] * direction[i];
  }
  for (int i = 0; i < 3; ++i) arm[i] = factor * (arm[i] - along * direction[i]);
  return arm;
}

Matrix3<double> body_force_derivative(const BodyLoad& load, double magnitude, double share) {
  Matrix3<double> derivative{};
  if (load.kind != BodyLoad::Kind::centrifugal) return derivative;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      derivative(i, j) = magnitude * share * ((i == j ? 1.0 : 0.0) - load.direction[i] * load.direction[j]);
  return derivative;
}

}  // namespace balocco
