// The procedures: each advances the state of an analysis through one step, from wherever in the step the state stands.
#pragma once

#include <array>
#include <string>
#include <variant>

#include "analysis.hpp"
#include "model/results.hpp"

namespace balocco {

enum class Outcome { finished, stopped };

/// Advances the state through one step of a procedure. Collective.
using RunStep = Outcome (*)(Analysis& analysis, const Step& step, Observer& observer);

/// Newton's method with automatic increments. @throws AnalysisError when an increment does not converge at the smallest size.
Outcome run_static_step(Analysis& analysis, const Step& step, Observer& observer);

/// The alpha method of implicit dynamics. @throws AnalysisError as run_static_step.
Outcome run_dynamic_step(Analysis& analysis, const Step& step, Observer& observer);

/// The sum of the modes that a frequency step found. @throws AnalysisError where there are none.
Outcome run_modal_dynamic_step(Analysis& analysis, const Step& step, Observer& observer);

/// Responses to harmonic loads as sums of the modes that a frequency step found. @throws AnalysisError where there are none, or where a mode
/// without damping is excited at its own frequency.
Outcome run_steady_state_step(Analysis& analysis, const Step& step, Observer& observer);

/// The response of first order about the state. @throws AnalysisError if nothing resists a motion.
Outcome run_static_perturbation_step(Analysis& analysis, const Step& step, Observer& observer);

/// Load factors of linear buckling. @throws AnalysisError where there are none.
Outcome run_buckle_step(Analysis& analysis, const Step& step, Observer& observer);

/// Half-step central difference. @throws AnalysisError when an element inverts or the run blows up.
Outcome run_explicit_step(Analysis& analysis, const Step& step, Observer& observer);

/// Runners of the alternatives of Step::procedure.
std::array<RunStep, std::variant_size_v<Procedure>>& procedure_runners();

/// The line with which a solver joins the register: static const RegisterProcedure<StaticProcedure> registered(run_static_step);
template <class Kind>
struct RegisterProcedure {
  explicit RegisterProcedure(RunStep run) { procedure_runners()[Procedure(Kind{}).index()] = run; }
};

/// Runs the steps from where the state stands to the end of the model's last step, or of the step named `last`
/// (empty: all). @throws InputError when there is no step of that name.
Outcome run_steps(Analysis& analysis, Observer& observer, const std::string& last = {});

}  // namespace balocco
