// A complex response as those who write results see it: two parts, each a displacement of the reference configuration like any other,
// of which the analysis shows the one that is being asked for.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "analysis.hpp"
#include "kept_state.hpp"

namespace balocco {

/// Base motion as every node takes part in it: a displacement, 3 values a local node, times exp(i omega t).
struct RigidBaseMotion {
  std::vector<double> displacement, rotation;
  std::complex<double> value{}, velocity{}, acceleration{};  // at the frequency that is told
};

/// The response: real part and imaginary part. U, V and A are relative to the base; TU, TV and TA are total, with the base's motion.
class HarmonicResults : public ResultSource {
 public:
  HarmonicResults(Analysis& analysis, const std::vector<RigidBaseMotion>& base);

  /// What the analysis shows now becomes the real (0) or the imaginary (1) part.
  void take(int part);
  /// Puts the parts away: the analysis shows what procedures make of it, until something is asked for.
  void put_away() { show(none); }

  std::vector<ResultPart> parts() const override { return {{"_REAL", &parts_[0]}, {"_IMAG", &parts_[1]}}; }
  const State& state() const override { return parts_[0].state(); }
  std::span<const std::unique_ptr<ElementGroup>> groups() const override { return analysis_.groups(); }
  int nodal_components(std::string_view variable) const override { return parts_[0].nodal_components(variable); }
  void nodal(std::string_view variable, std::span<double> values) const override { parts_[0].nodal(variable, values); }
  void element(std::size_t group, std::string_view variable, std::int32_t element, int point, std::span<double> values) const override {
    parts_[0].element(group, variable, element, point, values);
  }
  EnergyBalance energies() const override { return {}; }
  ContactResultant contact(std::int32_t) const override { return {}; }

 private:
  class Part : public ResultSource {
   public:
    Part(HarmonicResults& whole, int number) : whole_(whole), number_(number) {}

    const State& state() const override { return whole_.show(number_).current; }
    std::span<const std::unique_ptr<ElementGroup>> groups() const override { return whole_.analysis_.groups(); }
    int nodal_components(std::string_view variable) const override;
    void nodal(std::string_view variable, std::span<double> values) const override;
    void element(std::size_t group, std::string_view variable, std::int32_t element, int point, std::span<double> values) const override {
      whole_.show(number_).element(group, variable, element, point, values);
    }
    void element_mean(std::size_t group, std::string_view variable, std::int32_t element, std::span<double> values) const override {
      whole_.show(number_).element_mean(group, variable, element, values);
    }
    EnergyBalance energies() const override { return {}; }
    ContactResultant contact(std::int32_t) const override { return {}; }

   private:
    HarmonicResults& whole_;
    int number_;
  };

  static constexpr int none = -1;

  const Analysis& show(int part);
  void exchange(int part);
  void add_base_motion(std::string_view variable, int part, std::span<double> values) const;

  Analysis& analysis_;
  const std::vector<RigidBaseMotion>& base_;
  std::array<Part, 2> parts_;
  std::array<State, 2> states_;         // of the part that is shown: what the analysis shows otherwise
  std::array<ShownBeside, 2> beside_;   // likewise
  int shown_ = none;
};

}  // namespace balocco
