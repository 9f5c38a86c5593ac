// The command line: reads, runs, and turns what happened into an exit status and a last line.
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <slepcsys.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "builders/car/car_builder.hpp"
#include "builders/tyre_builder.hpp"
#include "checkpoint.hpp"
#include "communicator.hpp"
#include "deck_reader.hpp"
#include "deck_writer.hpp"
#include "door.hpp"
#include "imported_mesh.hpp"
#include "info.hpp"
#include "job_observer.hpp"
#include "kept_checkpoints.hpp"
#include "materials/elastic_by_temperature.hpp"
#include "model/check.hpp"
#include "model/diagnostics.hpp"
#include "nastran_reader.hpp"
#include "procedures.hpp"
#include "restart_read.hpp"
#include "results_diff.hpp"
#include "signals.hpp"
#include "state_import.hpp"
#include "updated_stresses.hpp"

namespace balocco {
namespace {

enum ExitStatus { completed = 0, different = 1, bad_input = 2, analysis_failed = 3, stopped = 4, system_trouble = 5 };

struct Command {
  std::string deck, output = ".", last_step, spec, model_file, drive_file, kinematics_file, tyre_file, picture, results, foreign_mesh;
  CarChoices car;
  std::string other_results;
  double relative = 0.0;
  std::vector<std::string> ignored_keywords;
  bool restart = false;
  std::string import_from;
  int ranks = 1;
};

/// Reads files on the root rank and hands their text to all, so that every rank parses the same bytes.
FileLoader broadcasting_loader(const Communicator& communicator) {
  return [&communicator, load = file_loader()](const std::string& path) -> std::optional<std::string> {
    std::optional<std::string> text;
    if (communicator.is_root()) text = load(path);
    std::string message = text ? "+" + *text : "-";
    communicator.broadcast(message);
    if (message[0] == '-') return std::nullopt;
    return message.substr(1);
  };
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const auto& warning : warnings) fmt::print(stderr, "{}\n", warning);
}

JobPaths paths_of(const Command& command) { return {command.output, std::filesystem::path(command.deck).stem().string()}; }

ReadResult read_whole(const Command& command, const FileLoader& loader) {
  ReadOptions options{.ignored_keywords = command.ignored_keywords, .move_imported_nodes = {}};
  if (command.restart)
    options.move_imported_nodes = [&](Model& model) {
      move_imported_nodes(paths_of(command).checkpoint(), ImportedShape::own_coordinates, model);
    };
  else if (!command.import_from.empty())
    options.move_imported_nodes = [&](Model& model) {
      move_imported_nodes(chosen_checkpoint(command.import_from, model), ImportedShape::positions_of_other_job, model);
    };
  return read_deck(command.deck, loader, options);
}

/// *IMPORT, STATE=YES, UPDATE=YES: the stresses are those of the other job's elements in their own reference configuration.
PointStresses stresses_before_update(const std::string& path, const Analysis& updated) {
  const Model model = model_before_update(path, updated.model);
  Analysis before(model, updated.communicator);
  import_state(path, model, updated.communicator, before.domain, before.element_groups, before.current);
  return stresses_of_imported_solids(before);
}

/// Another job's state does not say at which temperatures it was left: its thermal strains stay as they are.
void refuse_temperatures(const Command& command, const Model& model) {
  if (std::ranges::none_of(model.materials, follows_temperature)) return;
  const auto is_asked = [](const std::vector<std::string>& variables) { return std::ranges::find(variables, "NT") != variables.end(); };
  const auto shows = [&](const FieldOutput& output) { return is_asked(output.node_variables); };
  const auto tells = [&](const HistoryOutput& output) {
    return std::ranges::any_of(output.nodes, [&](const auto& nodes) { return is_asked(nodes.variables); });
  };
  for (const Step& step : model.steps) {
    if (!step.temperatures.empty())
      throw InputError(fmt::format("{}: error: *TEMPERATURE: the temperatures at which {} ended are not known; a job that goes on from another "
                                   "keeps its thermal strains as they are: remove it",
                                   model.where({step.temperatures.front().file, step.temperatures.front().line}), command.import_from));
    if (std::ranges::any_of(step.field_outputs, shows) || std::ranges::any_of(step.history_outputs, tells))
      throw InputError(fmt::format("{}: error: step {}: *NODE OUTPUT: NT: the temperatures at which {} ended are not known; leave NT out",
                                   command.deck, step.name, command.import_from));
  }
}

/// Where *RESTART, READ goes on, or at time zero: whole, or what *IMPORT names.
void start_from_another_job(const Command& command, Analysis& analysis) {
  const auto arguments = [&](auto import) {
    return import(command.import_from, analysis.model, analysis.communicator, analysis.domain, analysis.element_groups, analysis.current);
  };
  if (analysis.model.restart_read) {
    arguments(read_checkpoint_of_other_deck);
  } else if (const auto& import = analysis.model.state_import; import && !import->state) {
    if (analysis.communicator.is_root())
      fmt::print("Imported from {}: the places of {} nodes, without stress\n", command.import_from, import->nodes.size());
    return;
  } else if (import) {
    if (import->update) start_from_stresses(stresses_before_update(command.import_from, analysis), analysis);
    refuse_temperatures(command, analysis.model);
    const auto summary = arguments(import_state);
    if (analysis.communicator.is_root()) fmt::print("{}\n", summary);
  } else {
    refuse_temperatures(command, analysis.model);
    arguments(import_checkpoint);
  }
  analysis.take_up_checkpoint();
}

void refuse_import_from_nowhere(const Command& command, const Model& model) {
  if (model.state_import && command.import_from.empty() && !command.restart)
    throw InputError(fmt::format("{}: error: *IMPORT: the job to start from is not said; run with --import OLD.ckpt.h5",
                                 model.where(model.state_import->location)));
  if (model.restart_read && command.import_from.empty() && !command.restart)
    throw InputError(fmt::format("{}: error: *RESTART, READ: the job to go on from is not said; run with --import OLD.ckpt.h5",
                                 model.where(model.restart_read->location)));
  if (model.restart_read && model.state_import)
    throw InputError(fmt::format("{}: error: *IMPORT: *RESTART, READ goes on with all of the other job; remove one",
                                 model.where(model.state_import->location)));
}

ExitStatus run(Command command, const Communicator& communicator) {
  auto [model, warnings] = read_whole(command, broadcasting_loader(communicator));
  if (model.steps.empty())
    throw InputError(fmt::format("{}:1: error: *STEP: the deck has no step, so there is nothing to run; add a *STEP or use "
                                 "`balocco check`", command.deck));
  if (communicator.is_root()) {
    print_warnings(warnings);
    fmt::print("Balocco {}: {} on {} rank{}, {} nodes, {} steps\n", BALOCCO_VERSION, command.deck, communicator.size(),
               communicator.size() == 1 ? "" : "s", model.nodes.size(), model.steps.size());
    std::fflush(stdout);
  }
  refuse_import_from_nowhere(command, model);
  const JobPaths paths = paths_of(command);
  if (!command.import_from.empty()) communicator.together([&] { command.import_from = chosen_checkpoint(command.import_from, model); });
  if (model.restart_read && command.restart) resume_ended_step(paths.checkpoint(), communicator, model);
  if (model.restart_read && !command.restart) prepare_restart(command.import_from, communicator, model);
  install_signal_handlers();

  Analysis analysis(model, communicator);
  if (command.restart) {
    read_checkpoint(paths.checkpoint(), model, communicator, analysis.domain, analysis.element_groups, analysis.current);
    analysis.take_up_checkpoint();
  } else if (!command.import_from.empty()) {
    start_from_another_job(command, analysis);
  }
  JobObserver observer(model, communicator, analysis.domain, paths, command.restart);
  try {
    const auto outcome = run_steps(analysis, observer, command.last_step);
    observer.finish(outcome == Outcome::finished, outcome == Outcome::finished ? "" : "stopped on request");
    return outcome == Outcome::finished ? completed : stopped;
  } catch (const AnalysisError& error) {
    observer.finish(false, error.what());
    throw;
  }
}

/// Runs a job on all ranks and reports once. Errors that every rank shares leave by the same door; trouble on a single rank takes
/// the whole job down with the same exit status, so that no rank is left behind.
int run_together(const Command& command) {
  const Communicator communicator;
  Door door(communicator);
  const auto fail = [&](ExitStatus status, const std::vector<std::string>& messages, const std::string& reason) {
    constexpr double patience = 10.0;  // seconds; ranks that share an error come within one collective
    const bool shared = door.everyone_comes(patience);
    if (communicator.is_root() || !shared) {
      std::fflush(stdout);
      print_warnings(messages);
      fmt::print(stderr, "BALOCCO FAILED: {}{}\n", shared ? "" : fmt::format("rank {}: ", communicator.rank()), reason);
    }
    if (!shared) MPI_Abort(communicator.handle(), status);
    return status;
  };
  try {
    const auto status = run(command, communicator);
    if (communicator.is_root())
      fmt::print("{}\n", status == completed ? "BALOCCO COMPLETED" : "BALOCCO FAILED: stopped on request, checkpoint written");
    return status;
  } catch (const InputError& error) {
    return fail(bad_input, error.messages(), "bad input");
  } catch (const AnalysisError& error) {
    return fail(analysis_failed, {}, error.what());
  } catch (const std::exception& error) {
    fmt::print(stderr, "BALOCCO FAILED: rank {}: {}\n", communicator.rank(), error.what());
    std::fflush(stderr);
    MPI_Abort(communicator.handle(), system_trouble);
  }
  return system_trouble;
}

int run_with_petsc(const Command& command, std::vector<char*> petsc_arguments) {
  int count = static_cast<int>(petsc_arguments.size());
  petsc_arguments.push_back(nullptr);
  char** values = petsc_arguments.data();
  if (SlepcInitialize(&count, &values, nullptr, nullptr) != 0) return system_trouble;
  PetscPopSignalHandler();  // batch signals are ours
  const int status = run_together(command);
  SlepcFinalize();
  return status;
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  if (!(file << text) || !file.flush()) throw SystemError(fmt::format("{}: cannot write this file", path));
}

int check(const Command& command) {
  const auto [model, warnings] = read_whole(command, file_loader());
  print_warnings(warnings);
  fmt::print("{}", summarize(model, command.ranks));
  return completed;
}

int build_tyre_deck(const Command& command) {
  const auto text = file_loader()(command.spec);
  if (!text) throw InputError(fmt::format("{}:1: error: no such file; give the path of a tyre description (TOML)", command.spec));
  std::string report;
  const auto built = build_tyre(*text, command.spec, file_loader(), report);
  write_text(command.model_file, write_deck(built));
  if (!command.picture.empty()) write_text(command.picture, tyre_section_svg(*text, command.spec, file_loader()));
  fmt::print("{}", report);
  return completed;
}

/// A deck, or Nastran bulk data; none: no such file.
std::optional<Model> read_mesh(const std::string& path) {
  const auto text = file_loader()(path);
  if (!text) return std::nullopt;
  return std::filesystem::path(path).extension() == ".inp" ? read_deck(path, file_loader()).model : read_nastran(*text, path).model;
}

int build_car_deck(const Command& command) {
  const auto text = file_loader()(command.spec);
  if (!text) throw InputError(fmt::format("{}:1: error: no such file; give the path of a car's description (TOML)", command.spec));
  auto choices = command.car;
  choices.inflates_one_tyre = !command.tyre_file.empty();
  const auto car = build_car(*text, command.spec, {file_loader(), read_mesh}, choices);
  const auto model = write_deck(car.tyres) + car.car;
  write_text(command.model_file, model + car.equilibrium);
  if (!command.drive_file.empty()) write_text(command.drive_file, model + car.drive);
  if (!command.tyre_file.empty()) write_text(command.tyre_file, write_deck(car.tyre) + car.inflation);
  if (!command.kinematics_file.empty()) write_text(command.kinematics_file, car.kinematics);
  fmt::print("{}", car.report);
  return completed;
}

int convert(const Command& command) {
  const auto text = file_loader()(command.foreign_mesh);
  if (!text) throw InputError(fmt::format("{}:1: error: no such file; give the path of Nastran bulk data", command.foreign_mesh));
  const auto [model, summary] = read_nastran(*text, command.foreign_mesh);
  write_text(command.model_file, write_deck(model));
  fmt::print("{}", summary);
  return completed;
}

int show_info(const Command& command) {
  fmt::print("{}", describe_results(command.results));
  return completed;
}

int show_difference(const Command& command) {
  const auto [same, text] = compare_results(command.results, command.other_results, command.relative);
  fmt::print("{}", text);
  return same ? completed : different;
}

/// Commands of one process: their errors are printed as they are.
int alone(int (*work)(const Command&), const Command& command) {
  try {
    return work(command);
  } catch (const InputError& error) {
    print_warnings(error.messages());
    fmt::print(stderr, "BALOCCO FAILED: bad input\n");
    return bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "BALOCCO FAILED: {}\n", error.what());
    return system_trouble;
  }
}

int dispatch(int argc, char** argv) {
  Command command;
  CLI::App app{"Balocco: rolls a whole car over obstacles. Implicit statics and explicit dynamics in one state."};
  app.set_version_flag("--version", BALOCCO_VERSION);
  app.require_subcommand(1);

  auto* run_command = app.add_subcommand("run", "Run a deck: mpirun -n N balocco run JOB.inp [-- PETSc options]");
  run_command->add_option("deck", command.deck, "Abaqus-style deck")->required();
  run_command->add_option("--output", command.output, "Folder of the results (made if absent)");
  auto* restart = run_command->add_flag("--restart", command.restart, "Go on from JOB.ckpt.h5 in the output folder, on any number of ranks");
  run_command->add_option("--import", command.import_from, "Start from a state of another job: its JOB.ckpt.h5 (the whole model, or what *IMPORT names)")
      ->excludes(restart);
  run_command->add_option("--until", command.last_step, "Stop after the step of this name");
  run_command->add_option("--ignore", command.ignored_keywords, "Skip this keyword with a warning (repeatable)");

  auto* check_command = app.add_subcommand("check", "Read, verify and summarise a deck");
  check_command->add_option("deck", command.deck, "Abaqus-style deck")->required();
  check_command->add_option("-n,--ranks", command.ranks, "Number of ranks to estimate balance for")->check(CLI::PositiveNumber);
  check_command->add_option("--ignore", command.ignored_keywords, "Skip this keyword with a warning (repeatable)");

  auto* tyre_command = app.add_subcommand("tyre", "Build a tyre deck from its description");
  tyre_command->add_option("spec", command.spec, "Tyre description (TOML)")->required();
  tyre_command->add_option("--output", command.model_file, "Deck to write")->required();
  tyre_command->add_option("--picture", command.picture, "Drawing of the section to write (SVG)");

  auto* car_command = app.add_subcommand("car", "Build a car deck from its description");
  car_command->add_option("spec", command.spec, "Car description (TOML)")->required();
  car_command->add_option("--output", command.model_file, "Deck of the equilibrium to write")->required();
  car_command->add_option("--drive", command.drive_file, "Deck of the drive to write, to be run with --import of the equilibrium");
  car_command->add_option("--tyre", command.tyre_file,
                          "Deck to write that seats and inflates one tyre; the equilibrium is then to be run with --import of it");
  car_command->add_option("--kinematics", command.kinematics_file, "Deck to write that moves the axles without tyres");
  car_command->add_option("--obstacle", command.car.obstacle, "Obstacle of the drive, instead of the description's: comfort, pothole or drop")
      ->check(CLI::IsMember({"comfort", "pothole", "drop"}));
  car_command->add_option("--fidelity", command.car.fidelity, "What deforms, instead of the description's: complete, semi-flexible or rigid")
      ->check(CLI::IsMember({"complete", "semi-flexible", "rigid"}));

  auto* convert_command = app.add_subcommand("convert", "Write the shells of Nastran bulk data as a deck");
  convert_command->add_option("mesh", command.foreign_mesh, "Nastran bulk data")->required();
  convert_command->add_option("--output", command.model_file, "Deck to write")->required();

  auto* info_command = app.add_subcommand("info", "Show what a result file holds");
  info_command->add_option("results", command.results, "JOB.h5")->required();

  auto* diff_command = app.add_subcommand("diff", "Say where two result files part first, and by how much");
  diff_command->add_option("A", command.results, "JOB.h5")->required();
  diff_command->add_option("B", command.other_results, "JOB.h5 of another run")->required();
  diff_command
      ->add_option("--relative", command.relative, "Differences up to this part of a variable's largest value are none (default: 0)")
      ->check(CLI::NonNegativeNumber);

  // Everything behind "--" belongs to PETSc.
  const auto end = std::find(argv + 1, argv + argc, std::string_view("--"));
  std::vector<char*> petsc_arguments{argv[0]};
  petsc_arguments.insert(petsc_arguments.end(), std::min(end + 1, argv + argc), argv + argc);
  try {
    app.parse(static_cast<int>(end - argv), argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? completed : bad_input;
  }
  if (*run_command) return run_with_petsc(command, petsc_arguments);
  if (*check_command) return alone(check, command);
  if (*diff_command) return alone(show_difference, command);
  if (*tyre_command) return alone(build_tyre_deck, command);
  if (*car_command) return alone(build_car_deck, command);
  if (*convert_command) return alone(convert, command);
  return alone(show_info, command);
}

}  // namespace
}  // namespace balocco

int main(int argc, char** argv) { return balocco::dispatch(argc, argv); }
