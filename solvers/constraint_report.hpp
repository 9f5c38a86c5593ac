// What a solver tells of constraints that others imply.
#pragma once

#include <span>

#include "analysis.hpp"

namespace balocco {

/// Rows that any rank knows. Collective.
std::vector<std::int32_t> of_all_ranks(const Analysis& analysis, std::span<const std::int32_t> rows);

/// Names the constraints to which `rows` of State::multiplier belong.
void log_dependent_constraints(const Analysis& analysis, std::span<const std::int32_t> rows, Observer& observer);

/// Rows that others imply must be met by them. @throws AnalysisError, on every rank, that names one which is not: two conditions
/// contradict each other. Collective.
void refuse_contradictions(const Analysis& analysis, std::span<const std::int32_t> rows, double model_size);

}  // namespace balocco
