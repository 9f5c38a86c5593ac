// Rows of a table that lie scattered over the ranks, to and from contiguous slabs in deck order, and their collective writing.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "communicator.hpp"
#include "hdf5_file.hpp"

namespace balocco {

/// Plan, made once, that carries rows between the ranks that hold them and the ranks that write them: rank r writes the r-th of
/// `size` contiguous slabs, cut at whole chunks so that no chunk has two writers.
class RowExchange {
 public:
  /// `rows`: the rows of a table of `total` that this rank holds, in the order in which it will hand over values. Collective.
  RowExchange(const Communicator& communicator, std::int64_t total, std::vector<std::int64_t> rows);

  std::int64_t total() const { return total_; }
  std::int64_t slab_begin() const { return slab_first_[rank_]; }
  std::int64_t slab_size() const { return slab_first_[rank_ + 1] - slab_first_[rank_]; }
  std::size_t held() const { return order_.size(); }

  /// Values (`columns` a row) of the rows held -> this rank's slab. Rows that nobody holds are zero. Collective.
  std::vector<double> to_slab(std::vector<double> values, int columns) const;
  /// The slab's values -> values of the rows held; several ranks may hold the same row. Collective.
  std::vector<double> from_slab(std::span<const double> slab, int columns) const;

 private:

  const Communicator* communicator_;
  std::int64_t total_;
  int rank_;
  std::vector<std::int64_t> slab_first_;     // size + 1
  std::vector<std::int32_t> order_;          // position in the outgoing message -> position among the rows held
  std::vector<std::int64_t> arriving_rows_;  // rows of the slab, in the order in which their values arrive
  std::vector<int> leaving_, arriving_;      // rows to and from each rank
};

/// A file open on all ranks together. Every function is collective, and on failure throws SystemError on every rank alike.
class ParallelFile {
 public:
  enum class Mode { create, modify, read };
  ParallelFile(const std::string& path, const Communicator& communicator, Mode mode);

  /// Writes everything out and closes.
  void close();

  hid_t root() const { return file_; }

  /// An unnamed group: nobody sees it until link() gives it a name, so what it holds is there whole or not at all.
  Hdf5Id create_unnamed_group();
  Hdf5Id create_group(hid_t parent, const std::string& name);
  /// Writes all data to disk, then links the group.
  void link(const Hdf5Id& group, const std::string& path);

  enum class Precision { single_, double_ };
  /// Dataset of all the exchange's rows (none where there are none), (rows, columns...) or (rows) if `columns` is empty, from this rank's slab.
  struct Layout {
    std::vector<hsize_t> columns;
    Precision precision = Precision::double_;
    bool compressed = true;
  };
  void write(hid_t parent, const std::string& name, const RowExchange& exchange, std::span<const double> slab,
             const Layout& layout);
  /// This rank's slab of a dataset with `columns` numbers a row.
  std::vector<double> read(const std::string& path, const RowExchange& exchange, int columns);

  void set_attribute(hid_t object, const std::string& name, double value);
  void set_attribute(hid_t object, const std::string& name, std::int64_t value);
  void set_attribute(hid_t object, const std::string& name, std::span<const double> values);

 private:
  /// Remembers the first failure. Objects are made and written by all ranks alike, so that they can go on together until agree().
  void expect(bool succeeded, const std::string& action);
  /// Throws on every rank if anything failed on any.
  void agree();

  void set_scalar(hid_t object, const std::string& name, hid_t stored, hid_t memory, const void* value);

  std::string path_;
  const Communicator* communicator_;
  Hdf5Id file_;
  std::string failure_;  // what the file could not do
};

}  // namespace balocco
