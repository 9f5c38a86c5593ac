// What an explicit step tells the outside: output arrays, progress, balance at the start, timers at the end.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "constraint_report.hpp"
#include "explicit_folding.hpp"
#include "explicit_nodes.hpp"
#include "explicit_step.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

void ExplicitStep::fill_output() {
  timers.measure(Phase::output, [&] {
    bodies_.bring_resting_nodes(analysis_, next_increment_);
    auto& acceleration = analysis_.acceleration;
    analysis_.output_increment = last_increment_ > 0.0 ? last_increment_ : next_increment_;
    std::fill(analysis_.reaction.begin(), analysis_.reaction.end(), 0.0);
    for (std::size_t node = 0; node < inverse_.mass.size(); ++node)
      for (std::size_t c = 0; c < 3; ++c) acceleration[4 * node + c] = inverse_.mass[node] * force_[4 * node + c];
    std::fill(analysis_.reaction_moment.begin(), analysis_.reaction_moment.end(), 0.0);
    for (std::size_t node = 0; node < inverse_.rotary.size(); ++node)
      for (std::size_t c = 0; c < 3; ++c)
        analysis_.angular_acceleration[4 * node + c] = inverse_.rotary[node] * moment_[4 * node + c];
    std::fill(analysis_.work_ahead.begin(), analysis_.work_ahead.end(), NodalWork{});
    add_half_work(next_increment_, analysis_.work_ahead);
    linkages_.add_guide_work(analysis_, ExplicitLinkages::Half::next, next_increment_, analysis_.work_ahead);
    constraints_.add_to_output(analysis_, instant());
    rotation_constraints_.add_to_output(analysis_, instant());
    linkages_.add_to_output(analysis_);
    gyroscopic_.add_to_output(analysis_, instant());
    bodies_.add_to_output(analysis_, instant(), moments_);
  });
}

Progress ExplicitStep::progress() const {
  const auto& state = analysis_.current;
  const auto governing =
      analysis_.communicator.minimum(Communicator::Located{stability_.increment, stability_.element});
  Progress progress;
  progress.increment = state.increment;
  progress.step_time = state.step_time;
  progress.total_time = state.total_time;
  progress.time_increment = last_increment_;
  const bool elements_govern = restraint_bound_.element < 0 || governing.value <= restraint_bound_.increment();
  progress.critical_element = elements_govern ? governing.payload : restraint_bound_.element;
  progress.largest_penetration = contact_.largest_penetration(analysis_);
  progress.deleted_elements = analysis_.communicator.sum(failures_.count(analysis_.current.element_history));
  progress.added_mass = mass_scaling_.added_part();
  progress.negligible_energy = negligible_energy_;
  progress.step_finished = finished();
  return progress;
}

/// The increments that land on the end of the step are shorter than those before: what the longer ones conserved is told once more
/// before the first of them, because near the limit of stability a change of increment changes it.
bool ExplicitStep::lands() const {
  const double remaining = step_.duration() - analysis_.current.step_time;
  return next_increment_ >= (0.5 - 1e-9) * remaining && next_increment_ < (1.0 - 1e-6) * last_increment_ && !finished();
}

bool ExplicitStep::observe() {
  const bool landing = lands();
  if (!is_observed()) return true;
  fill_output();
  const bool regular = analysis_.current.increment % regular_increments == 0;
  watch_folding();
  if (regular || finished()) watch_increment();
  report_failure();
  if (regular || landing || (finished() && !checked_before_landing_)) check_energy_balance();
  checked_before_landing_ = checked_before_landing_ || landing;
  if (!attention_ && !finished()) return true;
  contact_.report_past_end(analysis_, observer_);
  bool go_on = true;
  timers.measure(Phase::output, [&] { go_on = observer_.advanced(analysis_, progress()); });
  return go_on;
}

void ExplicitStep::report_failure() {
  analysis_.communicator.together([&] {
    if (failure_) throw AnalysisError(*failure_);
  });
}

void ExplicitStep::report_collapse() {
  const auto worst = analysis_.communicator.minimum(Communicator::Located{stability_.increment, stability_.element});
  const double fixed = procedure_.fixed_increment.value_or(0.0), stable = analysis_.undeformed_increment;
  throw AnalysisError(fmt::format(
      "step {}, increment {}, time {:.6g}: element {} has become so distorted that its stable increment is {:.3g} "
      "(undeformed model: {:.3g}){}",
      step_.name, analysis_.current.increment, analysis_.current.total_time, worst.payload, worst.value, stable,
      fixed <= stable ? ""
                      : fmt::format("; the deck's increment of {:.3g} is longer than that of the undeformed model: give a shorter one, or "
                                    "leave DIRECT USER CONTROL out", fixed)));
}

void ExplicitStep::remember_blow_up() {
  if (failure_) return;
  std::int32_t node = 0;
  const auto has_blown_up = [&](std::size_t at) {
    return has_outgrown(&force_[4 * at]) || (at < inverse_.rotary.size() && has_outgrown(&moment_[4 * at]));
  };
  while (!has_blown_up(static_cast<std::size_t>(node))) ++node;
  const Model& model = analysis_.model;
  std::string element;
  for (const auto& group : analysis_.element_groups) {
    for (std::int32_t e = 0; e < group->size() && element.empty(); ++e) {
      const auto nodes = group->nodes(e);
      if (std::find(nodes.begin(), nodes.end(), node) != nodes.end())
        element = fmt::format(" of element {}", model.elements[group->table()].id[group->row(e)]);
    }
  }
  failure_ = fmt::format(
      "step {}, increment {}, time {:.6g}: the run has blown up at node {}{}; the time increment may be too "
      "large, or a load or an initial penetration too violent",
      step_.name, analysis_.current.increment, analysis_.current.total_time,
      model.nodes.id[analysis_.domain.node_row[node]], element);
}

void ExplicitStep::watch_folding() {
  const auto folding = failure_ ? Folding{} : find_folding(analysis_, failures_);
  const auto when = fmt::format("step {}, increment {}, time {:.6g}", step_.name, analysis_.current.increment, analysis_.current.total_time);
  if (folding.inside_out && finished())
    failure_ = fmt::format(
        "{}: element {} has turned inside out at node {} when the step ends: it is distorted beyond what its mesh can follow; use smaller "
        "elements or elements of a better shape there, let it fail (*SHEAR FAILURE), or load it less",
        when, folding.inside_out->element, folding.inside_out->node);
  tell_first(told_folded_, folding.folded, [&](std::int64_t element) {
    return fmt::format("{}: warning: element {} is folded at a corner: stresses there are poor; use smaller elements there", when, element);
  });
  if (finished()) return;
  tell_first(told_inside_out_, folding.inside_out, [&](std::int64_t element) {
    return fmt::format(
        "{}: warning: element {} has turned inside out at a corner: it is distorted beyond what its mesh can follow, and where it does not "
        "recover the run fails at the end of the step", when, element);
  });
}

void ExplicitStep::watch_increment() {
  constexpr double short_part = 0.1;  // of the undeformed model's stable increment
  if (told_short_) return;
  const auto least = analysis_.communicator.minimum(Communicator::Located{stability_.increment, stability_.element});
  if (least.value >= short_part * analysis_.undeformed_increment) return;
  told_short_ = true;
  observer_.log(fmt::format(
      "step {}, increment {}, time {:.6g}: warning: element {} is so distorted, or so stiffly held, that its stable increment is {:.3g} (undeformed model: {:.3g}): "
      "as long as it is so the run takes that much longer; use elements of a better shape there, load it less, or soften what holds it",
      step_.name, analysis_.current.increment, analysis_.current.total_time, least.payload, least.value, analysis_.undeformed_increment));
}

/// Collective.
void ExplicitStep::tell_first(bool& told, const std::optional<FoldedCorner>& found, const std::function<std::string(std::int64_t)>& text) {
  if (told || !analysis_.communicator.any(found.has_value())) return;
  told = true;
  const auto id = found ? found->element : std::numeric_limits<std::int64_t>::max();
  observer_.log(text(analysis_.communicator.minimum(Communicator::Located{static_cast<double>(id), id}).payload));
}

void ExplicitStep::find_negligible_energy() {
  negligible_energy_ = rounding_energy_.value(analysis_, external_force_, loaded_nodes_, std::sqrt(bodies_.balance().gravity));
}

void ExplicitStep::start_energy_balance() {
  find_negligible_energy();
  const auto energies = analysis_.energies();
  analysis_.current.energy_at_start = energies.total;
  analysis_.current.largest_energy = energies.magnitude();
}

/// Created energy: kinetic + internal energy less the work done, so that dissipation, whose books are kept per increment and can
/// overstate it near a shock, excuses nothing.
void ExplicitStep::check_energy_balance() {
  auto& state = analysis_.current;
  EnergyBalance energies;
  timers.measure(Phase::output, [&] {
    energies = analysis_.energies();
    find_negligible_energy();
  });
  state.largest_energy = std::max(state.largest_energy, energies.magnitude());
  const double created = energies.total - energies.viscous - energies.friction - state.energy_at_start;
  if (created <= procedure_.energy_error_limit * state.largest_energy || created <= negligible_energy_) return;
  throw AnalysisError(fmt::format(
      "step {}, increment {}, time {:.6g}: the energy balance is lost: {:.4g} has been created, {:.3g} % of the largest "
      "energy of the step ({:.4g}; kinetic {:.4g}, internal {:.4g}, work {:.4g}); reduce the time increment (SCALE "
      "FACTOR), or allow more with *DYNAMIC, EXPLICIT, ENERGY ERROR={:.3g}",
      step_.name, state.increment, state.total_time, created, 100.0 * created / state.largest_energy, state.largest_energy,
      energies.kinetic, energies.internal, energies.work, 200.0 * created / state.largest_energy));
}

void ExplicitStep::log_balance() {
  const auto& domain = analysis_.domain;
  auto force = force_, moment = moment_;
  analysis_.communicator.together([&] { linkages_.add_resting_forces(analysis_, {force.data(), moment.data()}); });
  const auto balance = bodies_.balance();
  std::array<double, 2> sums{};  // squares: unbalanced; loads and reactions. Moments count with 1 / lever.
  const auto add = [&](std::vector<double> vector, const std::vector<double>& external, const NodalConstraints& constraints,
                       const std::vector<double>& inverse_inertia, auto inverse_lever) {
    sums[1] += constraints.squared_constrained(domain, vector.data(), inverse_lever);
    constraints.remove_constrained(vector.data());
    for (std::size_t node = 0; node < inverse_inertia.size(); ++node) {
      if (!domain.owned[node]) continue;
      const double weight = inverse_lever(node) * inverse_lever(node);
      for (std::size_t c = 0; c < 3; ++c) {
        if (inverse_inertia[node] > 0.0) sums[0] += weight * vector[4 * node + c] * vector[4 * node + c];
        if (!external.empty()) sums[1] += weight * external[4 * node + c] * external[4 * node + c];
      }
    }
  };
  add(force, external_force_, constraints_, linkages_.inverse().mass, [](std::size_t) { return 1.0; });
  add(moment, external_moment_, rotation_constraints_, linkages_.inverse().rotary,
      [&](std::size_t node) { return 1.0 / scale_.lever[node]; });
  analysis_.communicator.sum(std::span<double>(sums));
  const double residual = std::sqrt(sums[0] + balance.unbalanced);
  const double external = std::sqrt(sums[1] + balance.reactions + balance.gravity);
  if (external == 0.0) return;
  observer_.log(
      fmt::format("step {} starts with |f_int + f_contact - f_ext| / |f_ext| = {:.3e} (|f_ext| = {:.6g}, loads and "
                  "reactions)",
                  step_.name, residual / external, external));
}

void ExplicitStep::log_dependent_constraints() const {
  balocco::log_dependent_constraints(analysis_, of_all_ranks(analysis_, analysis_.current.implied_rows), observer_);
}

void ExplicitStep::log_resting_elements() const {
  std::int64_t all = 0, acting = 0;
  for (const auto& group : analysis_.element_groups) {
    all += group->size();
    acting += group->acting_count();
  }
  all = analysis_.communicator.sum(all);
  acting = analysis_.communicator.sum(acting);
  if (acting == all) return;
  observer_.log(fmt::format("step {}: {} of {} elements move with rigid bodies or are out: they are not computed and bound no increment",
                            step_.name, all - acting, all));
}

void ExplicitStep::log_deleted_elements() const {
  const std::int64_t deleted = analysis_.communicator.sum(failures_.count(analysis_.current.element_history));
  if (deleted == 0) return;
  observer_.log(fmt::format("step {}: {} elements have failed and are deleted (*SHEAR FAILURE); their mass stays at the nodes",
                            step_.name, deleted));
}

void ExplicitStep::log_mass_scaling() const {
  for (const auto& line : mass_scaling_.report(analysis_)) observer_.log(line);
}

void ExplicitStep::log_timers() const {
  std::int64_t elements = 0;
  for (const auto& group : analysis_.element_groups) elements += group->acting_count();
  const double cycles = static_cast<double>(cycles_), total = timers.total();
  std::array<double, PhaseTimers::count + 1> largest{};
  for (std::size_t i = 0; i < PhaseTimers::count; ++i) largest[i] = timers.seconds(static_cast<Phase>(i));
  largest.back() = elements > 0 ? timers.seconds(Phase::elements) / (cycles * static_cast<double>(elements)) : 0.0;
  std::array<double, 2> sums{timers.seconds(Phase::elements), 1.0};  // the second one: ranks
  analysis_.communicator.sum(std::span<double>(sums));
  const double longest = analysis_.communicator.maximum(total);
  analysis_.communicator.maximum(std::span<double>(largest));
  std::string line = fmt::format(
      "explicit: {} increments in {:.2f} s, {:.1f} ns per element-cycle in elements; slowest rank:", cycles_, longest,
      1e9 * largest.back());
  for (std::size_t i = 0; i < PhaseTimers::count; ++i)
    line += fmt::format(" {} {:.1f} %", PhaseTimers::names[i], 100.0 * largest[i] / longest);
  const double mean = sums[0] / sums[1], most = largest[static_cast<std::size_t>(Phase::elements)];
  if (sums[1] > 1.0 && mean > 0.0) line += fmt::format("; elements take {:.1f} % longer there than on the mean rank", 100.0 * (most / mean - 1.0));
  observer_.log(line);
}

}  // namespace balocco
