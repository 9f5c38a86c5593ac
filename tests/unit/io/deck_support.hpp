// Decks for the tests of the reader, without files.
#pragma once

#include <map>
#include <string>

#include "deck_reader.hpp"
#include "model/diagnostics.hpp"

namespace balocco::test {

/// Reads a deck from memory; `files` are what it may include.
inline ReadResult read(const std::string& deck, std::map<std::string, std::string> files = {},
                       const ReadOptions& options = {}) {
  files["job.inp"] = deck;
  return read_deck(
      "job.inp",
      [files](const std::string& path) -> std::optional<std::string> {
        const auto found = files.find(path);
        return found == files.end() ? std::nullopt : std::optional(found->second);
      },
      options);
}

/// The errors of a bad deck, one a line; "" if it was accepted.
inline std::string errors_of(const std::string& deck, const std::map<std::string, std::string>& files = {}) {
  try {
    read(deck, files);
  } catch (const InputError& trouble) {
    std::string all;
    for (const auto& message : trouble.messages()) all += message + "\n";
    return all;
  }
  return "";
}

/// A brick of unit edges with a material, a section and the set names ALLN and ALL; steps are to be added.
inline const std::string brick =
    "*HEADING\nunit brick\n"
    "*NODE, NSET=ALLN\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1\n"
    "*ELEMENT, TYPE=C3D8R, ELSET=ALL\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
    "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n*DENSITY\n7.8E-9\n"
    "*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n";

inline const std::string static_step = "*STEP\n*STATIC\n*END STEP\n";

}  // namespace balocco::test
