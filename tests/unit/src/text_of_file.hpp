// Descriptions as the builders' tests load them.
#pragma once

#include <fstream>
#include <optional>
#include <sstream>
#include <string>

namespace balocco::test {

/// Text of a file, if there is one.
inline std::optional<std::string> text_of_file(const std::string& path) {
  std::ifstream file(path);
  if (!file) return std::nullopt;
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace balocco::test
