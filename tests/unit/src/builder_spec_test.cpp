// The tyre description: every bad line is told with file, line, table, key and cure.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "builder_sample.hpp"
#include "builders/spec_table.hpp"
#include "builders/tyre_lamina.hpp"
#include "builders/tyre_section.hpp"
#include "builders/tyre_spec.hpp"
#include "model/diagnostics.hpp"

namespace balocco {
namespace {

std::string faults_of(const std::string& text) {
  try {
    read_tyre_spec(text, "t.toml", no_file);
  } catch (const InputError& error) {
    std::string all;
    for (const auto& message : error.messages()) all += message + "\n";
    return all;
  }
  return "accepted";
}

/// "t.toml:LINE" of the first occurrence of a text.
std::string at_line_of(const std::string& needle, const std::string& text) {
  return "t.toml:" + std::to_string(1 + std::count(text.begin(), text.begin() + text.find(needle), '\n'));
}

std::string faults_with(const std::string& from, const std::string& to) {
  return faults_of(sample_with(from, to));
}

TEST(TyreSpec, ReadsTheSample) {
  const auto spec = read_tyre_spec(sample_tyre(2), "t.toml", no_file);
  EXPECT_EQ(spec.model, 2);
  EXPECT_EQ(spec.regions[0].points.size(), 3u);
  EXPECT_DOUBLE_EQ(spec.regions[1].points[1].cap, 4.2);
  EXPECT_EQ(spec.regions[0].plies.size(), 3u);
  EXPECT_DOUBLE_EQ(spec.statics.expected_stiffness, 185.0);
}

TEST(TyreSpec, NamesTheNearestKnownKey) {
  const auto misspelt = sample_with("clearance = 5.0", "clearance = 5.0\nbehnd = 3.0");
  EXPECT_EQ(faults_of(misspelt),
            at_line_of("behnd", misspelt) + ": error: [road] behnd: unknown key; did you mean \"behind\"?\n");
  EXPECT_NE(faults_with("[rim]", "[wheels]\na = 1\n[rim]").find("error: wheels: unknown key"), std::string::npos);
}

TEST(TyreSpec, TellsMissingKeysAndTables) {
  EXPECT_EQ(faults_with("width = 127.0\n", ""),
            at_line_of("[rim]", sample_tyre()) + ": error: [rim] width: missing; add this key to the table\n");
  EXPECT_NE(faults_with("[mesh]", "[road.mesh]").find(": error: mesh: missing"), std::string::npos);
}

TEST(TyreSpec, TellsValuesOutOfRangeWithTheirUnit) {
  EXPECT_NE(faults_with("pressure = 0.22", "pressure = -0.22")
                .find("[static] pressure: -0.22 is out of range; write a number > 0 MPa"),
            std::string::npos);
  EXPECT_NE(faults_with("mass = 5000.0", "mass = \"heavy\"").find("[rim] mass: not a number; write a number > 0 g"),
            std::string::npos);
  EXPECT_NE(faults_with("model = 3", "model = 4").find("model: write a whole number from 1 to 3"), std::string::npos);
  EXPECT_NE(
      faults_with("cord_area = 0.25", "cord_area = 1.25").find("[ply.body] cord_area: cords fill 100 % of the ply"),
      std::string::npos);
}

TEST(TyreSpec, TellsNamesThatNothingDescribes) {
  EXPECT_NE(faults_with("cord = \"polyester\"", "cord = \"polyster\"")
                .find("[ply.body] cord: \"polyster\" is not described in this file; did you mean \"polyester\"?"),
            std::string::npos);
}

TEST(TyreSpec, RefusesImpossibleGeometry) {
  EXPECT_NE(faults_with("[236.0, 82.2, 3.5]", "[266.0, 82.2, 3.5]").find("the line must fall from crown to toe"),
            std::string::npos);
  EXPECT_NE(
      faults_with("[236.0, 82.2, 3.5]", "[236.0, 82.2]").find("[section.sidewall] points: row 2 needs 3 to 3 numbers"),
      std::string::npos);
  EXPECT_NE(faults_with("top_fillet = 4.0", "top_fillet = 24.0").find("higher than the obstacle"), std::string::npos);
  EXPECT_NE(faults_with("ahead = 1000.0", "ahead = 500.0").find("leaves the road"), std::string::npos);
}

TEST(TyreSection, TellsTheLineOfWhatCannotBeMeshed) {
  const auto said = [](const std::string& text) {
    try {
      make_section(read_tyre_spec(text, "t.toml", no_file));
    } catch (const InputError& error) {
      return error.messages().front();
    }
    return std::string("accepted");
  };
  const auto thick = sample_with("[192.5, 58.7, 6.5, 3.5]", "[192.5, 58.7, 90.0, 3.5]");
  EXPECT_EQ(said(thick).find(at_line_of("[192.5", thick) + ": error: [section] points: the rubber"), 0u) << said(thick);
  const auto narrow = sample_with("bottom = 5.0", "bottom = 12.99");
  EXPECT_EQ(said(narrow).find(at_line_of("bottom = 12.99", narrow) + ": error: [bead_wire] bottom: no node"), 0u) << said(narrow);
}

TEST(TyreSpec, CollectsAllFaults) {
  const auto faults = faults_of(sample_with("spacing = 1.25", "spacing = 0.0") + "colour = 1\n");
  EXPECT_NE(faults.find("[ply.body] spacing"), std::string::npos);
  EXPECT_NE(faults.find("[output] colour"), std::string::npos);
}

TEST(TyreSpec, TellsTheLineOfASyntaxError) {
  const auto broken = sample_with("frames = 20", "frames = = 20");
  EXPECT_EQ(faults_of(broken).find(at_line_of("frames", broken) + ": error: TOML syntax: "), 0u) << faults_of(broken);
}

/// A description that is based on the sample, its own lines before those of the base's tables.
std::string faults_of_based(const std::string& text, const std::string& sample = sample_tyre(2)) {
  const auto load = [&](const std::string& path) { return path == "base/sample.toml" ? std::optional(sample) : std::nullopt; };
  try {
    read_tyre_spec("base = \"../base/sample.toml\"\n" + text, "car/t.toml", load);
  } catch (const InputError& error) {
    return error.messages().front();
  }
  return "accepted";
}

TEST(SpecBase, GivesWhatADescriptionDoesNotSay) {
  const auto load = [](const std::string&) { return std::optional(sample_tyre(2)); };
  const auto* own = "base = \"sample.toml\"\nmodel = 1\n[rubber.soft]\nc01 = 0.3\n[section.belt]\nplies = [\"body\"]\n";
  const auto spec = read_tyre_spec(own, "t.toml", load);
  EXPECT_EQ(spec.model, 1);                        // its own
  EXPECT_EQ(spec.title, "sample");                 // the base's
  EXPECT_DOUBLE_EQ(spec.rubbers[0].c01, 0.3);      // tables key by key
  EXPECT_DOUBLE_EQ(spec.rubbers[0].c10, 0.4);
  EXPECT_EQ(spec.regions[0].plies.size(), 1u);     // arrays whole
  EXPECT_EQ(spec.regions[0].elements, 4);
}

TEST(SpecBase, FaultsAreToldWhereTheirValuesStand) {
  EXPECT_EQ(faults_of_based("[rim]\nwidth = -1.0\n"),
            "car/t.toml:3: error: [rim] width: -1 is out of range; write a number > 0 mm");
  const auto bad = sample_with("width = 127.0", "width = -127.0", 2);
  EXPECT_EQ(faults_of_based("[rim]\nmass = 1.0\n", bad),
            "base/sample" + at_line_of("width", bad).substr(1) +
                ": error: [rim] width: -127 is out of range; write a number > 0 mm");
  EXPECT_EQ(faults_of_based("[rim]\nwith = 1.0\n"), "car/t.toml:3: error: [rim] with: unknown key; did you mean \"width\"?");
}

TEST(SpecBase, MustBeThereAndNoCircle) {
  const auto said = [](const std::string& first, const std::string& second) {
    try {
      const auto load = [&](const std::string& path) { return path == "b.toml" ? std::optional(second) : std::nullopt; };
      read_tyre_spec(first, "a.toml", load);
    } catch (const InputError& error) {
      return error.messages().front();
    }
    return std::string("accepted");
  };
  EXPECT_EQ(said("base = \"c.toml\"\n", ""),
            "a.toml:1: error: base: no file c.toml; give the path of a description from this file's folder");
  EXPECT_EQ(said("base = 1\n", ""), "a.toml:1: error: base: not a text; write the path of a description in quotes");
  EXPECT_EQ(said("base = \"b.toml\"\n", "\nbase = \"./a.toml\"\n"),
            "b.toml:2: error: base: a.toml is based on this file in turn; remove one base of the chain");
  EXPECT_EQ(said("base = \"a.toml\"\n", ""),
            "a.toml:1: error: base: a.toml is based on this file in turn; remove one base of the chain");
}

TEST(SpecTable, NearestWordByEdits) {
  EXPECT_EQ(nearest_word("presure", {"load", "pressure"}), "pressure");
  EXPECT_EQ(nearest_word("xyz", {"load", "pressure"}), "");
}

// By hand: fraction = 0.25 / (1.25 * 1.0) = 0.2; rubber shear modulus 2 (0.4 + 0.1) = 1, Young's modulus 2 * 1.49
// = 2.98 MPa.
TEST(TyreLamina, RuleOfMixturesAndHalpinTsai) {
  const auto spec = read_tyre_spec(sample_tyre(), "t.toml", no_file);
  const auto lamina = make_lamina(spec.plies[1], spec);  // names are sorted: belt, body, liner
  EXPECT_NEAR(lamina.cord_fraction, 0.2, 1e-15);
  EXPECT_NEAR(lamina.modulus_1, 0.2 * 9870.0 + 0.8 * 2.98, 1e-9);
  EXPECT_NEAR(lamina.poisson_12, 0.2 * 0.3 + 0.8 * 0.49, 1e-12);
  EXPECT_NEAR(lamina.density, 0.2 * 1.38e-3 + 0.8 * 1.1e-3, 1e-15);
  const double ratio = 9870.0 / 2.98, eta = (ratio - 1.0) / (ratio + 2.0);
  EXPECT_NEAR(lamina.modulus_2, 2.98 * (1.0 + 0.4 * eta) / (1.0 - 0.2 * eta), 1e-9);
  // Stiff fibres: G12 tends to G (1 + f) / (1 - f) = 1.5 MPa; 3796 MPa of cord shear leave 0.05 %.
  EXPECT_NEAR(lamina.shear_12, 1.5, 1e-3);
  EXPECT_NEAR(spec.plies[1].angle, std::acos(0.0), 1e-12);
}

// As many cords at 3 / 4 of the radius: 4 / 3 of the fraction. Belts are cut to width and keep their spacing.
TEST(TyreLamina, RadialCordsGatherTowardsTheBead) {
  const auto spec = read_tyre_spec(sample_tyre(), "t.toml", no_file);
  EXPECT_NEAR(make_lamina(ply_at(spec.plies[1], 0.75), spec).cord_fraction, 0.2 / 0.75, 1e-12);
  EXPECT_NEAR(make_lamina(ply_at(spec.plies[0], 0.75), spec).cord_fraction, 0.2, 1e-12);
}

TEST(TyreLamina, RubberAloneIsIsotropic) {
  const auto spec = read_tyre_spec(sample_tyre(), "t.toml", no_file);
  const auto lamina = make_lamina(spec.plies[2], spec);
  EXPECT_DOUBLE_EQ(lamina.modulus_1, lamina.modulus_2);
  EXPECT_NEAR(lamina.shear_12, lamina.modulus_1 / (2.0 * (1.0 + lamina.poisson_12)), 1e-12);
}

TEST(TyreLamina, RadialPlyIsStiffAlongTheMeridian) {
  const auto spec = read_tyre_spec(sample_tyre(), "t.toml", no_file);
  const auto stiffness = laminate_stiffness({1}, spec, 1.0);
  const auto lamina = make_lamina(spec.plies[1], spec);
  const double scale = 1.0 / (1.0 - lamina.poisson_12 * lamina.poisson_12 * lamina.modulus_2 / lamina.modulus_1);
  EXPECT_NEAR(stiffness.meridional, scale * lamina.modulus_1, 1e-6);
  EXPECT_NEAR(stiffness.circumferential, scale * lamina.modulus_2, 1e-6);
}

}  // namespace
}  // namespace balocco
