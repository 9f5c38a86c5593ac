// Writes one frame of nodal and element variables: complete or absent.
#pragma once

#include <string>
#include <vector>

#include "hdf5_model_rows.hpp"
#include "hdf5_rows.hpp"
#include "model/results.hpp"
#include "results_index.hpp"

namespace balocco {

/// What a frame holds: the variables of all requests that are due together.
struct FrameVariables {
  struct Variable {
    std::string name;
    ParallelFile::Precision precision;
  };
  std::vector<Variable> nodes, elements, integration_points;

  void add(const FieldOutput& output);
  bool empty() const { return nodes.empty() && elements.empty() && integration_points.empty(); }
};

class FrameWriter {
 public:
  FrameWriter(const Model& model, const Communicator& communicator, const Domain& domain, ElementGroups groups);

  struct Label {
    std::string path;  // of the frame in the file
    double time = 0.0, step_time = 0.0;
    std::int64_t increment = 0;
  };
  /// Adds the frame to an existing file. Collective. @throws SystemError on every rank alike.
  FrameRecord write(const std::string& file, const Label& label, const ResultSource& source,
                    const FrameVariables& variables) const;

 private:
  enum class Points { mean, each };
  struct Target {
    ParallelFile& file;
    const Hdf5Id& frame;
  };
  FieldBlock write_nodes(const Target& target, const ResultSource& source, const FrameVariables& variables) const;
  FieldBlock write_table(const Target& target, const TableRows& rows, const ResultSource& source,
                         const FrameVariables& variables) const;
  std::vector<double> element_values(const TableRows& rows, const ResultSource& source, const std::string& variable,
                                     Points points, int row_values, int columns) const;

  const Model* model_;
  const Communicator* communicator_;
  std::int32_t local_nodes_;
  NodeRows nodes_;
  std::vector<TableRows> tables_;
};

/// Mean over the integration points of one element; `values` has a component each.
void mean_output(const ElementGroup& group, std::string_view variable, std::int32_t element, const State& state,
                 std::size_t group_index, std::span<double> values);

}  // namespace balocco
