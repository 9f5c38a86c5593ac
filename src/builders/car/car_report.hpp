// What was built, in words and numbers, with a word of warning where it lies outside the class.
#pragma once

#include "builders/car/body_deck.hpp"
#include "builders/car/body_parts.hpp"

namespace balocco::car {

std::string car_report(const CarSpec& spec, const BodyMesh& mesh, const std::vector<WeldLine>& welds);

}  // namespace balocco::car
