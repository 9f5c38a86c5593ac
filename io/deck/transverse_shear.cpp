// *TRANSVERSE SHEAR STIFFNESS, of the beam or shell section before it.
#include "deck/builder.hpp"
#include "deck/register.hpp"

namespace balocco::deck {

namespace {

/// K23 (shear along n2), K13 (along n1).
void read_beam(Builder& builder, const Block& block) {
  if (block.lines.empty()) return builder.error(block, block.location, "the stiffnesses K23, K13 are missing; add a data line");
  Row row(builder, block, block.lines[0]);
  const double k23 = row.real(0, "shear stiffness K23"), k13 = row.real(1, "shear stiffness K13");
  row.at_most(2);
  if (row.ok() && !(k23 > 0.0 && k13 > 0.0)) row.error("shear stiffnesses must be positive");
  if (row.ok()) builder.model.sections.back().beam.shear_stiffness = {k13, k23};
}

/// K11, K22, K12, forces per length.
void read_shell(Builder& builder, const Block& block) {
  if (block.lines.empty()) return builder.error(block, block.location, "the stiffness is missing; add K11, K22, K12");
  Row row(builder, block, block.lines[0]);
  const double k11 = row.real(0, "K11"), k22 = row.real(1, "K22"), k12 = row.real_or(2, 0.0, "K12");
  row.at_most(3);
  if (row.ok() && !(k11 > 0.0 && k22 > 0.0 && k11 * k22 > k12 * k12))
    row.error("the stiffness is not positive definite; give positive K11 and K22 and a smaller K12");
  if (row.ok()) builder.model.sections.back().shell.transverse_shear = {k11, k22, k12};
}

void read_transverse_shear(Builder& builder, const Block& block) {
  const auto& sections = builder.model.sections;
  const auto kind = sections.empty() ? Section::Kind::solid : sections.back().kind;
  if (kind == Section::Kind::beam) return read_beam(builder, block);
  if (kind == Section::Kind::shell) return read_shell(builder, block);
  builder.error(block, block.location, "it belongs behind a section of beams or shells; move it there");
}

const RegisterKeyword transverse_shear{{"TRANSVERSE SHEAR STIFFNESS", Phase::sections, Place::model, {}, read_transverse_shear}};

}  // namespace

}  // namespace balocco::deck
