#include "deck/diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace balocco::deck {

namespace {

// A deck with a fault on every line must not fill the memory with messages nobody will see.
constexpr std::size_t kept = 1000;

}  // namespace

void Diagnostics::error(Location location, std::string_view keyword, std::string text) {
  if (errors_.size() < kept) errors_.push_back({location, std::string(keyword), std::move(text)});
}

void Diagnostics::warning(Location location, std::string_view keyword, std::string text) {
  if (warnings_.size() < kept) warnings_.push_back({location, std::string(keyword), std::move(text)});
}

std::vector<std::string> Diagnostics::errors(const std::vector<std::string>& files) const {
  auto messages = format(errors_, "error", files);
  if (messages.size() > greatest_number_of_errors) messages.resize(greatest_number_of_errors);
  return messages;
}

std::vector<std::string> Diagnostics::warnings(const std::vector<std::string>& files) const {
  return format(warnings_, "warning", files);
}

std::vector<std::string> Diagnostics::format(std::vector<Message> messages, const char* severity,
                                             const std::vector<std::string>& files) {
  std::stable_sort(messages.begin(), messages.end(), [](const Message& a, const Message& b) {
    return std::pair(a.location.file, a.location.line) < std::pair(b.location.file, b.location.line);
  });
  std::vector<std::string> result;
  for (const auto& [location, keyword, text] : messages) {
    const std::string place =
        location.file < 0 ? files.at(0) : fmt::format("{}:{}", files.at(location.file), location.line);
    const std::string subject = keyword.empty() ? "" : "*" + keyword + ": ";
    std::string line = fmt::format("{}: {}: {}{}", place, severity, subject, text);
    if (std::find(result.begin(), result.end(), line) == result.end()) result.push_back(std::move(line));
  }
  return result;
}

}  // namespace balocco::deck
