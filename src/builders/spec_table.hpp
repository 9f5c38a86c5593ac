// Reading a TOML description, alone or based on another: typed values with bounds and units, unknown keys refused, every fault
// collected and told where its value stands.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <toml.hpp>
#include <vector>

#include "builders/file_text.hpp"

namespace balocco {

/// Faults of one description, each a whole message "FILE:LINE: error: [table] key: what; cure".
class SpecFaults {
 public:
  explicit SpecFaults(std::string file_name) : file_name_(std::move(file_name)) {}
  /// `where`: "FILE:LINE".
  void add(const std::string& where, std::string_view table, std::string_view key, std::string_view what_and_cure);
  bool empty() const { return messages_.empty(); }
  const std::string& file_name() const { return file_name_; }
  /// @throws InputError if anything was added.
  void throw_if_any() const;

 private:
  std::string file_name_;
  std::vector<std::string> messages_;
};

/// What a number may be, and its unit for messages.
struct Bounds {
  double lower = -1e300, upper = 1e300;
  bool lower_excluded = false;
  std::string_view unit;

  static Bounds positive(std::string_view unit) { return {0.0, 1e300, true, unit}; }
  static Bounds not_negative(std::string_view unit) { return {0.0, 1e300, false, unit}; }
  static Bounds between(double lower, double upper, std::string_view unit) { return {lower, upper, false, unit}; }
  static Bounds any(std::string_view unit) { return {-1e300, 1e300, false, unit}; }
};

/// One table of a description. A value that is missing or bad is reported and replaced by 0, empty or the lower bound,
/// so that reading goes on to the next fault; nothing may be built from it afterwards.
class SpecTable {
 public:
  /// `value` must outlive the table. `name` as in the file, "" for the top.
  SpecTable(const toml::value* value, std::string name, SpecFaults& faults);

  const std::string& name() const { return name_; }
  bool has(std::string_view key) const;
  double number(std::string_view key, const Bounds& bounds, std::optional<double> fallback = {});
  int integer(std::string_view key, int lower, int upper, std::optional<int> fallback = {});
  bool boolean(std::string_view key, std::optional<bool> fallback = {});
  std::string text(std::string_view key, const std::vector<std::string>& choices,
                   std::optional<std::string> fallback = {});
  /// A file that the description names, from the folder of the description in which it stands.
  std::string path(std::string_view key);
  std::vector<std::string> texts(std::string_view key);
  /// Rows of numbers; each row has `least` to `most` of them.
  std::vector<std::vector<double>> rows(std::string_view key, std::size_t least, std::size_t most);
  SpecTable table(std::string_view key);
  /// Names of the sub-tables, sorted.
  std::vector<std::string> table_names();
  void fault(std::string_view key, std::string_view what_and_cure);
  /// "FILE:LINE" where the key stands, or the table if it does not.
  std::string where(std::string_view key) const;
  /// Reports every key that nothing asked for. Call after the last value was read.
  void refuse_unknown();

 private:
  const toml::value* find(std::string_view key, bool required);

  const toml::value* value_;  // null: the table is missing, which has been reported
  std::string name_;
  SpecFaults* faults_;
  std::vector<std::string> asked_;
};

/// The candidate nearest to `word` in edits (Levenshtein), or "" when none is nearer than half its length.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

/// Parses a description. Where it says `base = "OTHER.toml"` it takes everything from there, by `load`, but for what it says itself:
/// tables key by key, arrays whole. @throws InputError "FILE:LINE: error: ..." on a syntax error, a base that is not there or a chain
/// that closes.
toml::value parse_spec(const std::string& text, const std::string& file_name, const FileText& load);

}  // namespace balocco
