// Reads a deck in Abaqus keyword syntax into a Model. How: deck/tokens (lines to keyword blocks), deck/schedule (rules
// checked, parts and instances flattened), then one handler per keyword (deck/*.cpp), then the checks of
// model/check.hpp.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace balocco {

/// Whole text of a file; nullopt: there is no such file. In a parallel run it must give every rank the same text.
using FileLoader = std::function<std::optional<std::string>(const std::string& path)>;

/// Reads plain files.
FileLoader file_loader();

struct ReadOptions {
  std::vector<std::string>
      ignored_keywords;  // keywords (without asterisk) that warn and are skipped instead of being refused
  /// *IMPORT, UPDATE=YES: moves the nodes that Model::state_import names to where another job left them, before anything is made of
  /// their coordinates. Empty: they stay where the deck says.
  std::function<void(Model&)> move_imported_nodes;
};

struct ReadResult {
  Model model;
  std::vector<std::string> warnings;  // "FILE:LINE: warning: *KEYWORD: ...", and notes
};

/// @throws InputError with up to 20 messages, sorted by file and line.
ReadResult read_deck(const std::string& path, const FileLoader& loader, const ReadOptions& options = {});

}  // namespace balocco
