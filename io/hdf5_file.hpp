// HDF5 in the few verbs that results and checkpoints need. Identifiers close themselves; every failure becomes a SystemError
// that names the file. No object carries a time stamp, so that equal data make equal files.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "communicator.hpp"

namespace balocco {

/// Owns an HDF5 identifier of any kind.
class Hdf5Id {
 public:
  Hdf5Id() = default;
  explicit Hdf5Id(hid_t id) : id_(id) {}
  Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Hdf5Id& operator=(Hdf5Id&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Hdf5Id();
  operator hid_t() const { return id_; }
  bool valid() const { return id_ >= 0; }
  /// Closes now. @return false if HDF5 reported an error (a file: what was buffered may not have been written).
  bool close();

 private:
  hid_t id_ = -1;
};

/// Rows, columns ... of a dataset.
using Extent = std::vector<hsize_t>;

/// A file open in this process alone, to be used by one rank at a time.
class Hdf5File {
 public:
  enum class Mode { create, modify, read };
  /// @throws SystemError. `create` replaces an existing file.
  Hdf5File(const std::string& path, Mode mode);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// Writes everything out and closes. @throws SystemError if that fails (disk full). The destructor closes silently.
  void close();

  bool exists(const std::string& path) const;  // every group on the way is looked for, too
  bool is_group(const std::string& path) const;
  void create_group(const std::string& path) const;
  void remove(const std::string& path) const;
  /// Names in a group, those that end in numbers by number.
  std::vector<std::string> children(const std::string& path) const;

  void set_attribute(const std::string& object, const std::string& name, const std::string& value) const;
  void set_attribute(const std::string& object, const std::string& name, double value) const;
  void set_attribute(const std::string& object, const std::string& name, std::int64_t value) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;
  double number_attribute(const std::string& object, const std::string& name) const;
  std::int64_t integer_attribute(const std::string& object, const std::string& name) const;

  /// No values make no dataset: tools such as h5diff stumble over empty ones.
  void write(const std::string& path, const Extent& shape, std::span<const double> values) const;
  void write(const std::string& path, const Extent& shape, std::span<const std::int32_t> values) const;
  void write(const std::string& path, const Extent& shape, std::span<const std::int64_t> values) const;
  Extent extent(const std::string& path) const;
  std::size_t bytes_per_value(const std::string& path) const;
  std::vector<double> read(const std::string& path) const;
  std::vector<std::int64_t> read_integers(const std::string& path) const;

  /// Adds rows to a dataset that grows (rows, or rows x columns where `columns` > 1); made when it is not there.
  void append(const std::string& path, int columns, std::span<const double> values) const;
  /// Cuts a growing dataset to its first `rows`.
  void truncate(const std::string& path, hsize_t rows) const;

 private:
  [[noreturn]] void fail(const std::string& action) const;
  void write_values(const std::string& path, const Extent& shape, hid_t stored, hid_t memory, const void* values) const;
  void set_scalar(const std::string& object, const std::string& name, hid_t stored, hid_t memory, const void* value) const;
  void get_scalar(const std::string& object, const std::string& name, hid_t memory, void* value) const;

  std::string path_;
  Hdf5Id file_;
};

/// Opens a file of Balocco to be read. @throws InputError if there is none, or it is not one or not whole.
std::unique_ptr<Hdf5File> open_existing(const std::string& path);

/// Properties of objects that all files share.
Hdf5Id group_properties();                                                  // no time stamps
Hdf5Id dataset_properties(const Extent& shape, std::size_t value_size, bool compressed);  // no time stamps; chunks, shuffle, gzip 1

/// Rows in a chunk of a dataset whose rows hold `row_values` numbers: depends on nothing but the data.
hsize_t chunk_rows(hsize_t rows);

/// Writes a file's data and directory entry through to the disk. @throws SystemError.
void synchronize(const std::string& path);

/// Makes sure that `path` can grow by `bytes`. Asked before every collective write, because ranks on which HDF5 fails leave it
/// early and would keep the others waiting. @throws SystemError.
void ensure_space(const std::string& path, std::size_t bytes);

/// Turns off HDF5's own error prints, once per process.
void silence_hdf5();

}  // namespace balocco
