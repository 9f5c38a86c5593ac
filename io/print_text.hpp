// How CalculiX lays out JOB.dat: titles, numbers, headings. Text alone.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/results.hpp"

namespace balocco {

/// A number as Fortran's E14.7 and E13.7: "0.1000000E+01".
std::string fortran_real(double value);

std::string step_heading(std::int32_t step);            // counted from 0
std::string increment_heading(std::int64_t increment);  // counted from 1
/// The number that a heading line of a step or increment counts; -1: it is none of that kind.
std::int64_t number_of_step_heading(const std::string& line);
std::int64_t number_of_increment_heading(const std::string& line);

/// " displacements (vx,vy,vz)" of a variable that *NODE PRINT or *EL PRINT names, as a title begins; "total force
/// (fx,fy,fz)".
std::string title_of_nodes(const std::string& variable);
std::string title_of_elements(const std::string& variable);
std::string title_of_totals(const std::string& variable);

/// One line: a node or element, the integration point unless it is negative, and values.
std::string table_row(std::int64_t id, int point, std::span<const double> values);
std::string totals_row(std::span<const double> values);

/// The tables that every frequency step prints.
std::string eigenvalue_tables(const std::vector<Mode>& modes);
/// That of a buckle step.
std::string load_factor_table(const std::vector<Mode>& modes);
std::string mode_heading(std::int32_t number);

}  // namespace balocco
