// Harmonic loads and steps in a deck: parts of loads, and what a step of *STEADY STATE DYNAMICS takes and what not.
#pragma once

#include "deck/builder.hpp"

namespace balocco::deck {

/// What LOAD CASE=1 or 2, REAL and IMAGINARY say of a load (both spellings are Abaqus's): whether it is the imaginary part. That the step is
/// a harmonic one is seen to at its end.
bool is_imaginary(Builder& builder, const Block& block);

/// For writers: how such a load is marked.
inline const char* part_parameter(bool imaginary) { return imaginary ? ", LOAD CASE=2" : ""; }

/// Notes what a harmonic step does not take, should this one be such: what is wrong and how to mend it. `without_times` says so of a parameter
/// that has a meaning over time alone.
void refuse_in_harmonics(Builder& builder, const Block& block, std::string text);
std::string without_times(const char* parameter);

/// At the end of a step: refuses parts of loads in steps of times, and times in harmonic steps; these write what they ask for themselves.
void settle_harmonics(Builder& builder);

}  // namespace balocco::deck
