#include "hdf5_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "model/diagnostics.hpp"

namespace balocco {

namespace {

std::vector<int> starts(const std::vector<int>& counts) {
  std::vector<int> first(counts.size(), 0);
  std::partial_sum(counts.begin(), counts.end() - 1, first.begin() + 1);
  return first;
}

/// First rows of the slabs: whole chunks, as even as they go.
std::vector<std::int64_t> cut_slabs(std::int64_t total, int parts) {
  const auto chunk = static_cast<std::int64_t>(chunk_rows(static_cast<hsize_t>(std::max<std::int64_t>(total, 1))));
  const std::int64_t chunks = (total + chunk - 1) / chunk;
  std::vector<std::int64_t> first(parts + 1);
  for (int part = 0; part <= parts; ++part) first[part] = std::min(total, chunks * part / parts * chunk);
  return first;
}

Extent extent_of(std::int64_t rows, const std::vector<hsize_t>& columns) {
  Extent extent{static_cast<hsize_t>(rows)};
  extent.insert(extent.end(), columns.begin(), columns.end());
  return extent;
}

Hdf5Id collective_transfer() {
  Hdf5Id properties(H5Pcreate(H5P_DATASET_XFER));
  H5Pset_dxpl_mpio(properties, H5FD_MPIO_COLLECTIVE);
  return properties;
}

/// Selects this rank's rows in the file, and as many in memory; both select nothing where the slab is empty.
Hdf5Id select_slab(hid_t stored, const RowExchange& exchange, const Extent& total) {
  Extent count = total, start(total.size(), 0);
  count[0] = static_cast<hsize_t>(exchange.slab_size());
  start[0] = static_cast<hsize_t>(exchange.slab_begin());
  Hdf5Id memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr));
  if (exchange.slab_size() > 0) {
    H5Sselect_hyperslab(stored, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  } else {
    H5Sselect_none(stored);
    H5Sselect_none(memory);
  }
  return memory;
}

/// Whole rows travel, so that what is counted (in int) are rows and not their values.
void exchange_rows(const std::vector<double>& outgoing, const std::vector<int>& leaving, std::vector<double>& incoming,
                   const std::vector<int>& arriving, int columns, const Communicator& communicator) {
  MPI_Datatype row;
  MPI_Type_contiguous(columns, MPI_DOUBLE, &row);
  MPI_Type_commit(&row);
  MPI_Alltoallv(outgoing.data(), leaving.data(), starts(leaving).data(), row, incoming.data(), arriving.data(),
                starts(arriving).data(), row, communicator.handle());
  MPI_Type_free(&row);
}

}  // namespace

RowExchange::RowExchange(const Communicator& communicator, std::int64_t total, std::vector<std::int64_t> rows)
    : communicator_(&communicator), total_(total), rank_(communicator.rank()), order_(rows.size()) {
  const int ranks = communicator.size();
  slab_first_ = cut_slabs(total, ranks);
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](auto a, auto b) { return std::pair(rows[a], a) < std::pair(rows[b], b); });
  std::vector<std::int64_t> sorted(rows.size());
  leaving_.assign(ranks, 0);
  arriving_.assign(ranks, 0);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    sorted[i] = rows[order_[i]];
    const auto after = std::upper_bound(slab_first_.begin(), slab_first_.end(), sorted[i]);
    ++leaving_[after - slab_first_.begin() - 1];
  }
  MPI_Alltoall(leaving_.data(), 1, MPI_INT, arriving_.data(), 1, MPI_INT, communicator.handle());
  arriving_rows_.resize(std::accumulate(arriving_.begin(), arriving_.end(), std::size_t{0}));
  const auto leaving_first = starts(leaving_), arriving_first = starts(arriving_);
  MPI_Alltoallv(sorted.data(), leaving_.data(), leaving_first.data(), MPI_INT64_T, arriving_rows_.data(), arriving_.data(),
                arriving_first.data(), MPI_INT64_T, communicator.handle());
  for (auto& row : arriving_rows_) row -= slab_begin();
}

// Each copy of the values goes when the next is there: they may be a good part of the model.
std::vector<double> RowExchange::to_slab(std::vector<double> values, int columns) const {
  std::vector<double> outgoing(order_.size() * columns);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(order_[i]) * columns, columns, outgoing.begin() + i * columns);
  }
  values = {};
  std::vector<double> incoming(arriving_rows_.size() * columns);
  exchange_rows(outgoing, leaving_, incoming, arriving_, columns, *communicator_);
  outgoing = {};
  std::vector<double> slab(slab_size() * columns, 0.0);
  for (std::size_t i = 0; i < arriving_rows_.size(); ++i) {
    std::copy_n(incoming.begin() + i * columns, columns, slab.begin() + arriving_rows_[i] * columns);
  }
  return slab;
}

std::vector<double> RowExchange::from_slab(std::span<const double> slab, int columns) const {
  std::vector<double> outgoing(arriving_rows_.size() * columns), incoming(order_.size() * columns);
  for (std::size_t i = 0; i < arriving_rows_.size(); ++i) {
    std::copy_n(slab.begin() + arriving_rows_[i] * columns, columns, outgoing.begin() + i * columns);
  }
  exchange_rows(outgoing, arriving_, incoming, leaving_, columns, *communicator_);
  std::vector<double> values(order_.size() * columns);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    std::copy_n(incoming.begin() + i * columns, columns, values.begin() + static_cast<std::ptrdiff_t>(order_[i]) * columns);
  }
  return values;
}

ParallelFile::ParallelFile(const std::string& path, const Communicator& communicator, Mode mode)
    : path_(path), communicator_(&communicator) {
  silence_hdf5();
  const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_fapl_mpio(access, communicator.handle(), MPI_INFO_NULL);
  H5Pset_file_locking(access, false, true);  // somebody who looks at the results must not stop the job
  if (mode == Mode::create) {
    file_ = Hdf5Id(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access));
  } else {
    file_ = Hdf5Id(H5Fopen(path.c_str(), mode == Mode::read ? H5F_ACC_RDONLY : H5F_ACC_RDWR, access));
  }
  expect(file_.valid(), mode == Mode::create ? "be created" : "be opened");
  agree();
}

void ParallelFile::expect(bool succeeded, const std::string& action) {
  if (!succeeded && failure_.empty()) failure_ = action;
}

void ParallelFile::agree() {
  if (!communicator_->any(!failure_.empty())) return;
  communicator_->together([&] {
    if (!failure_.empty()) throw SystemError(fmt::format("{}: file cannot {}", path_, failure_));
  });
}

void ParallelFile::close() {
  const bool flushed = H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
  const bool closed = file_.close();
  expect(flushed && closed, "be written (disk full?)");
  agree();
}

Hdf5Id ParallelFile::create_unnamed_group() {
  Hdf5Id group(H5Gcreate_anon(file_, group_properties(), H5P_DEFAULT));
  expect(group.valid(), "take a new group");
  return group;
}

Hdf5Id ParallelFile::create_group(hid_t parent, const std::string& name) {
  Hdf5Id group(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, group_properties(), H5P_DEFAULT));
  expect(group.valid(), "take the group " + name);
  return group;
}

void ParallelFile::link(const Hdf5Id& group, const std::string& path) {
  expect(H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0, "be written (disk full?)");
  agree();
  expect(H5Olink(group, file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0, "take the group " + path);
}

void ParallelFile::write(hid_t parent, const std::string& name, const RowExchange& exchange, std::span<const double> slab,
                         const Layout& layout) {
  if (exchange.total() == 0) return;
  const bool single = layout.precision == Precision::single_;
  const hid_t stored_type = single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
  const Extent total = extent_of(exchange.total(), layout.columns);
  const Hdf5Id space(H5Screate_simple(static_cast<int>(total.size()), total.data(), nullptr));
  const Hdf5Id properties = dataset_properties(total, single ? 4 : 8, layout.compressed);
  const Hdf5Id dataset(H5Dcreate2(parent, name.c_str(), stored_type, space, H5P_DEFAULT, properties, H5P_DEFAULT));
  expect(dataset.valid(), "take " + name);
  const Hdf5Id memory = select_slab(space, exchange, total);
  // Converted here: a type conversion inside HDF5 would make the write independent, which compressed data forbid.
  const std::vector<float> narrowed = single ? std::vector<float>(slab.begin(), slab.end()) : std::vector<float>();
  const void* values = single ? static_cast<const void*>(narrowed.data()) : slab.data();
  const herr_t status =
      H5Dwrite(dataset, single ? H5T_NATIVE_FLOAT : H5T_NATIVE_DOUBLE, memory, space, collective_transfer(), values);
  expect(status >= 0, "take " + name + " (disk full?)");
}

std::vector<double> ParallelFile::read(const std::string& path, const RowExchange& exchange, int columns) {
  if (exchange.total() == 0) return {};
  const Hdf5Id dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT));
  expect(dataset.valid(), "give " + path);
  agree();
  const Hdf5Id space(H5Dget_space(dataset));
  Extent total(H5Sget_simple_extent_ndims(space));
  H5Sget_simple_extent_dims(space, total.data(), nullptr);
  hsize_t stored_columns = 1;
  for (std::size_t i = 1; i < total.size(); ++i) stored_columns *= total[i];
  expect(total[0] == static_cast<hsize_t>(exchange.total()) && stored_columns == static_cast<hsize_t>(columns),
         fmt::format("give {}: its size does not fit this model", path));
  agree();
  std::vector<double> slab(exchange.slab_size() * columns);
  const Hdf5Id memory = select_slab(space, exchange, total);
  const herr_t status = H5Dread(dataset, H5T_NATIVE_DOUBLE, memory, space, collective_transfer(), slab.data());
  expect(status >= 0, "give " + path);
  agree();
  return slab;
}

void ParallelFile::set_scalar(hid_t object, const std::string& name, hid_t stored, hid_t memory, const void* value) {
  const Hdf5Id space(H5Screate(H5S_SCALAR));
  const Hdf5Id attribute(H5Acreate2(object, name.c_str(), stored, space, H5P_DEFAULT, H5P_DEFAULT));
  expect(attribute.valid() && H5Awrite(attribute, memory, value) >= 0, "take attribute " + name);
}

void ParallelFile::set_attribute(hid_t object, const std::string& name, double value) {
  set_scalar(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void ParallelFile::set_attribute(hid_t object, const std::string& name, std::int64_t value) {
  set_scalar(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

void ParallelFile::set_attribute(hid_t object, const std::string& name, std::span<const double> values) {
  const hsize_t size = values.size();
  const Hdf5Id space(H5Screate_simple(1, &size, nullptr));
  const Hdf5Id attribute(H5Acreate2(object, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT));
  expect(attribute.valid() && H5Awrite(attribute, H5T_NATIVE_DOUBLE, values.data()) >= 0, "take attribute " + name);
}

}  // namespace balocco
