// Nastran bulk data as cards: small fields of 8 columns, large ones of 16 and free ones between commas, with what their
// continuation lines add.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/diagnostics.hpp"

namespace balocco::nastran {

struct BulkCard {
  std::string name;                 // upper case, without the asterisk of large fields
  std::vector<std::string> fields;  // behind the name, without labels of continuations; blank: not given
  std::int32_t line = 0;
};

/// What the preprocessor calls a property or material, by the card's kind and number: a comment of its own to Nastran.
using CardNames = std::map<std::pair<std::string, std::int64_t>, std::string>;

struct BulkData {
  std::vector<BulkCard> cards;
  CardNames names;
};

/// The cards from BEGIN BULK, or from the first line where the text has no executive control, to ENDDATA. Faults go to
/// `diagnostics`, as lines of its first file.
BulkData read_bulk_data(std::string_view text, deck::Diagnostics& diagnostics);

/// A number as Nastran writes it: 1.5, .5, 1.5E-3, 1.5D-3, 1.5-3.
std::optional<double> parse_bulk_real(std::string_view text);

/// Reads the fields of one card by their place behind its name, counted from 1, and tells what is wrong with them.
class CardFields {
 public:
  CardFields(const BulkCard& card, deck::Diagnostics& diagnostics) : card_(card), diagnostics_(diagnostics) {}

  bool blank(std::size_t place) const { return place > card_.fields.size() || card_.fields[place - 1].empty(); }
  /// Whether the field holds something else than blank or zero.
  bool set(std::size_t place) const;
  /// `what` names the field in messages; without `fallback` a blank is a fault.
  std::int64_t integer(std::size_t place, const char* what, std::optional<std::int64_t> fallback = {});
  double real(std::size_t place, const char* what, std::optional<double> fallback = {});
  Point point(std::size_t place, const char* what);
  /// A fault of the card: "GRID 17: ...".
  void fault(const std::string& what_and_cure);
  Location location() const { return {0, card_.line}; }

 private:
  const BulkCard& card_;
  deck::Diagnostics& diagnostics_;
};

}  // namespace balocco::nastran
