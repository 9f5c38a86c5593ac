// How builders see files: by their text, which whoever calls them loads.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace balocco {

/// Text of a file, if there is one.
using FileText = std::function<std::optional<std::string>(const std::string& path)>;

/// The path of a file that the description `file_name` names from its own folder.
std::string beside(const std::string& file_name, const std::string& path);

}  // namespace balocco
