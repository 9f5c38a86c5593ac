#include "print_text.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace balocco {

namespace {

constexpr const char* step_words = "S T E P";
constexpr const char* increment_words = "INCREMENT";

std::int64_t number_behind(const std::string& line, const std::string& words) {
  const auto first = line.find_first_not_of(' ');
  if (first == std::string::npos || line.compare(first, words.size(), words) != 0) return -1;
  return std::strtoll(line.c_str() + first + words.size(), nullptr, 10);
}

std::string value_text(double value) {
  return fmt::format(" {:13.6E}", value);
}

/// Six values a mode, about the global axes.
std::string table_of_modes(const char* title, const std::vector<Mode>& modes, std::array<double, 6> Mode::*member,
                           bool totals) {
  std::string text = fmt::format(
      "\n     {}\n\nMODE NO.   X-COMPONENT     Y-COMPONENT     Z-COMPONENT     X-ROTATION      Y-ROTATION      "
      "Z-ROTATION\n\n",
      title);
  std::array<double, 6> sum{};
  for (const auto& mode : modes) {
    text += fmt::format("{:7}", mode.number);
    for (int i = 0; i < 6; ++i) {
      text += "  " + fortran_real((mode.*member)[i]);
      sum[i] += (mode.*member)[i];
    }
    text += '\n';
  }
  if (!totals) return text;
  text += "TOTAL  ";
  for (const double value : sum) text += "  " + fortran_real(value);
  return text + '\n';
}

}  // namespace

std::string fortran_real(double value) {
  const std::string digits = fmt::format("{:.6e}", std::abs(value));  // d.dddddde+xx
  const int exponent = value == 0.0 ? 0 : std::atoi(digits.c_str() + 9) + 1;
  return fmt::format("{}0.{}{}E{:+03}", std::signbit(value) ? '-' : ' ', digits[0], digits.substr(2, 6), exponent);
}

std::string step_heading(std::int32_t step) {
  return fmt::format("\n                        {} {:7}\n\n", step_words, step + 1);
}

std::string increment_heading(std::int64_t increment) {
  return fmt::format("\n                                {} {:5}\n\n", increment_words, increment);
}

std::int64_t number_of_step_heading(const std::string& line) {
  return number_behind(line, step_words);
}
std::int64_t number_of_increment_heading(const std::string& line) {
  return number_behind(line, increment_words);
}

std::string title_of_nodes(const std::string& variable) {
  static const std::map<std::string, std::string> titles{
      {"U", "displacements (vx,vy,vz)"}, {"V", "velocities (vx,vy,vz)"}, {"A", "accelerations (ax,ay,az)"},
      {"RF", "forces (fx,fy,fz)"},       {"UR", "rotations (rx,ry,rz)"}, {"VR", "angular velocities (rx,ry,rz)"},
      {"RM", "moments (mx,my,mz)"}};
  return titles.at(variable);
}

std::string title_of_elements(const std::string& variable) {
  static const std::map<std::string, std::string> titles{
      {"S", "stresses (elem, integ.pnt.,sxx,syy,szz,sxy,sxz,syz)"},
      {"E", "strains (elem, integ.pnt.,exx,eyy,ezz,exy,exz,eyz)"},
      {"ME", "mechanical strains (elem, integ.pnt.,exx,eyy,ezz,exy,exz,eyz)"},
      {"LE", "logarithmic strains (elem, integ.pnt.,exx,eyy,ezz,exy,exz,eyz)"},
      {"MISES", "Mises stress (elem, integ.pnt.,s)"},
      {"PEEQ", "equivalent plastic strain (elem, integ.pnt.,pe)"},
      {"ENER", "internal energy density (elem, integ.pnt.,energy)"},
      {"COORD", "global coordinates (elem, integ.pnt.,x,y,z)"},
      {"EVOL", "volume (element, volume)"},
      {"ELSE", "internal energy (element, energy)"},
      {"ELKE", "kinetic energy (elem, energy)"}};
  return titles.at(variable);
}

std::string title_of_totals(const std::string& variable) {
  static const std::map<std::string, std::string> titles{{"RF", "total force (fx,fy,fz)"},
                                                         {"RM", "total moment (mx,my,mz)"},
                                                         {"EVOL", "total volume"},
                                                         {"ELSE", "total internal energy"},
                                                         {"ELKE", "total kinetic energy"}};
  const auto found = titles.find(variable);
  return found == titles.end() ? "" : found->second;
}

std::string table_row(std::int64_t id, int point, std::span<const double> values) {
  std::string text = fmt::format("{:10}", id);
  if (point >= 0) text += fmt::format(" {:3}", point + 1);
  for (const double value : values) text += value_text(value);
  return text + '\n';
}

std::string totals_row(std::span<const double> values) {
  std::string text = "      ";
  for (const double value : values) text += value_text(value);
  return text + '\n';
}

std::string eigenvalue_tables(const std::vector<Mode>& modes) {
  std::string text =
      "\n     E I G E N V A L U E   O U T P U T\n\n MODE NO    EIGENVALUE                       FREQUENCY   \n"
      "                                     REAL PART            IMAGINARY PART\n"
      "                           (RAD/TIME)      (CYCLES/TIME     (RAD/TIME)\n\n";
  std::vector<Mode> normalized;  // to a generalised mass of 1
  for (const auto& mode : modes) {
    const double circular = std::sqrt(std::abs(mode.eigenvalue));
    text += fmt::format("{:7}  {}  {}  {}  {}\n", mode.number, fortran_real(mode.eigenvalue),
                        fortran_real(mode.eigenvalue > 0.0 ? circular : 0.0),
                        fortran_real(mode.eigenvalue > 0.0 ? circular / (2.0 * std::numbers::pi) : 0.0),
                        fortran_real(mode.eigenvalue > 0.0 ? 0.0 : circular));
    Mode numbers{.number = mode.number, .participation = mode.participation, .effective_mass = mode.effective_mass};
    for (double& value : numbers.participation) value *= std::sqrt(mode.generalized_mass);
    normalized.push_back(std::move(numbers));
  }
  text += table_of_modes("P A R T I C I P A T I O N   F A C T O R S", normalized, &Mode::participation, false);
  return text + table_of_modes("E F F E C T I V E   M O D A L   M A S S", normalized, &Mode::effective_mass, true);
}

std::string load_factor_table(const std::vector<Mode>& modes) {
  std::string text = "\n     B U C K L I N G   F A C T O R   O U T P U T\n\n MODE NO       BUCKLING\n                FACTOR\n\n";
  for (const auto& mode : modes) text += fmt::format("{:7}  {}\n", mode.number, fortran_real(mode.eigenvalue));
  return text;
}

std::string mode_heading(std::int32_t number) {
  return fmt::format("\n\n                    E I G E N V A L U E    N U M B E R {:5}\n\n", number);
}

}  // namespace balocco
