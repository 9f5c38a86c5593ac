// From text to keyword blocks: comments, continuation lines, *INCLUDE, INPUT= files, *PARAMETER and <name>
// substitution. Blocks and lines are views of the loaded text: no line owns memory.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "deck/diagnostics.hpp"
#include "deck_reader.hpp"
#include "model/model.hpp"

namespace balocco::deck {

struct DataLine {
  std::string_view text;
  Location location;
};

/// NAME or NAME=VALUE on a keyword line.
struct Parameter {
  std::string name;     // upper case, without blanks
  std::string written;  // as in the deck
  std::string value;    // upper case, quotes removed
  std::string raw;      // as in the deck, quotes removed: file names
  bool has_value = false;
  std::int32_t line = 0;  // where it stands: a keyword may run over several lines
};

/// A keyword line and the data lines that follow it.
struct Block {
  std::string keyword;  // upper case, without blanks and asterisk
  std::string written;  // upper case with blanks, for messages
  std::vector<Parameter> parameters;
  Location location;
  std::vector<DataLine> lines;

  const Parameter* find(std::string_view name) const;
  bool has(std::string_view name) const { return find(name) != nullptr; }
  /// Value (upper case), or `otherwise` when the parameter is absent.
  std::string value(std::string_view name, std::string otherwise = "") const;
  /// Numbers were checked when the rules were applied.
  double real(std::string_view name, double otherwise) const;
  std::int32_t integer(std::string_view name, std::int32_t otherwise) const;
};

struct Tokens {
  std::deque<std::string> texts;  // what the views look at
  std::vector<std::string> files;
  std::vector<Block> blocks;
};

/// Reads a deck and everything that it includes.
Tokens tokenize(const std::string& path, const FileLoader& loader, Diagnostics& diagnostics);

}  // namespace balocco::deck
