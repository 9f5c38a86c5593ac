// Consistent masses and loads of quadratic elements in implicit steps: lumped ones would bend them under their own
// weight. The C3D8 of pointwise dilatation has them, too.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "analysis.hpp"

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

/// True while the current step is an implicit one.
bool loads_are_consistent(const Analysis& analysis);

/// What a centrifugal load adds to sums of share * acceleration at each node, share being row_sums(): the force on a
/// node depends on where the others of its element are. `force`: 4 doubles a node, the fourth is the rounding constant.
void add_centrifugal_coupling(const Analysis& analysis, const BodyLoad& load, double magnitude, const double* position,
                              double* force);

}  // namespace balocco
