// Applies the rules of the register to the blocks, flattens *PART / *INSTANCE / *ASSEMBLY, and says what is to be run.
#pragma once

#include <vector>

#include "deck/builder.hpp"
#include "deck/register.hpp"
#include "deck/tokens.hpp"

namespace balocco::deck {

struct Task {
  const Block* block = nullptr;
  const KeywordRule* rule = nullptr;
  Scope* scope = nullptr;
  Phase phase = Phase::history;  // constraints inside a step change with the step
  bool in_step = false;
};

std::vector<Task> schedule(Builder& builder, std::vector<Block>& blocks, const ReadOptions& options);

}  // namespace balocco::deck
