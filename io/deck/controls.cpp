// *CONTROLS.
#include <fmt/format.h>

#include <algorithm>

#include "deck/builder.hpp"
#include "deck/register.hpp"
#include "deck/step_draft.hpp"
#include "deck/text.hpp"

namespace balocco::deck {

namespace {

/// Fields that a *CONTROLS line has but Balocco does not honour must be empty.
void only_fields(Row& row, std::initializer_list<int> known) {
  for (int field = 0; field < row.size(); ++field) {
    if (row.has(field) && std::find(known.begin(), known.end(), field) == known.end()) {
      row.error(fmt::format("field {} ('{}') is not supported; leave it empty", field + 1, row.text(field)));
      return;
    }
  }
}

struct Control {
  const char* name;
  double standard;  // Abaqus's default
};
// Of TIME INCREMENTATION: first line, second line. How fast iterations converge, and how often they fail, does not steer increments here.
constexpr std::array<Control, 10> iterations{{{"I_0", 4}, {"I_R", 8}, {"I_P", 9}, {"I_C", 16}, {"I_L", 10}, {"I_G", 4}, {"I_S", 12}, {"I_A", 5},
                                              {"I_J", 6}, {"I_T", 3}}};
constexpr std::array<Control, 8> factors{{{"D_F", 0.25}, {"D_C", 0.5}, {"D_B", 0.75}, {"D_A", 0.85}, {"D_S", 0.25}, {"D_H", 0.75}, {"D_D", 1.5},
                                          {"W_G", 0.75}}};
constexpr int most_iterations = 3;  // field of I_C, which is honoured

/// Other fields may only repeat what holds anyway.
void only_standard(Row& row, std::span<const Control> controls, int honoured) {
  row.at_most(static_cast<int>(controls.size()));
  for (int field = 0; field < std::min<int>(row.size(), static_cast<int>(controls.size())) && row.ok(); ++field) {
    const auto& [name, standard] = controls[field];
    if (field == honoured || !row.has(field)) continue;
    const double given = row.real(field, name);
    if (row.ok() && given != standard)
      row.error(fmt::format("{} = {} is not supported: increments follow the standard rules; leave field {} empty, or give the standard {}",
                            name, given, field + 1, standard));
  }
}

void read_time_incrementation(Builder& builder, const Block& block, ImplicitControls& controls) {
  Row row(builder, block, block.lines[0]);
  only_standard(row, iterations, most_iterations);
  if (!row.ok()) return;
  controls.maximum_iterations = static_cast<std::int32_t>(row.integer_or(most_iterations, controls.maximum_iterations, "most iterations"));
  if (row.ok() && controls.maximum_iterations < 1) row.error("the number of iterations must be positive; correct it");
  if (block.lines.size() < 2) return;
  Row second(builder, block, block.lines[1]);
  only_standard(second, factors, -1);
}

/// N_ls of zero switches the line search off, and so do steps that are held at one, the greatest and the least.
void read_line_search(Row& row, ImplicitControls& controls) {
  only_fields(row, {0, 1, 2});
  const double greatest = row.real_or(1, 1.0, "greatest step"), least = row.real_or(2, 0.0, "least step");
  if (row.ok() && (greatest != 1.0 || (row.has(2) && least != 1.0)))
    row.error("of the bounds of the step only 1, 1 is supported, which switches the line search off; leave fields 2 and 3 empty");
  if (!row.ok()) return;
  controls.line_search = least != 1.0 && row.integer_or(0, 0, "most line-search iterations") > 0;
}

void read_controls(Builder& builder, const Block& block) {
  auto& controls = builder.draft.controls;
  if (block.has("RESET")) controls = {};
  if (block.lines.empty()) return;
  const std::string parameters = squeeze(block.value("PARAMETERS"));
  const std::size_t known_lines = parameters == "TIMEINCREMENTATION" ? 2 : 1;
  if (block.lines.size() > known_lines)
    builder.error(block, block.lines[known_lines].location, "further lines of *CONTROLS are not supported; remove them");
  if (parameters == "TIMEINCREMENTATION") return read_time_incrementation(builder, block, controls);
  Row row(builder, block, block.lines[0]);
  if (parameters == "FIELD") {  // R_n, C_n
    only_fields(row, {0, 1});
    controls.residual_tolerance = row.real_or(0, controls.residual_tolerance, "residual tolerance");
    controls.correction_tolerance = row.real_or(1, controls.correction_tolerance, "correction tolerance");
    if (row.ok() && !(controls.residual_tolerance > 0.0 && controls.correction_tolerance > 0.0))
      row.error("tolerances must be positive; correct them");
  } else {
    read_line_search(row, controls);
  }
}

const RegisterKeyword controls{{"CONTROLS",
                                Phase::history,
                                Place::step,
                                {choice("PARAMETERS", {"FIELD", "TIME INCREMENTATION", "LINE SEARCH"}), flag("RESET")},
                                read_controls}};

}  // namespace

}  // namespace balocco::deck
