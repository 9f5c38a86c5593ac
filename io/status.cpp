#include "status.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <span>

#include "elements/element_type.hpp"
#include "materials/material_option.hpp"
#include "model/diagnostics.hpp"
#include "model/rigid_constraints.hpp"

namespace balocco {

namespace {

constexpr double seconds_between_shows = 0.25;

std::FILE* open_text(const std::string& path, bool append) {
  std::FILE* file = std::fopen(path.c_str(), append ? "a" : "w");
  if (file == nullptr) throw SystemError(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
  return file;
}

/// Whether somebody watches. Open MPI gives its ranks a terminal of its own even where mpirun writes to a file, so that the
/// parent's output has to be one, too.
bool watched() {
  if (::isatty(STDOUT_FILENO) != 1) return false;
  const int parent = ::open(fmt::format("/proc/{}/fd/1", ::getppid()).c_str(), O_WRONLY | O_NOCTTY | O_NONBLOCK);
  const bool terminal = parent >= 0 && ::isatty(parent) == 1;
  if (parent >= 0) ::close(parent);
  return terminal;
}

/// Change of ETOTAL since the step started, in percent of the largest energy of the step; 0 where it is what rounding makes.
double energy_error(const State& state, const EnergyBalance& energies, double negligible) {
  const double change = energies.total - state.energy_at_start;
  return std::abs(change) > negligible ? 100.0 * change / std::max(state.largest_energy, energies.magnitude()) : 0.0;
}

}  // namespace

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  const auto whole = static_cast<long long>(seconds + 0.5);
  if (whole < 60) return fmt::format("{:.1f} s", seconds);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

Status::Status(const std::string& status_path, const std::string& log_path, const Model& model, bool restarted, bool root)
    : model_(&model), root_(root), terminal_(watched()), begin_(std::chrono::steady_clock::now()) {
  if (!root_) return;
  status_ = open_text(status_path, restarted);
  log_ = open_text(log_path, restarted);
  const auto body_of = lasting_bodies(model);
  for (const ElementTable& table : model.elements) {
    const auto nodes = static_cast<std::size_t>(table.type->nodes);
    for (std::int32_t row = 0; row < table.size() && table.type->make_group != nullptr; ++row)
      element_count_ += rests_for_good(std::span(table.connectivity).subspan(row * nodes, nodes), body_of) ? 0 : 1;
  }
  for (const Material& material : model.materials) can_fail_ |= find_option(material, "shear-failure") != nullptr;
  for (const Step& step : model.steps)
    if (const auto* procedure = std::get_if<ExplicitProcedure>(&step.procedure))
      scales_masses_ |= !procedure->fixed_mass_scaling.empty() || !procedure->variable_mass_scaling.empty();
  const std::string title = model.heading.empty() ? model.name : fmt::format("{}: {}", model.name, model.heading);
  line(status_, restarted ? "Restarted" : "Balocco " BALOCCO_VERSION ", " + title);
}

Status::~Status() {
  if (status_ != nullptr) std::fclose(status_);
  if (log_ != nullptr) std::fclose(log_);
}

double Status::seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

void Status::line(std::FILE* file, const std::string& text) {
  std::fprintf(file, "%s\n", text.c_str());
  std::fflush(file);
}

void Status::start_step(std::int32_t step, const State& state) {
  step_ = step;
  step_begin_seconds_ = seconds();
  step_begin_time_ = state.step_time;
  step_begin_increment_ = state.increment;
  const Step& what = model_->steps[step];
  shown_twentieth_ = what.duration() > 0.0 ? static_cast<int>(20.0 * state.step_time / what.duration() + 1e-9) : 0;
  if (!root_) return;
  line(status_, fmt::format("\nStep {} {}: {}, {:g} time units", step + 1, what.name, what.procedure_name(),
                            what.duration()));
  if (what.is_harmonic()) {
    line(status_, fmt::format("{:>6} {:>13} {:>13} {:>10}", "INC", "FREQUENCY", "LARGEST U", "WALL S"));
  } else if (what.has_few_increments()) {
    line(status_, fmt::format("{:>6} {:>6} {:>13} {:>13} {:>13} {:>11} {:>13} {:>13} {:>10}", "INC", "ITERS", "STEP TIME",
                              "TOTAL TIME", "TIME INC", "RESIDUAL", "ALLWK", "ALLIE", "WALL S"));
  } else {
    line(status_,
         fmt::format("{:>9} {:>13} {:>13} {:>12} {:>10} {:>12} {:>12} {:>12} {:>12} {:>12} {:>12} {:>9} {:>11} {:>9} {:>9} {:>10}",
                     "INC", "STEP TIME", "TOTAL TIME", "TIME INC", "ELEMENT", "ALLKE", "ALLIE", "ALLAE", "ALLCW", "ALLWK", "ETOTAL",
                     "ERROR %", "PENETRATION", "WALL S", "LEFT S", "ELEM/S") +
             (can_fail_ ? fmt::format(" {:>9}", "DELETED") : "") + (scales_masses_ ? fmt::format(" {:>12}", "ADDED MASS %") : ""));
  }
}

Status::Outlook Status::outlook(const Progress& progress) const {
  const double duration = model_->steps[step_].duration();
  const double elapsed = seconds() - step_begin_seconds_;
  const double done = progress.step_time - step_begin_time_;
  const auto increments = static_cast<double>(progress.increment - step_begin_increment_);
  Outlook outlook;
  outlook.fraction = duration > 0.0 ? progress.step_time / duration : 1.0;
  outlook.remaining = done > 0.0 ? std::max(0.0, elapsed * (duration - progress.step_time) / done) : 0.0;
  outlook.elements_per_second = elapsed > 0.0 ? static_cast<double>(element_count_) * increments / elapsed : 0.0;
  return outlook;
}

void Status::static_line(const Progress& progress, double work, double internal) {
  if (!root_) return;
  line(status_, fmt::format("{:>6} {:>6} {:>13.6g} {:>13.6g} {:>13.6g} {:>11.3e} {:>13.6g} {:>13.6g} {:>10.2f}", progress.increment,
                            progress.iterations, progress.step_time, progress.total_time, progress.time_increment,
                            progress.largest_residual, work, internal, seconds()));
}

void Status::harmonic_line(const Progress& progress) {
  if (!root_) return;
  line(status_, fmt::format("{:>6} {:>13.6g} {:>13.6g} {:>10.2f}", progress.increment, progress.frequency, progress.largest_displacement, seconds()));
}

void Status::explicit_line(const Progress& progress, const State& state, const EnergyBalance& energies) {
  if (!root_) return;
  const Outlook view = outlook(progress);
  line(status_, fmt::format("{:>9} {:>13.6g} {:>13.6g} {:>12.5g} {:>10} {:>12.5g} {:>12.5g} {:>12.5g} {:>12.5g} {:>12.5g} {:>12.5g} "
                            "{:>9.4f} {:>11.4g} {:>9.1f} {:>9.0f} {:>10.4g}",
                            progress.increment, progress.step_time, progress.total_time, progress.time_increment,
                            progress.critical_element, energies.kinetic, energies.internal, energies.hourglass, energies.contact,
                            energies.work, energies.total, energy_error(state, energies, progress.negligible_energy), progress.largest_penetration, seconds(),
                            view.remaining, view.elements_per_second) +
                    (can_fail_ ? fmt::format(" {:>9}", progress.deleted_elements) : "") +
                    (scales_masses_ ? fmt::format(" {:>12.5g}", 100.0 * progress.added_mass) : ""));
  if (progress.deleted_elements == deleted_elements_) return;
  deleted_elements_ = progress.deleted_elements;
  log(fmt::format("{} elements deleted until increment {}, time {:.6g}", deleted_elements_, progress.increment, progress.total_time));
}

void Status::show(const Progress& progress, bool now) {
  if (!root_) return;
  const Outlook view = outlook(progress);
  const int twentieth = static_cast<int>(20.0 * view.fraction + 1e-9);
  const bool due = terminal_ ? seconds() - shown_seconds_ >= seconds_between_shows : twentieth > shown_twentieth_;
  if (!due && !now && !progress.step_finished) return;
  shown_seconds_ = seconds();
  shown_twentieth_ = std::max(shown_twentieth_, twentieth);
  const Step& step = model_->steps[step_];
  std::string text = fmt::format("Step {} {}: ", step_ + 1, step.name);
  text += step.is_harmonic() ? fmt::format("frequency {:.6g}, largest displacement {:.4g}", progress.frequency, progress.largest_displacement)
                             : fmt::format("{:3.0f} %, increment {}, time {:.6g} of {:g}, dt {:.4g}", 100.0 * view.fraction, progress.increment,
                                           progress.step_time, step.duration(), progress.time_increment);
  if (!step.has_few_increments())
    text += fmt::format(", {:.3g} elements/s, {} left", view.elements_per_second, duration_text(view.remaining));
  else if (!step.is_harmonic())
    text += fmt::format(", {} iterations", progress.iterations);
  if (terminal_) {
    std::printf("\r\033[K%s%s", text.c_str(), progress.step_finished ? "\n" : "");
    line_open_ = !progress.step_finished;
  } else {
    std::printf("%s\n", text.c_str());
  }
  std::fflush(stdout);
}

void Status::log(const std::string& text) {
  if (!root_) return;
  line(log_, text);
  if (text.find("warning:") == std::string::npos && text.find("error:") == std::string::npos) return;
  std::printf("%s%s\n", line_open_ ? "\r\033[K" : "", text.c_str());
  std::fflush(stdout);
  line_open_ = false;
}

void Status::finish(const std::string& text) {
  if (!root_) return;
  if (line_open_) std::printf("\n");
  line_open_ = false;
  std::fflush(stdout);
  line(status_, "\n" + text);
  line(log_, text);
}

}  // namespace balocco
