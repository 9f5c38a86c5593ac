// What stands in a results file: its blocks of elements and its frames. Names of groups in one place.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hdf5_file.hpp"
#include "model/step.hpp"

namespace balocco {

/// "/step_<k>", k = step + 1; "/step_<k>/frame_<i>".
std::string step_path(std::int32_t step);
std::string frame_path(std::int32_t step, std::int64_t frame);
std::string mode_path(std::int32_t step, std::int32_t mode);

/// The dataset of a history group that says where its rows stand: times, of harmonic responses frequencies.
std::string history_axis(const Step& step);
/// The same of a group in a file; empty where it has none.
std::string history_axis(const Hdf5File& file, const std::string& group);

/// A name of the deck as a name in the file: HDF5 takes anything but '/'.
std::string hdf5_name(std::string name);

/// A dataset of a frame.
struct FieldRecord {
  std::string name;      // U, S, ...
  Extent extent;         // rows, or rows x columns, or rows x points x columns
  std::size_t bytes = 4;  // per value
};

/// Variables on the nodes, or on the elements of one type.
struct FieldBlock {
  std::string type;  // empty: nodes
  std::vector<FieldRecord> fields;
};

struct FrameRecord {
  std::string path;
  double time = 0.0;  // total
  std::int64_t increment = 0;
  std::optional<double> frequency;  // of a harmonic response
  FieldBlock nodes;
  std::vector<FieldBlock> elements;
};

/// Elements of one type in /mesh/element.
struct MeshBlock {
  std::string type;
  hsize_t elements = 0, nodes_per_element = 0;
};

struct ResultsIndex {
  hsize_t nodes = 0;
  std::vector<MeshBlock> blocks;
  std::vector<FrameRecord> frames;  // in time order
  std::vector<FrameRecord> modes;   // of all frequency steps; their time is their number, from 1
};

/// Fields by name: one order, whether they were just written or read back.
void sort_fields(FieldBlock& block);

/// Opens a results file to be read. @throws InputError that says what the file is instead: absent, cut off, a checkpoint ...
std::unique_ptr<Hdf5File> open_results(const std::string& path);

/// Reads the index of a file. @throws SystemError.
ResultsIndex index_results(const Hdf5File& file);

/// Number in a name such as "frame_12", or -1 where the name does not begin with `prefix`.
std::int64_t number_in(const std::string& name, const std::string& prefix);

}  // namespace balocco
