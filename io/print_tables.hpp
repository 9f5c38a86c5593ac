// JOB.dat: the tables that *NODE PRINT, *EL PRINT, *SECTION PRINT and *CONTACT PRINT ask for, and those of modes, laid out as CalculiX
// does. Flushed with every increment; a restart cuts off what is later than the checkpoint.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "communicator.hpp"
#include "constraints/nodal_directions.hpp"
#include "domain.hpp"
#include "model/results.hpp"
#include "results_schedule.hpp"

namespace balocco {

/// Of a harmonic response the tables of all real parts come before those of the imaginary parts, with the frequency for the time.
/// Every function is collective and throws SystemError on every rank alike when the file cannot be written.
class PrintTables {
 public:
  PrintTables(const Model& model, const Communicator& communicator, const Domain& domain, std::string path);

  /// Removes a file of an earlier run; a new one is made with the first table.
  void create();
  /// Continues the file that is there from the given state.
  void resume(const State& state);

  void start_step(const ResultSource& source, std::int32_t step);
  /// Prints what is due after an increment.
  void advance(const ResultSource& source, const Progress& progress);
  /// Step time at which the tables next want to be asked.
  double next_due() const;
  /// Modes are printed when their step has finished.
  void add_mode(const Mode& mode);

 private:
  /// Where a value comes from on this rank; group < 0 or local < 0: another rank has it.
  struct Place {
    std::int64_t id = 0;
    std::int32_t table = -1, row = -1;    // in the model; nodes have no table
    std::int32_t local = -1, group = -1;  // local node, or lane of an element group
  };
  struct Request {
    const PrintOutput* output;
    std::vector<Place> places;  // in the order of the deck
    Schedule schedule;
  };

  Request plan(const ResultSource& source, const PrintOutput& output) const;
  std::vector<Place> nodes_of(const PrintOutput& output) const;
  std::vector<Place> elements_of(const ResultSource& source, const PrintOutput& output) const;
  std::string nodal_table(const Request& request, const std::string& variable, std::span<const double> local,
                          double time) const;
  std::string nodal_tables(const ResultSource& source, const Request& request, double time) const;
  std::string element_tables(const ResultSource& source, const Request& request, double time) const;
  std::string tables(const ResultSource& source, const Request& request, double time) const;
  std::string table(const Request& request, const std::string& variable, const std::vector<int>& points,
                    const std::vector<double>& values, double time) const;
  double kinetic_energy(const ElementGroup& group, std::int32_t element, std::span<const double> velocity) const;
  Point coordinates(const ResultSource& source, const Place& element, int point) const;
  std::vector<double> point_values(const ResultSource& source, const Request& request, const std::string& variable,
                                   std::vector<int>& points) const;
  std::vector<double> whole_values(const ResultSource& source, const Request& request,
                                   const std::string& variable) const;
  void turn(const Request& request, const Place& element, bool is_material, std::span<double, 6> tensor) const;
  void write(const std::string& text);

  const Model& model_;
  const Communicator& communicator_;
  const Domain& domain_;
  const std::string path_;
  NodalDirections directions_;
  double time_ = 0.0;                         // total, when the step started
  std::int32_t step_ = 0, headed_step_ = -1;  // the last step that has a heading
  std::vector<Request> requests_;
  std::vector<Mode> modes_;  // their numbers alone
  std::string tables_of_modes_;
};

}  // namespace balocco
