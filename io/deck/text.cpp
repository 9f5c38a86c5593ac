#include "deck/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace balocco::deck {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

char to_upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

/// Letters to change, add, leave out or swap with their neighbour to turn one word into the other.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, last, row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = std::exchange(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1), last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string digits_of(std::string_view word) {
  std::string digits;
  std::copy_if(word.begin(), word.end(), std::back_inserter(digits), [](char c) { return c >= '0' && c <= '9'; });
  return digits;
}

}  // namespace

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = to_upper(c);
  return result;
}

std::string squeeze(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (const char c : text) {
    if (!is_blank(c)) result.push_back(to_upper(c));
  }
  return result;
}

std::string clean_name(std::string_view text) {
  std::string result = upper(trim(text));
  std::erase(result, '"');
  return result;
}

std::optional<double> parse_real(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  if (text.empty() || text.front() == '+') return std::nullopt;
  double value = 0.0;
  const auto whole = [&value](std::string_view part) {
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    return error == std::errc{} && end == part.data() + part.size() && std::isfinite(value);
  };
  if (whole(text)) return value;
  char buffer[64];
  if (text.size() >= sizeof buffer) return std::nullopt;
  std::transform(text.begin(), text.end(), buffer, [](char c) { return c == 'd' || c == 'D' ? 'e' : c; });
  if (!whole({buffer, text.size()})) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc{} && end == text.data() + text.size()) return value;
  // Generators write whole numbers as 12. or 12.0, and *PARAMETER values are real.
  const auto real = parse_real(text);
  if (!real || std::abs(*real) > 9e15 || *real != std::floor(*real)) return std::nullopt;
  return static_cast<std::int64_t>(*real);
}

void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  std::size_t start = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] == ',' && !quoted) {
      fields.push_back(trim(line.substr(start, i - start)));
      start = i + 1;
    }
  }
  const auto last = trim(line.substr(start));
  if (!last.empty()) fields.push_back(last);
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string squeezed = squeeze(word);
  std::string best;
  // One slip in a word of five letters, two in a long one: beyond that another word is meant, and no guess is better than a wrong one.
  std::size_t best_distance = (squeezed.size() < 5 ? 0 : squeezed.size() < 9 ? 1 : 2) + 1;
  for (const auto& candidate : candidates) {
    const std::string other = squeeze(candidate);
    const std::size_t distance = edit_distance(squeezed, other);
    if (digits_of(squeezed) != digits_of(other)) continue;  // C3D4 is not C3D6
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string candidate = nearest(word, candidates);
  return candidate.empty() ? "" : "; did you mean " + candidate + "?";
}

std::string join(const std::vector<std::string>& words) {
  std::string result;
  for (const auto& word : words) result += (result.empty() ? "" : ", ") + word;
  return result;
}

}  // namespace balocco::deck
