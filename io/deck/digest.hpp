// SHA-256 (FIPS 180-4), so that results say which deck they belong to.
#pragma once

#include <deque>
#include <string>

namespace balocco::deck {

/// Hexadecimal digest of the texts one after the other.
std::string digest(const std::deque<std::string>& texts);

}  // namespace balocco::deck
