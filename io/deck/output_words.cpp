#include "deck/output_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "deck/text.hpp"

namespace balocco::deck {

const Words node_vectors{"U", "V", "A", "RF", "UR", "VR", "AR", "RM"};
const Words contact_fields{"CPRESS", "CSHEAR", "COPEN", "CSLIP", "CNORMF", "CSHEARF"};
const Words contact_histories{"CFN", "CFT", "CM", "CAREA", "XN"};
const Words energies{"ALLKE", "ALLIE", "ALLSE", "ALLPD", "ALLVD", "ALLAE", "ALLFD", "ALLCW", "ALLMW", "ALLWK", "ETOTAL"};

const Words preselected_node{"U", "V", "A", "RF"};
const Words preselected_element{"S", "LE", "MISES"};
const Words preselected_contact{"CPRESS", "CSHEAR", "COPEN"};
const Words all_element{"S", "LE", "MISES", "PRESS", "SENER", "STH", "ELSE", "ELASE"};

namespace {

// Variables of Abaqus that its own pre-processor asks for by default and that are not written here: told, but no reason
// to refuse.
const Words abaqus_only{
    "CF",      "COORD",    "TF",       "RT",      "UT",     "VT",    "AT",      "NT",     "CM1",     "E",
    "EE",      "NE",       "PE",       "PEEQ",    "PEMAG",  "PEEQT", "EVOL",  "IVOL",    "ELKE",
    "ELPD",    "PRESS",    "TRIAX",    "DENSITY", "STATUS", "SF",    "SE",      "ER",     "EVF",     "SVAVG",
    "PEVAVG",  "PEEQVAVG", "CNAREA",   "CSTATUS", "CFS",    "ALLCD", "ALLDMD",  "ALLEE",  "ALLJD",   "ALLKL",
    "ALLQB",   "ALLSD",    "ALLVE",    "ALLDC",   "ALLMW",  "ALLPW", "ALLCCDW", "ALLCCE", "ALLCCEN", "ALLCCET",
    "ALLCCSD", "ALLCCSDN", "ALLCCSDT", "ALLHF",   "ALLIHE", "DMASS", "EFABRIC",  "ALPHA", "ALPHAN",  "CS11",    "CTSHR",
    "EEQUT",   "IE",       "MISESMAX", "MISESONLY", "PEEQMAX", "PEQC", "PRESSONLY", "PS",   "SALPHA",  "SEE",     "SEP",
    "SEPE",    "SEQUT",    "SPE",      "SSAVG",   "TE",     "TEEQ",  "TEVOL",    "THE",   "TSHR",    "VE",      "VEEQ",
    "VS",      "YIELDPOT", "CE",       "CEEQ",    "HSNFTCRT", "SDV", "SDEG",     "ESF1",  "NFORC",   "SP",      "EP",
    "LEP",     "NEP",      "PEP",      "EMSF",    "SINV",   "GRAV",  "CF",       "RBFOR", "RBANG",   "RBROT"};

}  // namespace

bool contains(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

void add(Words& words, const std::string& word) {
  if (!contains(words, word)) words.push_back(word);
}

bool is_abaqus_only(const std::string& variable) {
  static const Words components_only{"CF1", "CF2", "CF3", "CM1", "CM2", "CM3", "TF1", "TF2", "TF3", "TM1", "TM2", "TM3", "COOR1", "COOR2", "COOR3"};
  return contains(abaqus_only, variable) || contains(components_only, variable);
}

bool has_no_parts(const std::string& variable) {
  static const Words quadratic{"MISES", "PEEQ", "SENER", "ENER", "ELSE", "ELASE", "ELKE", "STATUS"};
  return contains(quadratic, variable);
}

std::string whole_variable(const std::string& component) {
  static const Words tensors{"S", "E", "LE", "EE", "NE", "PE", "ER", "SE", "SS"}, pairs{"11", "22", "33", "12", "13", "23"};
  for (const auto& tensor : tensors)
    for (const auto& pair : pairs)
      if (component == tensor + pair) return tensor;
  static const std::map<std::string, std::string> vectors{
      {"SF", "SF"},   {"SM", "SM"},   {"SK", "SK"},   {"CTF", "CTF"}, {"CTM", "CTF"}, {"CEF", "CEF"}, {"CEM", "CEF"}, {"CVF", "CVF"},
      {"CVM", "CVF"}, {"CRF", "CRF"}, {"CRM", "CRF"}, {"CU", "CU"},   {"CUR", "CU"},  {"CV", "CV"},   {"CVR", "CV"}};
  const bool numbered = !component.empty() && component.back() >= '1' && component.back() <= '6';
  const auto vector = vectors.find(component.substr(0, component.size() - (numbered ? 1 : 0)));
  return numbered && vector != vectors.end() ? vector->second : component;
}

void unknown_variable(Builder& builder, const Block& block, Row& row, const std::string& variable, const Words& known) {
  if (is_abaqus_only(variable)) {
    return builder.warning(block, row.location(), fmt::format("variable {} is not written by Balocco", variable));
  }
  row.error(fmt::format("variable {} is unknown or not supported{}; supported: {}", variable,
                        did_you_mean(variable, known), join(known)));
}

ParameterRule variable_rule() {
  return choice("VARIABLE", {"PRESELECT", "ALL"});
}

Words asked_by_variable(const Block& block, const Words& preselected, const Words& all) {
  if (!block.has("VARIABLE")) return {};
  return block.value("VARIABLE") == "ALL" ? all : preselected;
}

}  // namespace balocco::deck
