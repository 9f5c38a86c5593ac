#include "harmonic_results.hpp"

#include <utility>

namespace balocco {

namespace {

/// Of a variable that is told in total the one that is told relative to the base: U of TU; of others nothing.
std::string_view relative_variable(std::string_view variable) {
  return variable == "TU" || variable == "TV" || variable == "TA" ? variable.substr(1) : std::string_view{};
}

}  // namespace

HarmonicResults::HarmonicResults(Analysis& analysis, const std::vector<RigidBaseMotion>& base)
    : analysis_(analysis), base_(base), parts_{Part(*this, 0), Part(*this, 1)} {
  for (const int part : {0, 1}) take(part);
}

void HarmonicResults::take(int part) {
  put_away();
  states_[part] = analysis_.current;
  beside_[part] = outputs_of(analysis_);
}

const Analysis& HarmonicResults::show(int part) {
  if (part == shown_) return analysis_;
  if (shown_ != none) exchange(shown_);
  if (part != none) exchange(part);
  shown_ = part;
  return analysis_;
}

/// What a part shows with what the analysis does.
void HarmonicResults::exchange(int part) {
  std::swap(analysis_.current, states_[part]);
  ShownBeside beside = outputs_of(analysis_);
  outputs_of(analysis_) = std::exchange(beside_[part], std::move(beside));
}

void HarmonicResults::add_base_motion(std::string_view variable, int part, std::span<double> values) const {
  for (const auto& motion : base_) {
    const auto factor = variable == "TU" ? motion.value : variable == "TV" ? motion.velocity : motion.acceleration;
    const double size = part == 0 ? factor.real() : factor.imag();
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += size * motion.displacement[i];
  }
}

int HarmonicResults::Part::nodal_components(std::string_view variable) const {
  const auto relative = relative_variable(variable);
  return whole_.analysis_.nodal_components(relative.empty() ? variable : relative);
}

void HarmonicResults::Part::nodal(std::string_view variable, std::span<double> values) const {
  const auto relative = relative_variable(variable);
  whole_.show(number_).nodal(relative.empty() ? variable : relative, values);
  if (!relative.empty()) whole_.add_base_motion(variable, number_, values);
}

}  // namespace balocco
