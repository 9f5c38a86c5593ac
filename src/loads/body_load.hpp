// Forces on all matter of an element set (BodyLoad). The force on a node depends on its own place alone.
#pragma once

#include "math/tensor.hpp"
#include "model/model.hpp"

namespace balocco {

/// Whether a load acts on mass, or on reference volume.
bool acts_on_mass(const BodyLoad& load);

/// Whether it acts on an element.
bool acts_on(const Model& model, const BodyLoad& load, ElementRef element);

/// Force on a node of share `share` (of mass, or of reference volume) at `position`. Centrifugal: m omega^2 (x - (x . a) a), x from
/// the axis' point, a the axis.
Vector3<double> body_force(const BodyLoad& load, double magnitude, double share, const double* position);

/// Its derivative by the position: m omega^2 (1 - a a^T) where the load is centrifugal, else zero.
Matrix3<double> body_force_derivative(const BodyLoad& load, double magnitude, double share);

}  // namespace balocco
