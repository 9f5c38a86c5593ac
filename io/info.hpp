// `balocco info JOB.h5`.
#pragma once

#include <string>

namespace balocco {

/// What a results file holds, to read: mesh, parts, sets, steps with their frames and variables, histories.
/// @throws InputError if the file is missing or not Balocco's.
std::string describe_results(const std::string& path);

}  // namespace balocco
