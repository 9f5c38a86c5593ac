#include "builders/spec_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <sstream>

#include "model/diagnostics.hpp"

namespace balocco {
namespace {

constexpr std::size_t most_messages = 20;

std::string bounds_in_words(const Bounds& bounds) {
  const auto unit = bounds.unit.empty() ? std::string() : fmt::format(" {}", bounds.unit);
  if (bounds.lower <= -1e300) return fmt::format("any number{}", unit.empty() ? "" : " in" + unit);
  if (bounds.upper >= 1e300)
    return fmt::format("a number {} {}{}", bounds.lower_excluded ? ">" : ">=", bounds.lower, unit);
  return fmt::format("a number from {} to {}{}", bounds.lower, bounds.upper, unit);
}

std::optional<double> as_number(const toml::value& value) {
  if (value.is_floating()) return value.as_floating();
  if (value.is_integer()) return static_cast<double>(value.as_integer());
  return std::nullopt;
}

std::string where_of(const toml::value& value) {
  const auto location = value.location();
  return fmt::format("{}:{}", location.file_name(), location.line());
}

toml::value parse_alone(const std::string& text, const std::string& file_name) {
  std::istringstream stream(text);
  try {
    return toml::parse(stream, file_name);
  } catch (const toml::exception& error) {
    // The library's message spans several lines; its first one says what is wrong.
    std::string what = error.what();
    if (const auto marker = what.find("[error] "); marker != std::string::npos) what.erase(0, marker + 8);
    what = what.substr(0, what.find('\n'));
    throw InputError(
        fmt::format("{}:{}: error: TOML syntax: {}; see https://toml.io", file_name, error.location().line(), what));
  }
}

/// Gives a table what it does not say itself.
void complete(toml::value& table, const toml::value& base) {
  auto& own = table.as_table();
  for (const auto& [key, value] : base.as_table()) {
    const auto [found, taken] = own.emplace(key, value);
    if (!taken && found->second.is_table() && value.is_table()) complete(found->second, value);
  }
}

/// `chain`: the files that are based on this one, which comes last.
toml::value parse_with_base(const std::string& text, const FileText& load, std::vector<std::string> chain) {
  const auto& file_name = chain.back();
  auto spec = parse_alone(text, file_name);
  const auto base = spec.as_table().find("base");
  if (base == spec.as_table().end()) return spec;
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}: error: base: {}", where_of(base->second), what));
  };
  if (!base->second.is_string()) fail("not a text; write the path of a description in quotes");
  const auto path = beside(file_name, base->second.as_string().str);
  if (std::ranges::find(chain, path) != chain.end())
    fail(fmt::format("{} is based on this file in turn; remove one base of the chain", path));
  const auto base_text = load(path);
  if (!base_text) fail(fmt::format("no file {}; give the path of a description from this file's folder", path));
  chain.push_back(path);
  const auto taken = parse_with_base(*base_text, load, std::move(chain));
  spec.as_table().erase(base);
  complete(spec, taken);
  return spec;
}

}  // namespace

void SpecFaults::add(const std::string& where, std::string_view table, std::string_view key, std::string_view what_and_cure) {
  if (messages_.size() >= most_messages) return;
  const auto place = table.empty() ? std::string(key)
                     : key.empty() ? fmt::format("[{}]", table)
                                   : fmt::format("[{}] {}", table, key);
  messages_.push_back(fmt::format("{}: error: {}: {}", where, place, what_and_cure));
}

void SpecFaults::throw_if_any() const {
  if (!messages_.empty()) throw InputError(messages_);
}

SpecTable::SpecTable(const toml::value* value, std::string name, SpecFaults& faults)
    : value_(value), name_(std::move(name)), faults_(&faults) {}

bool SpecTable::has(std::string_view key) const {
  return value_ != nullptr && value_->as_table().count(std::string(key)) > 0;
}

std::string SpecTable::where(std::string_view key) const {
  const auto top = faults_->file_name() + ":1";  // which has no header of its own
  if (value_ == nullptr) return top;
  const auto& table = value_->as_table();
  const auto found = table.find(std::string(key));
  if (found == table.end()) return name_.empty() ? top : where_of(*value_);
  return where_of(found->second);
}

void SpecTable::fault(std::string_view key, std::string_view what_and_cure) {
  faults_->add(where(key), name_, key, what_and_cure);
}

const toml::value* SpecTable::find(std::string_view key, bool required) {
  asked_.emplace_back(key);
  if (value_ == nullptr) return nullptr;
  const auto& table = value_->as_table();
  const auto found = table.find(std::string(key));
  if (found != table.end()) return &found->second;
  if (required) fault(key, "missing; add this key to the table");
  return nullptr;
}

double SpecTable::number(std::string_view key, const Bounds& bounds, std::optional<double> fallback) {
  const auto* value = find(key, !fallback);
  const double safe = bounds.lower > -1e300 ? bounds.lower : 0.0;
  if (value == nullptr) return fallback.value_or(safe);
  const auto number = as_number(*value);
  if (!number) {
    fault(key, fmt::format("not a number; write {}", bounds_in_words(bounds)));
    return safe;
  }
  const bool inside =
      *number >= bounds.lower && *number <= bounds.upper && !(bounds.lower_excluded && *number == bounds.lower);
  if (!inside) {
    fault(key, fmt::format("{} is out of range; write {}", *number, bounds_in_words(bounds)));
    return safe;
  }
  return *number;
}

int SpecTable::integer(std::string_view key, int lower, int upper, std::optional<int> fallback) {
  const auto* value = find(key, !fallback);
  if (value == nullptr) return fallback.value_or(lower);
  if (!value->is_integer() || value->as_integer() < lower || value->as_integer() > upper) {
    fault(key, fmt::format("write a whole number from {} to {}", lower, upper));
    return lower;
  }
  return static_cast<int>(value->as_integer());
}

bool SpecTable::boolean(std::string_view key, std::optional<bool> fallback) {
  const auto* value = find(key, !fallback);
  if (value == nullptr) return fallback.value_or(false);
  if (!value->is_boolean()) {
    fault(key, "write true or false");
    return false;
  }
  return value->as_boolean();
}

std::string SpecTable::text(std::string_view key, const std::vector<std::string>& choices,
                            std::optional<std::string> fallback) {
  const auto* value = find(key, !fallback);
  if (value == nullptr) return fallback.value_or("");
  if (!value->is_string()) {
    fault(key, "not a text; write it in quotes");
    return "";
  }
  const std::string word = value->as_string().str;
  if (choices.empty() || std::find(choices.begin(), choices.end(), word) != choices.end()) return word;
  const auto nearest = nearest_word(word, choices);
  fault(key, fmt::format("\"{}\" is not known; {}", word,
                         nearest.empty() ? fmt::format("choose from {}", fmt::join(choices, ", "))
                                         : fmt::format("did you mean \"{}\"?", nearest)));
  return "";
}

std::string SpecTable::path(std::string_view key) {
  const auto name = text(key, {});
  return name.empty() ? name : beside(value_->at(std::string(key)).location().file_name(), name);
}

std::vector<std::string> SpecTable::texts(std::string_view key) {
  std::vector<std::string> words;
  const auto* value = find(key, true);
  if (value == nullptr) return words;
  if (!value->is_array()) {
    fault(key, "write a list of names in quotes: [\"A\", \"B\"]");
    return words;
  }
  for (const auto& word : value->as_array()) {
    if (word.is_string())
      words.push_back(word.as_string().str);
    else
      fault(key, "not a text; write every name in quotes");
  }
  return words;
}

std::vector<std::vector<double>> SpecTable::rows(std::string_view key, std::size_t least, std::size_t most) {
  std::vector<std::vector<double>> rows;
  const auto* value = find(key, true);
  if (value == nullptr) return rows;
  if (!value->is_array()) {
    fault(key, "write rows of numbers: [[1.0, 2.0], [3.0, 4.0]]");
    return rows;
  }
  for (const auto& row : value->as_array()) {
    std::vector<double> numbers;
    if (row.is_array())
      for (const auto& entry : row.as_array())
        if (const auto number = as_number(entry)) numbers.push_back(*number);
    const bool whole =
        row.is_array() && numbers.size() == row.as_array().size() && numbers.size() >= least && numbers.size() <= most;
    if (!whole) {
      faults_->add(where_of(row), name_, key,
                   fmt::format("row {} needs {} to {} numbers; mend it", rows.size() + 1, least, most));
      numbers.assign(most, 0.0);
    }
    rows.push_back(std::move(numbers));
  }
  return rows;
}

SpecTable SpecTable::table(std::string_view key) {
  const auto* value = find(key, true);
  auto full_name = name_.empty() ? std::string(key) : fmt::format("{}.{}", name_, key);
  if (value != nullptr && !value->is_table()) {
    fault(key, fmt::format("not a table; write [{}] and its keys below", full_name));
    value = nullptr;
  }
  return {value, std::move(full_name), *faults_};
}

std::vector<std::string> SpecTable::table_names() {
  std::vector<std::string> names;
  if (value_ == nullptr) return names;
  for (const auto& [key, value] : value_->as_table())
    if (value.is_table()) names.push_back(key);
  std::sort(names.begin(), names.end());
  return names;
}

void SpecTable::refuse_unknown() {
  if (value_ == nullptr) return;
  for (const auto& [key, value] : value_->as_table()) {
    if (std::find(asked_.begin(), asked_.end(), key) != asked_.end()) continue;
    const auto nearest = nearest_word(key, asked_);
    fault(key, nearest.empty() ? fmt::format("unknown key; the keys here are {}", fmt::join(asked_, ", "))
                               : fmt::format("unknown key; did you mean \"{}\"?", nearest));
  }
}

std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates) {
  std::string nearest;
  std::size_t fewest = word.size() / 2 + 1;
  for (const auto& candidate : candidates) {
    std::vector<std::size_t> edits(candidate.size() + 1);
    std::iota(edits.begin(), edits.end(), std::size_t{0});
    for (std::size_t i = 0; i < word.size(); ++i) {
      std::size_t diagonal = edits[0];
      edits[0] = i + 1;
      for (std::size_t j = 0; j < candidate.size(); ++j) {
        const std::size_t replaced = diagonal + (word[i] == candidate[j] ? 0 : 1);
        diagonal = edits[j + 1];
        edits[j + 1] = std::min({replaced, diagonal + 1, edits[j] + 1});
      }
    }
    if (edits.back() < fewest) {
      fewest = edits.back();
      nearest = candidate;
    }
  }
  return nearest;
}

std::string beside(const std::string& file_name, const std::string& path) {
  return (std::filesystem::path(file_name).parent_path() / path).lexically_normal().string();
}

toml::value parse_spec(const std::string& text, const std::string& file_name, const FileText& load) {
  return parse_with_base(text, load, {std::filesystem::path(file_name).lexically_normal().string()});
}

}  // namespace balocco
