#include "job_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "checkpoint.hpp"
#include "kept_checkpoints.hpp"
#include "model/diagnostics.hpp"
#include "print_tables.hpp"
#include "results_file.hpp"
#include "results_schedule.hpp"
#include "signals.hpp"
#include "status.hpp"

namespace balocco {

namespace {

constexpr double seconds_between_polls = 0.2;      // how soon a signal or JOB.ctl is noticed in an explicit step
constexpr double seconds_between_flushes = 30.0;   // how much history a kill may cost
constexpr std::int32_t status_lines = 100;         // per explicit step

std::optional<Schedule> checkpoint_schedule(const Step& step) {
  if (step.checkpoint_number_interval) return Schedule::equal_intervals(*step.checkpoint_number_interval, step.duration());
  if (step.checkpoint_frequency && *step.checkpoint_frequency > 0) {
    return Schedule::every_increments(*step.checkpoint_frequency, step.duration());
  }
  return std::nullopt;
}

}  // namespace

struct JobObserver::Implementation {
  /// What is due in the step that runs.
  struct StepPlan {
    std::vector<Schedule> fields;  // per Step::field_outputs
    std::optional<Schedule> status, checkpoint;
    History history;
    FrameWriter frames;
  };

  Implementation(const Model& model, const Communicator& communicator, const Domain& domain, JobPaths job, bool restarted);

  void start(const ResultSource& running, std::int32_t step);
  bool advance(const ResultSource& running, const Progress& progress);
  void write_frame(const ResultSource& running, const Progress& progress, const FrameVariables& variables);
  FrameVariables due_variables(const Progress& progress);
  void write_status(const ResultSource& running, const Progress& progress, const Requests& requests);
  void save(const ResultSource& running, const Progress& progress);
  void look_at_clock(const Progress& progress);
  double next_due() const;
  void write_last_frame();
  const Step& current() const { return model.steps[step]; }

  const Model& model;
  const Communicator& communicator;
  const Domain& domain;
  const JobPaths paths;
  bool resuming;
  std::unique_ptr<Status> status;
  ResultsFile results;
  PrintTables tables;

  std::int32_t step = -1;
  const ResultSource* source = nullptr;
  std::optional<StepPlan> plan;
  Progress last;
  double poll_step = 0.0, next_poll = 0.0;       // step time between looks at the clock, and of the next
  double polled = 0.0, controlled = 0.0, flushed = 0.0;  // seconds, on root
  bool flush_now = false;
  bool stopped = false, writing_failed = false;
};

JobObserver::Implementation::Implementation(const Model& the_model, const Communicator& the_communicator, const Domain& the_domain,
                                            JobPaths job, bool restarted)
    : model(the_model),
      communicator(the_communicator),
      domain(the_domain),
      paths(std::move(job)),
      resuming(restarted),
      results(model, communicator, paths.results(), paths.xdmf()),
      tables(model, communicator, domain, paths.tables()) {
  communicator.together([&] {
    if (communicator.is_root()) std::filesystem::create_directories(paths.directory.empty() ? "." : paths.directory);
    if (communicator.is_root() && !restarted) forget_kept_checkpoints(paths.checkpoint());
    status = std::make_unique<Status>(paths.status(), paths.log(), model, restarted, communicator.is_root());
  });
  if (restarted) return;
  results.create();
  tables.create();
}

void JobObserver::Implementation::start(const ResultSource& running, std::int32_t started) {
  step = started;
  source = &running;
  const State& state = running.state();
  if (resuming) {
    results.resume(state);
    tables.resume(state);
  }
  resuming = false;
  results.start_step(step, state.total_time);
  tables.start_step(running, step);

  std::vector<std::string> complaints;
  const double duration = current().duration();
  plan.emplace(StepPlan{{},
                        std::nullopt,
                        checkpoint_schedule(current()),
                        History(model, communicator, domain, running, step, complaints),
                        FrameWriter(model, communicator, domain, running.groups())});
  for (const std::string& complaint : complaints) status->log(complaint);
  for (const FieldOutput& output : current().field_outputs) plan->fields.push_back(Schedule::of(output, current()));
  if (!current().has_few_increments()) plan->status = Schedule::at_leisure(status_lines, duration, regular_increments);

  status->start_step(step, state);
  last = Progress{};
  last.increment = state.increment;
  last.step_time = state.step_time;
  last.total_time = state.total_time;
  // A harmonic response has no start.
  if (state.increment == 0 && !current().is_harmonic()) {
    plan->history.sample(running, last, true);
    FrameVariables all;
    for (const FieldOutput& output : current().field_outputs) all.add(output);
    if (!current().field_outputs.empty()) results.add_frame(plan->frames, all, running, last, plan->history);
  }
  for (Schedule& schedule : plan->fields) schedule.pass(state.step_time);
  plan->history.pass(state.step_time);
  if (plan->status) plan->status->pass(state.step_time);
  if (plan->checkpoint) plan->checkpoint->pass(state.step_time);
  poll_step = 1e-6 * duration;
  next_poll = state.step_time;
  polled = flushed = status->seconds();
  controlled = -seconds_between_polls;
}

FrameVariables JobObserver::Implementation::due_variables(const Progress& progress) {
  FrameVariables variables;
  for (std::size_t i = 0; i < plan->fields.size(); ++i) {
    if (plan->fields[i].due(progress.step_time, progress.increment, progress.step_finished)) {
      variables.add(current().field_outputs[i]);
    }
    plan->fields[i].pass(progress.step_time);
  }
  return variables;
}

/// Root's clock decides, for all ranks, when to look at it again and whether the histories have waited long enough.
void JobObserver::Implementation::look_at_clock(const Progress& progress) {
  const double now = status->seconds();
  std::array<double, 2> decided{poll_step, now - flushed >= seconds_between_flushes ? 1.0 : 0.0};
  if (progress.step_time >= next_poll) {
    const double waited = std::max(now - polled, 1e-6);
    decided[0] = poll_step * std::clamp(seconds_between_polls / waited, 0.25, 2.0);
    polled = now;
  }
  MPI_Bcast(decided.data(), 2, MPI_DOUBLE, 0, communicator.handle());
  poll_step = decided[0];
  flush_now = decided[1] > 0.0;
  if (flush_now) flushed = now;
  if (progress.step_time >= next_poll) next_poll = progress.step_time + poll_step;
}

void JobObserver::Implementation::write_status(const ResultSource& running, const Progress& progress, const Requests& requests) {
  if (current().is_harmonic()) {
    status->harmonic_line(progress);
  } else if (current().has_few_increments()) {
    const EnergyBalance energies = running.energies();
    status->static_line(progress, energies.work, energies.internal);
  } else if (plan->status->due(progress.step_time, progress.increment, progress.step_finished) || requests.info) {
    plan->status->pass(progress.step_time);
    status->explicit_line(progress, running.state(), running.energies());
  }
  status->show(progress, requests.info);
}

void JobObserver::Implementation::save(const ResultSource& running, const Progress& progress) {
  // What the checkpoint takes for written must be on the disk before it.
  results.add_history(plan->history);
  results.synchronize_with_disk();
  write_checkpoint(paths.checkpoint(), model, communicator, domain, running.groups(), running.state(), progress.step_finished);
}

bool JobObserver::Implementation::advance(const ResultSource& running, const Progress& progress) {
  source = &running;
  last = progress;
  look_at_clock(progress);
  const bool control = status->seconds() - controlled >= seconds_between_polls;
  if (control) controlled = status->seconds();
  const Requests requests = take_requests(communicator, control ? paths.control() : "");

  plan->history.sample(running, progress, false);
  FrameVariables variables = due_variables(progress);
  if (requests.frame) {
    for (const FieldOutput& output : current().field_outputs) variables.add(output);
  }
  if (!variables.empty()) results.add_frame(plan->frames, variables, running, progress, plan->history);
  tables.advance(running, progress);
  write_status(running, progress, requests);
  if (flush_now) results.add_history(plan->history);

  bool scheduled = false;
  if (plan->checkpoint) {
    scheduled = progress.step_finished || plan->checkpoint->due(progress.step_time, progress.increment, false);
    plan->checkpoint->pass(progress.step_time);
  }
  bool checkpoint = scheduled || requests.checkpoint || requests.stop || progress.step_finished;
  if (progress.step_finished) {
    results.add_history(plan->history);
    results.finish_step(step, progress.total_time);
  }
  // What a perturbation shows is no state to go on from: the checkpoint before it stands.
  if (current().is_perturbation() && !current().seeks_modes()) checkpoint = false;
  if (checkpoint) save(running, progress);
  if (checkpoint && scheduled && current().keeps_checkpoints)
    communicator.together([&] {
      if (communicator.is_root()) keep_checkpoint(paths.checkpoint(), step + 1, progress.increment);
    });
  const bool all_done = progress.step_finished && step + 1 == static_cast<std::int32_t>(model.steps.size());
  stopped = requests.stop && !all_done;
  return !stopped;
}

double JobObserver::Implementation::next_due() const {
  if (!plan) return 0.0;
  double next = std::min({next_poll, plan->history.next_due(), tables.next_due()});
  for (const Schedule& schedule : plan->fields) next = std::min(next, schedule.next());
  if (plan->status) next = std::min(next, plan->status->next());
  if (plan->checkpoint) next = std::min(next, plan->checkpoint->next());
  return next;
}

/// Everything that the step's frames hold, where the analysis stands; a harmonic response stands nowhere.
void JobObserver::Implementation::write_last_frame() {
  if (current().is_harmonic()) return;
  FrameVariables all;
  for (const FieldOutput& output : current().field_outputs) all.add(output);
  last.increment = source->state().increment;
  last.total_time = source->state().total_time;
  last.step_time = source->state().step_time;
  if (all.empty() || results.shows(step, last.total_time)) return;
  results.add_frame(plan->frames, all, *source, last, plan->history);
}

JobObserver::JobObserver(const Model& model, const Communicator& communicator, const Domain& domain, JobPaths paths,
                         bool restarted)
    : implementation_(std::make_unique<Implementation>(model, communicator, domain, std::move(paths), restarted)) {}

JobObserver::~JobObserver() = default;

void JobObserver::step_started(const ResultSource& source, std::int32_t step) {
  implementation_->writing_failed = true;  // until it has not
  implementation_->start(source, step);
  implementation_->writing_failed = false;
}

bool JobObserver::advanced(const ResultSource& source, const Progress& progress) {
  implementation_->writing_failed = true;
  const bool go_on = implementation_->advance(source, progress);
  implementation_->writing_failed = false;
  return go_on;
}

double JobObserver::next_due() const { return implementation_->next_due(); }

void JobObserver::mode_found(const Mode& mode) {
  implementation_->writing_failed = true;
  implementation_->results.add_mode(implementation_->plan->frames, mode);
  implementation_->tables.add_mode(mode);
  implementation_->writing_failed = false;
}

void JobObserver::log(const std::string& line) { implementation_->status->log(line); }

void JobObserver::finish(bool completed, const std::string& reason) {
  Implementation& job = *implementation_;
  if (job.plan && !job.writing_failed) {
    if (!completed && !job.stopped) job.write_last_frame();
    job.results.add_history(job.plan->history);
  }
  job.status->finish(completed ? "Completed in " + duration_text(job.status->seconds()) : reason);
}

bool JobObserver::stopped_on_request() const { return implementation_->stopped; }

}  // namespace balocco
