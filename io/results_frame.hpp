// Writes one frame of nodal and element variables: complete or absent.
#pragma once

#include <optional>
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
    std::vector<std::int32_t> sets;  // whose members are written, not a number elsewhere; empty: the whole model
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
    std::optional<double> frequency = {};  // of a harmonic response
  };
  /// Adds the frame to an existing file. Collective. @throws SystemError on every rank alike.
  FrameRecord write(const std::string& file, const Label& label, const ResultSource& source,
                    const FrameVariables& variables) const;
  /// Adds a mode under `path`. Collective.
  FrameRecord write(const std::string& file, const std::string& path, const Mode& mode) const;

 private:
  /// A dataset to be written: values at nodes, means of elements, or values at integration points.
  struct Field {
    enum class Place { node, mean, points } place;
    std::string variable;
    std::size_t table;  // row of tables_
    int components = 0, points = 1;
    ParallelFile::Precision precision;
    std::vector<std::int32_t> sets;
    ResultPart part = {};

    int row_values() const { return place == Place::points ? points * components : components; }
    std::string name() const { return variable + (place == Place::points ? "_IP" : "") + std::string(part.suffix); }
    ParallelFile::Layout layout() const;
  };
  /// The fields of a frame that exist in this model, the same on every rank. Collective.
  std::vector<Field> plan(const ResultSource& source, const FrameVariables& variables) const;
  std::size_t bytes(const std::vector<Field>& fields) const;
  const RowExchange& exchange(const Field& field) const;
  std::vector<double> values(const Field& field) const;
  std::vector<double> nodal_values(const Field& field) const;
  std::vector<double> held_values(std::span<const double> local, int components) const;
  std::vector<double> element_values(const Field& field) const;
  /// Which rows of the field's table belong to its sets.
  std::vector<bool> members(const Field& field) const;
  FrameRecord write_fields(ParallelFile& file, const Hdf5Id& frame, const std::vector<Field>& fields) const;

  const Model* model_;
  const Communicator* communicator_;
  const Domain* domain_;
  NodeRows nodes_;
  std::vector<TableRows> tables_;
};

}  // namespace balocco
