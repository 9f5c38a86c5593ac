// A metal for tests of laws.
#pragma once

#include "model/model.hpp"

namespace balocco::test {

inline Material steel(std::vector<MaterialOption> options) {
  return {.name = "STEEL", .law = "elastic", .parameters = {200.0, 0.3}, .options = std::move(options), .location = {}};
}
/// Hardening by a table.
inline MaterialOption table() {
  return {"plastic", {0.0}, {{0.4, 0.0}, {0.5, 0.02}, {0.6, 0.1}, {0.7, 0.5}}};
}

}  // namespace balocco::test
