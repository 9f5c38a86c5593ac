// Consistent masses of quadratic elements in implicit steps: lumped ones would bend them under their own weight. The C3D8 of pointwise
// dilatation has them, too.
#pragma once

#include <span>
#include <vector>

#include "elements/element_group.hpp"

namespace balocco {

class ConsistentMass {
 public:
  ConsistentMass(const Model& model, const ElementGroup& group);

  /// False where the type lumps in implicit steps too: then nothing below may be asked for.
  bool exists() const { return shape_products_ != nullptr; }
  /// Integrals of N_I N_J over the reference volume of an element, row-major; times group.density() a mass. Valid until
  /// the next call.
  std::span<const double> products(std::int32_t element);
  /// Their sums by row, the share of the volume that a uniform force by volume gives each node. Valid until the next
  /// call.
  std::span<const double> row_sums(std::int32_t element);

 private:
  const Model& model_;
  const ElementGroup& group_;
  void (*shape_products_)(std::span<const Point>, std::span<double>);
  std::vector<Point> nodes_;
  std::vector<double> products_, sums_;
};

}  // namespace balocco
