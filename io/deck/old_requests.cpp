// What cannot change results, accepted with a warning: output requests for files that Balocco does not write, and thermal properties
// where no heat flows.
#include "deck/register.hpp"

namespace balocco::deck {

namespace {

/// Requests for the old results file and for tables that are not printed: there is no such file here.
KeywordRule old_request(const char* keyword) {
  return {.keyword = keyword,
          .place = Place::anywhere,
          .warning =
              "asks for a file that Balocco does not write; results go to the HDF5 "
              "file: use *OUTPUT",
          .any_parameter = true};
}

const RegisterKeyword file_format{old_request("FILE FORMAT")}, node_file{old_request("NODE FILE")}, el_file{old_request("EL FILE")},
    monitor{old_request("MONITOR")},
    contact_file{old_request("CONTACT FILE")}, energy_print{old_request("ENERGY PRINT")},
    energy_file{old_request("ENERGY FILE")}, file_output{old_request("FILE OUTPUT")}, print{old_request("PRINT")}, diagnostics{old_request("DIAGNOSTICS")};

/// Options of *MATERIAL that act where heat flows, which it does nowhere here: temperatures are given.
KeywordRule thermal(const char* keyword) {
  return {.keyword = keyword,
          .place = Place::model,
          .parent = "MATERIAL",
          .warning = "no heat flows here: it has nothing to act on",
          .any_parameter = true};
}

const RegisterKeyword conductivity{thermal("CONDUCTIVITY")}, specific_heat{thermal("SPECIFIC HEAT")};
const RegisterKeyword physical_constants{
    {.keyword = "PHYSICAL CONSTANTS",
     .place = Place::model,
     .warning = "there are no charges, radiation or absolute temperatures here: it has nothing to act on",
     .any_parameter = true}};

}  // namespace

}  // namespace balocco::deck
