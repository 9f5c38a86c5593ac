#include "nastran/bulk_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "deck/text.hpp"

namespace balocco::nastran {

namespace {

using deck::trim;
using deck::upper;

constexpr std::size_t small_width = 8, line_width = 80;

/// One line taken apart.
struct Fields {
  std::string first;
  std::vector<std::string> data;
  std::string label;  // of the continuation that follows
};

std::string without_marks(std::string_view text) {
  while (!text.empty() && (text.front() == '+' || text.front() == '*')) text.remove_prefix(1);
  return upper(trim(text));
}

bool is_label(std::string_view field) {
  const bool marked = !field.empty() && (field.front() == '+' || field.front() == '*');
  return marked && !parse_bulk_real(field);
}

Fields split_at_commas(std::string_view line) {
  std::vector<std::string> all;
  for (std::size_t start = 0; start <= line.size();) {
    const auto end = std::min(line.find(',', start), line.size());
    all.push_back(upper(trim(line.substr(start, end - start))));
    start = end + 1;
  }
  Fields fields{.first = all[0], .data = {all.begin() + 1, all.end()}, .label = {}};
  const std::size_t most = all[0].find('*') == std::string::npos ? 8 : 4;
  if (!fields.data.empty() && (fields.data.size() > most || is_label(fields.data.back()))) {
    fields.label = without_marks(fields.data.back());
    fields.data.pop_back();
  }
  fields.data.resize(most);
  return fields;
}

std::string tabs_to_columns(std::string_view line) {
  std::string columns;
  for (const char c : line) {
    if (c == '\t')
      columns.resize((columns.size() / small_width + 1) * small_width, ' ');
    else if (c != '\r')
      columns += c;
  }
  columns.resize(std::max(columns.size(), line_width), ' ');
  return columns;
}

Fields split_at_columns(std::string_view line) {
  const auto columns = tabs_to_columns(line);
  const auto field = [&](std::size_t start, std::size_t width) {
    return upper(trim(std::string_view(columns).substr(start, width)));
  };
  Fields fields{.first = field(0, small_width), .data = {}, .label = without_marks(field(line_width - small_width, small_width))};
  const std::size_t width = fields.first.find('*') == std::string::npos ? small_width : 2 * small_width;
  for (std::size_t start = small_width; start < line_width - small_width; start += width)
    fields.data.push_back(field(start, width));
  return fields;
}

/// Takes `$HMNAME PROP  3"rim"` and `$HMNAME MAT  1"steel"` into account.
void read_name(std::string_view comment, CardNames& names) {
  constexpr std::string_view mark = "$HMNAME ";
  if (!comment.starts_with(mark)) return;
  const auto quote = comment.find('"'), end = comment.find('"', quote + 1);
  if (end == std::string_view::npos) return;
  const auto head = trim(comment.substr(mark.size(), quote - mark.size()));
  const auto gap = head.find(' ');
  if (gap == std::string_view::npos) return;
  const auto number = deck::parse_integer(trim(head.substr(gap)));
  if (number) names[{upper(head.substr(0, gap)), *number}] = upper(comment.substr(quote + 1, end - quote - 1));
}

class CardReader {
 public:
  explicit CardReader(deck::Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void read(std::string_view text, bool bulk) {
    bulk_ = bulk;
    std::int32_t number = 0;
    for (std::size_t start = 0; start < text.size() && !ended_;) {
      const auto end = std::min(text.find('\n', start), text.size());
      line(text.substr(start, end - start), ++number);
      start = end + 1;
    }
    if (!bulk_) fault(1, "the text has executive control but no BEGIN BULK, so nothing is a mesh; add that line before the mesh");
  }

  BulkData data;

 private:
  void fault(std::int32_t line, const std::string& text) { diagnostics_.error({0, line}, "", text); }

  void line(std::string_view text, std::int32_t number) {
    if (text.starts_with('$')) return read_name(text, data.names);
    text = text.substr(0, text.find('$'));
    const auto words = upper(trim(text));
    if (words.empty()) return;
    if (words.starts_with("BEGIN") && words.find("BULK") != std::string::npos) {
      bulk_ = true;
    } else if (words.starts_with("ENDDATA")) {
      ended_ = true;
    } else if (bulk_) {
      card(text.find(',') == std::string_view::npos ? split_at_columns(text) : split_at_commas(text), number);
    }
  }

  void card(const Fields& fields, std::int32_t number) {
    const auto& first = fields.first;
    if (first.starts_with("INCLUDE")) return fault(number, "INCLUDE is not followed; put all files into one");
    if (first.starts_with('=')) return fault(number, "replicated fields (=) are not read; write the card out");
    if (first.empty() || first[0] == '+' || first[0] == '*') return go_on(fields, number);
    data.cards.push_back(
        {.name = std::string(trim(std::string_view(first).substr(0, first.find('*')))), .fields = fields.data, .line = number});
    label_ = fields.label;
  }

  void go_on(const Fields& fields, std::int32_t number) {
    if (data.cards.empty()) return fault(number, "a continuation without a card before it; remove the line or add the card");
    const auto own = without_marks(fields.first);
    if (!own.empty() && !label_.empty() && own != label_)
      return fault(number,
                   fmt::format("the continuation +{} follows a line that asks for +{}; bring the lines into order", own, label_));
    auto& all = data.cards.back().fields;
    all.insert(all.end(), fields.data.begin(), fields.data.end());
    label_ = fields.label;
  }

  deck::Diagnostics& diagnostics_;
  std::string label_;
  bool bulk_ = false, ended_ = false;
};

bool has_executive_control(std::string_view text) {
  const auto lines = fmt::format("\n{}", upper(text));
  return std::ranges::any_of(std::array{"\nCEND", "\nSOL ", "\nBEGIN"},
                             [&](const char* word) { return lines.find(word) != std::string::npos; });
}

}  // namespace

std::optional<double> parse_bulk_real(std::string_view text) {
  const auto sign = text.find_last_of("+-");
  const bool bare_exponent = sign != std::string_view::npos && sign > 0 &&
                             (std::isdigit(static_cast<unsigned char>(text[sign - 1])) || text[sign - 1] == '.');
  return bare_exponent ? deck::parse_real(std::string(text.substr(0, sign)) + "E" + std::string(text.substr(sign)))
                       : deck::parse_real(text);
}

BulkData read_bulk_data(std::string_view text, deck::Diagnostics& diagnostics) {
  CardReader reader(diagnostics);
  reader.read(text, !has_executive_control(text));
  return std::move(reader.data);
}

bool CardFields::set(std::size_t place) const {
  return !blank(place) && parse_bulk_real(card_.fields[place - 1]) != 0.0;
}

std::int64_t CardFields::integer(std::size_t place, const char* what, std::optional<std::int64_t> fallback) {
  if (blank(place)) {
    if (!fallback) fault(fmt::format("{} is missing; give it", what));
    return fallback.value_or(0);
  }
  const auto value = deck::parse_integer(card_.fields[place - 1]);
  if (!value) fault(fmt::format("{} is '{}'; write a whole number", what, card_.fields[place - 1]));
  return value.value_or(0);
}

double CardFields::real(std::size_t place, const char* what, std::optional<double> fallback) {
  if (blank(place)) {
    if (!fallback) fault(fmt::format("{} is missing; give it", what));
    return fallback.value_or(0.0);
  }
  const auto value = parse_bulk_real(card_.fields[place - 1]);
  if (!value) fault(fmt::format("{} is '{}'; write a number", what, card_.fields[place - 1]));
  return value.value_or(0.0);
}

Point CardFields::point(std::size_t place, const char* what) {
  return {real(place, what, 0.0), real(place + 1, what, 0.0), real(place + 2, what, 0.0)};
}

void CardFields::fault(const std::string& what_and_cure) {
  const auto number = card_.fields.empty() ? std::string() : " " + card_.fields[0];
  diagnostics_.error(location(), "", fmt::format("{}{}: {}", card_.name, number, what_and_cure));
}

}  // namespace balocco::nastran
