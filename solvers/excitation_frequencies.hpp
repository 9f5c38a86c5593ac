// The frequencies at which a steady-state step tells the response to harmonic loads.
#pragma once

#include <span>
#include <vector>

#include "model/step.hpp"

namespace balocco {

/// Cycles per time, rising, each once: of each range its ends, and between two neighbours of lower end, eigenfrequencies within (or of
/// INTERVAL=RANGE the ends alone) and upper end the points
///   f_k = (f_1 + f_2) / 2 + (f_2 - f_1) / 2 * |y_k|^(1/bias) * sign(y_k),   y_k = -1 + 2 (k - 1) / (n - 1),
/// of logarithms where these are asked for (Abaqus Analysis User's Guide 6.3.8, "Selecting the frequency spacing"). CalculiX has the same
/// points, of linear scale. `eigenfrequencies` in any order; those of a cluster that are alike within 1e-6 count once.
std::vector<double> excitation_frequencies(const SteadyStateProcedure& procedure, std::span<const double> eigenfrequencies);

}  // namespace balocco
