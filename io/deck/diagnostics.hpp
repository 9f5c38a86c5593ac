// Collects what is wrong with a deck, with its place, until everything that can be found has been found.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/model.hpp"

namespace balocco::deck {

class Diagnostics {
 public:
  static constexpr std::size_t greatest_number_of_errors = 20;

  /// `keyword` without asterisk, or empty.
  void error(Location location, std::string_view keyword, std::string text);
  void warning(Location location, std::string_view keyword, std::string text);

  std::size_t number_of_errors() const { return errors_.size(); }
  /// Whole messages sorted by file and line, the first greatest_number_of_errors of them.
  std::vector<std::string> errors(const std::vector<std::string>& files) const;
  std::vector<std::string> warnings(const std::vector<std::string>& files) const;

 private:
  struct Message {
    Location location;
    std::string keyword, text;
  };
  static std::vector<std::string> format(std::vector<Message> messages, const char* severity,
                                         const std::vector<std::string>& files);
  std::vector<Message> errors_, warnings_;
};

}  // namespace balocco::deck
