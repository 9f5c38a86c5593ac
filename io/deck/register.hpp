// The register of keywords. Adding one = one handler and one `RegisterKeyword` in the file of its group; what is not
// registered is refused, and so is every parameter that a keyword does not list.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "deck/tokens.hpp"

namespace balocco::deck {

class Builder;

/// Handlers run phase by phase, and in deck order within a phase, so that a deck may refer to what it defines further
/// down.
enum class Phase { definitions, nodes, elements, surfaces, sections, constraints, history };

enum class Place { model, step, anywhere };

struct ParameterRule {
  /// Optional kinds may stand with or without a value; a foreign one says how another code should compute or look for
  /// something that has no counterpart here, so it is left out with a note.
  enum class Kind { flag, text, name, real, integer, choice, optional_real, optional_choice, foreign } kind = Kind::flag;
  std::string name;
  std::vector<std::string> choices;
  bool required = false;
};

ParameterRule flag(std::string name);
ParameterRule name(std::string name);
ParameterRule text(std::string name);
ParameterRule real(std::string name);
ParameterRule integer(std::string name);
ParameterRule choice(std::string name, std::vector<std::string> choices);
ParameterRule optional_real(std::string name);
ParameterRule optional_choice(std::string name, std::vector<std::string> choices);
ParameterRule foreign(std::string name);
ParameterRule required(ParameterRule rule);

struct KeywordRule {
  std::string keyword;  // as documented, with blanks
  Phase phase = Phase::definitions;
  Place place = Place::model;
  std::vector<ParameterRule> parameters = {};
  void (*handler)(Builder&, const Block&) = nullptr;  // null: accepted, and has nothing to say to a Model
  std::string parent = "";                            // an option that only makes sense under this keyword, or this " or " that one
  std::string warning = "";                           // told where the keyword is used
  bool any_parameter = false;                         // old output requests: nothing of them is looked at
};

/// A keyword that is known already is a std::logic_error: before main, the program then does not start.
struct RegisterKeyword {
  explicit RegisterKeyword(KeywordRule rule);
};

/// The rule of a keyword (upper case, without blanks), or nullptr.
const KeywordRule* find_keyword(std::string_view squeezed);
std::vector<std::string> keywords();

/// Checks the parameters of a block against its rule, and writes names and choices out where the deck abbreviates them
/// (Abaqus: as many letters as make them unique). @return false if something was wrong.
bool check_parameters(const KeywordRule& rule, Block& block, Diagnostics& diagnostics);

}  // namespace balocco::deck
