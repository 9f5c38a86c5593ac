// Arithmetic of *PARAMETER: numbers, names, + - * / **, parentheses, sqrt sin cos tan exp log abs, pi.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace balocco::deck {

using ParameterValues = std::map<std::string, double>;  // by upper-case name

/// @throws std::invalid_argument saying what is wrong.
double evaluate(std::string_view expression, const ParameterValues& values);

}  // namespace balocco::deck
