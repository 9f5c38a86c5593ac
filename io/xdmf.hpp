// The XDMF description that lets ParaView, VisIt and meshio read the results.
#pragma once

#include <string>

#include "results_index.hpp"

namespace balocco {

/// XDMF 3 text over `results_name` (a file name beside the description): a time series whose every frame is a collection of one
/// block for each element type that has a shape. One dataset for each item, no hyperslabs. Harmonic responses are left out.
std::string xdmf_text(const ResultsIndex& index, const std::string& results_name);
/// The same of the modes, with their number for the time.
std::string modes_xdmf_text(const ResultsIndex& index, const std::string& results_name);

/// The same of the harmonic response of a step (counted from 0), with the frequency for the time.
std::string harmonic_xdmf_text(const ResultsIndex& index, std::int32_t step, const std::string& results_name);

/// Writes a text file beside `path` and renames it. @throws SystemError.
void replace_file(const std::string& path, const std::string& text);

}  // namespace balocco
