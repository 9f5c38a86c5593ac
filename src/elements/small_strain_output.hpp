// What elements show after geometrically linear steps: Taylor's polynomials, about the reference configuration, of what their
// kernels compute at finite strain. Those of first order are small strain and the law's tangent times it; of energies the
// quadratic ones. No element or law has to know. An initial stress is a force alone, without stiffness, but in perturbations.
// Perturbations about another state show the terms of first order there, of energies those of second order, and nothing else.
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "elements/element_group.hpp"
#include "model/state.hpp"

namespace balocco {

class SmallStrainOutput {
 public:
  /// What a perturbation is about, 4 values a node: places, with a scratch node behind them, and of nodes that turn.
  struct Base {
    std::vector<double> position, orientation, rotation;
    bool linear = false;  // the reference configuration
  };

  /// `reference`: where the nodes are in the reference configuration, 4 values a node and a scratch node behind them.
  SmallStrainOutput(const Model& model, std::vector<double> reference)
      : model_(model), reference_(std::move(reference)), trial_(reference_) {}

  /// From now on states are the reference configuration and a perturbation of `base`; null: they are linear ones.
  void perturb(std::shared_ptr<const Base> base) { base_ = std::move(base); }

  /// As ElementGroup::output. `history` is that of the reference configuration; the relative error is about 1e-11.
  void output(const ElementGroup& group, std::string_view variable, std::int32_t element, int point, const State& state,
              std::span<const double> history, std::span<double> values);
  /// Internal force, freedoms_per_node() a node.
  void internal_force(const ElementGroup& group, std::int32_t element, const State& state, std::span<const double> history,
                      std::span<double> values);
  /// As ElementGroup::energies.
  ElementEnergies energies(const ElementGroup& group, std::int32_t element, const State& state,
                           std::span<const double> history);

 private:
  double step(const ElementGroup& group, std::int32_t element, const State& state) const;
  NodalMotion place(const ElementGroup& group, std::int32_t element, const State& state, double factor);
  using Samples = std::array<std::array<double, 60>, 5>;  // of forces on 20 nodes at most; at -2, -1, 0, 1, 2 steps
  template <class Evaluate>
  void sample(const ElementGroup& group, std::int32_t element, const State& state, std::span<const double> history, Evaluate evaluate,
              std::size_t count, double step, Samples& samples);
  template <class Evaluate>
  void expand(const ElementGroup& group, std::int32_t element, const State& state, std::span<const double> history,
              Evaluate evaluate, int order, std::span<double> values);

  std::vector<int> unstiffening_rows(const ElementGroup& group, const State& state) const;

  const Model& model_;
  std::shared_ptr<const Base> base_;
  std::vector<double> reference_, trial_, trial_orientation_, trial_rotation_;
  std::vector<double> trial_history_, unstressed_history_, force_;
};

}  // namespace balocco
