// Where two results files part: for people who ask whether a change, a machine or a number of ranks changed the numbers.
#pragma once

#include <string>

namespace balocco {

struct ResultsDifference {
  bool same = false;
  std::string text;  // what was compared, the first place where the files part, and the largest difference of each variable
};

/// Compares the meshes, and of every step the frames and histories, all in the order of time. Two values agree if their bits do
/// (not-a-number agrees with itself), or with `relative` > 0 if they differ by no more than that part of the largest magnitude
/// that the variable has in the two frames (history: columns). How many ranks wrote a file does not matter.
/// @throws InputError if a file is no results file.
ResultsDifference compare_results(const std::string& path_a, const std::string& path_b, double relative);

}  // namespace balocco
