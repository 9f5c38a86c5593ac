#include "deck/register.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "deck/text.hpp"

namespace balocco::deck {

namespace {

using ParameterKind = ParameterRule::Kind;

// Function-local so that registrations in other files find it whatever the order of initialisation.
std::map<std::string, KeywordRule, std::less<>>& table() {
  static std::map<std::string, KeywordRule, std::less<>> rules;
  return rules;
}

/// The one of `words` that `word` is or abbreviates with three letters or more, or "".
std::string written_out(std::string_view word, const std::vector<std::string>& words) {
  const std::string squeezed = squeeze(word);
  const auto begins = [&](const std::string& candidate) { return squeeze(candidate).starts_with(squeezed); };
  const auto same = [&](const std::string& candidate) { return squeeze(candidate) == squeezed; };
  const auto whole = std::find_if(words.begin(), words.end(), same);
  if (whole != words.end()) return *whole;
  if (squeezed.size() < 3 || std::count_if(words.begin(), words.end(), begins) != 1) return "";
  return *std::find_if(words.begin(), words.end(), begins);
}

/// What is wrong with a value, or "". A choice is written out.
std::string trouble_with_value(const ParameterRule& rule, Parameter& parameter) {
  if (rule.kind == ParameterKind::foreign) return "";
  const bool optional = rule.kind == ParameterKind::optional_real || rule.kind == ParameterKind::optional_choice;
  if (rule.kind == ParameterKind::flag) {
    return parameter.has_value ? fmt::format("{} takes no value; leave out '={}'", rule.name, parameter.raw) : "";
  }
  if (!parameter.has_value || parameter.value.empty()) {
    if (optional && !parameter.has_value) return "";
    return fmt::format("{} needs a value; write {}=...", rule.name, rule.name);
  }
  if ((rule.kind == ParameterKind::real || rule.kind == ParameterKind::optional_real) && !parse_real(parameter.value)) {
    return fmt::format("{}={} is not a number; write a real number", rule.name, parameter.raw);
  }
  if (rule.kind == ParameterKind::integer && !parse_integer(parameter.value)) {
    return fmt::format("{}={} is not a whole number; write an integer", rule.name, parameter.raw);
  }
  if (rule.kind == ParameterKind::choice || rule.kind == ParameterKind::optional_choice) {
    const std::string choice = written_out(parameter.value, rule.choices);
    if (choice.empty()) {
      return fmt::format("{}={} is not supported{}{}", rule.name, parameter.raw,
                         did_you_mean(parameter.value, rule.choices), "; allowed: " + join(rule.choices));
    }
    parameter.value = choice;
  }
  return "";
}

/// A line that a comma at the end of the one above made part of the keyword, though it begins with no parameter.
bool looks_like_data(const Parameter& parameter, const Block& block) {
  return parameter.line != block.location.line && !parameter.has_value;
}

}  // namespace

ParameterRule flag(std::string name) {
  return {ParameterKind::flag, std::move(name), {}, false};
}
ParameterRule name(std::string name) {
  return {ParameterKind::name, std::move(name), {}, false};
}
ParameterRule text(std::string name) {
  return {ParameterKind::text, std::move(name), {}, false};
}
ParameterRule real(std::string name) {
  return {ParameterKind::real, std::move(name), {}, false};
}
ParameterRule integer(std::string name) {
  return {ParameterKind::integer, std::move(name), {}, false};
}
ParameterRule choice(std::string name, std::vector<std::string> choices) {
  return {ParameterKind::choice, std::move(name), std::move(choices), false};
}
ParameterRule optional_real(std::string name) {
  return {ParameterKind::optional_real, std::move(name), {}, false};
}
ParameterRule optional_choice(std::string name, std::vector<std::string> choices) {
  return {ParameterKind::optional_choice, std::move(name), std::move(choices), false};
}
ParameterRule foreign(std::string name) {
  return {ParameterKind::foreign, std::move(name), {}, false};
}
ParameterRule required(ParameterRule rule) {
  rule.required = true;
  return rule;
}

RegisterKeyword::RegisterKeyword(KeywordRule rule) {
  const auto [place, fresh] = table().try_emplace(squeeze(rule.keyword), std::move(rule));
  if (!fresh) throw std::logic_error(fmt::format("*{} is registered twice", place->second.keyword));
}

const KeywordRule* find_keyword(std::string_view squeezed) {
  const auto found = table().find(squeezed);
  return found == table().end() ? nullptr : &found->second;
}

std::vector<std::string> keywords() {
  // These two are the business of the tokenizer and are not registered.
  std::vector<std::string> result{"INCLUDE", "PARAMETER"};
  for (const auto& [key, rule] : table()) result.push_back(rule.keyword);
  return result;
}

bool check_parameters(const KeywordRule& rule, Block& block, Diagnostics& diagnostics) {
  if (rule.any_parameter) return true;
  bool good = true;
  const auto tell = [&](std::string text) {
    diagnostics.error(block.location, rule.keyword, std::move(text));
    good = false;
  };
  std::vector<std::string> known;
  for (const auto& allowed : rule.parameters) known.push_back(allowed.name);
  for (auto& parameter : block.parameters) {
    const std::string whole = written_out(parameter.written, known);
    const auto allowed = std::find_if(rule.parameters.begin(), rule.parameters.end(),
                                      [&](const ParameterRule& r) { return r.name == whole; });
    if (allowed != rule.parameters.end()) parameter.name = squeeze(whole);
    if (allowed == rule.parameters.end() && looks_like_data(parameter, block)) {
      diagnostics.error({block.location.file, parameter.line}, rule.keyword,
                        fmt::format("a comma ends the line above, which makes this line, beginning with '{}', part of the "
                                    "keyword; remove the comma if it is a data line",
                                    parameter.written));
      return false;
    }
    if (allowed == rule.parameters.end()) {
      tell(fmt::format("parameter {} is unknown or not supported{}; {}", upper(parameter.written),
                       did_you_mean(parameter.written, known),
                       known.empty() ? "this keyword takes none" : "supported: " + join(known)));
    } else if (const auto trouble = trouble_with_value(*allowed, parameter); !trouble.empty()) {
      tell(trouble);
    } else if (allowed->kind == ParameterKind::foreign) {
      diagnostics.warning(block.location, rule.keyword,
                          fmt::format("parameter {} has no counterpart here and is left out", allowed->name));
    } else if (block.find(parameter.name) != &parameter) {
      tell(fmt::format("parameter {} is given twice; keep one", allowed->name));
    }
  }
  for (const auto& needed : rule.parameters) {
    if (needed.required && !block.has(needed.name)) {
      tell(fmt::format("parameter {0} is missing; add {0}{1}", needed.name, needed.kind == ParameterKind::flag ? "" : "=..."));
    }
  }
  return good;
}

}  // namespace balocco::deck
