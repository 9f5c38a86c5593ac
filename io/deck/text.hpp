// Small helpers for the text of a deck: trimming, case, numbers, nearest word.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace balocco::deck {

std::string_view trim(std::string_view text);

/// Upper case, as names and keywords are compared and stored.
std::string upper(std::string_view text);

/// Upper case without any blank: "Solid  Section" and "SOLIDSECTION" are the same keyword.
std::string squeeze(std::string_view text);

/// A name as written in a field or value: quotes removed, upper case, trimmed.
std::string clean_name(std::string_view text);

/// The whole text as a finite number; Fortran exponents (1.D-3) and a leading plus sign are understood.
std::optional<double> parse_real(std::string_view text);
std::optional<std::int64_t> parse_integer(std::string_view text);

/// Splits at commas outside quotes and trims; a trailing comma makes no empty last field.
void split(std::string_view line, std::vector<std::string_view>& fields);

/// The candidate that `word` is a slip of the pen for, or "": one letter changed, added, left out or swapped, two in a long
/// word, the same digits.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// "; did you mean X?" or "" when nothing is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// "A, B, C".
std::string join(const std::vector<std::string>& words);

}  // namespace balocco::deck
