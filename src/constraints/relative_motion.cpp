#include "constraints/relative_motion.hpp"

namespace balocco {

RelativeMotion::RelativeMotion(const RelativeMotionKind& kind, const Axes& axes, const Vector3<double>& arm)
    : kind_(kind), axes_(axes), length_(std::sqrt(dot(arm, arm))), at_start_(measure<double>(arm, axes)) {}

double RelativeMotion::position_at_start(int component) const { return at_start_[component]; }

}  // namespace balocco
