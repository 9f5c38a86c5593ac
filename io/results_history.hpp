// History: rows of chosen quantities over time (of harmonic responses over frequency), buffered in memory and appended to
// /step_<k>/history/<GROUP>. Where a set of one node or element asks, the group's attribute `set` is that set's name.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "communicator.hpp"
#include "domain.hpp"
#include "hdf5_file.hpp"
#include "model/results.hpp"
#include "results_schedule.hpp"

namespace balocco {

class History {
 public:
  /// The history requests of one step. A group that several requests name gets a row whenever any of them is due. `complaints`
  /// receives a warning for each variable that nothing in the model has. Collective.
  History(const Model& model, const Communicator& communicator, const Domain& domain, const ResultSource& source,
          std::int32_t step, std::vector<std::string>& complaints);

  /// True if flush() has something to write. Root only.
  bool buffered() const;
  /// Forgets the marks up to here without a row: a restart.
  void pass(double step_time);
  /// Adds rows to the buffers of all groups that are due (`all`: of all groups). Collective.
  void sample(const ResultSource& source, const Progress& progress, bool all);
  double next_due() const;

  /// Appends the buffered rows to the file and empties the buffers. Root only.
  void flush(const Hdf5File& file);

 private:
  struct Builder;
  class Row;
  enum class Kind { energy, nodal, element, contact };
  struct Channel {
    Kind kind;
    std::string name;       // in the file
    std::string variable;   // what the source is asked for
    int first = 0;          // component
    int columns = 1;
    int source_columns = 1;        // components of `variable`
    std::int32_t place = -1;       // local node if owned, lane of an element if here, contact pair
    std::size_t group_index = 0;   // of the element group
    std::size_t part = 0;          // of ResultSource::parts()
    std::vector<double> rows = {};  // root: buffered
  };
  struct Group {
    std::string name;
    std::string set;               // node or element set that asks for this node or element alone
    std::vector<std::size_t> requests;
    std::vector<Channel> channels;
    std::vector<double> axis;      // root: times or frequencies, buffered
  };

  Group& group(const std::string& name, std::size_t request);
  void fill(const Channel& channel, Row& row, double* values) const;

  const Model* model_;
  const Communicator* communicator_;
  std::int32_t step_;
  std::int32_t local_nodes_;
  std::vector<Schedule> schedules_;       // per request
  std::vector<Group> groups_;
};

/// Cuts off all rows of a step that are later than `time` (total).
void cut_history(const Hdf5File& file, std::int32_t step, double time);

}  // namespace balocco
