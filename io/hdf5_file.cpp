#include "hdf5_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "model/diagnostics.hpp"

namespace balocco {

namespace {

constexpr hsize_t history_chunk_rows = 1024;

Hdf5Id link_properties() {
  Hdf5Id properties(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(properties, 1);
  return properties;
}

Hdf5Id space_of(const Extent& shape) {
  return Hdf5Id(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr));
}

herr_t add_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->push_back(name);
  return 0;
}

/// The number at the end of a name, or -1.
long trailing_number(const std::string& name) {
  const auto digits = name.find_last_not_of("0123456789") + 1;
  return digits == name.size() || name.size() - digits > 9 ? -1 : std::stol(name.substr(digits));
}

bool by_number(const std::string& a, const std::string& b) {
  return std::pair(trailing_number(a), a) < std::pair(trailing_number(b), b);
}

}  // namespace

void silence_hdf5() {
  static const herr_t once = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  static_cast<void>(once);
}

Hdf5Id::~Hdf5Id() { close(); }

bool Hdf5Id::close() {
  const hid_t id = std::exchange(id_, -1);
  if (id < 0) return true;
  switch (H5Iget_type(id)) {
    case H5I_FILE: return H5Fclose(id) >= 0;
    case H5I_GROUP: return H5Gclose(id) >= 0;
    case H5I_DATATYPE: return H5Tclose(id) >= 0;
    case H5I_DATASPACE: return H5Sclose(id) >= 0;
    case H5I_DATASET: return H5Dclose(id) >= 0;
    case H5I_ATTR: return H5Aclose(id) >= 0;
    default: return H5Pclose(id) >= 0;
  }
}

Hdf5Id group_properties() {
  Hdf5Id properties(H5Pcreate(H5P_GROUP_CREATE));
  H5Pset_obj_track_times(properties, false);
  return properties;
}

hsize_t chunk_rows(hsize_t rows) { return std::min<hsize_t>(rows, 8192); }

Hdf5Id dataset_properties(const Extent& shape, std::size_t value_size, bool compressed) {
  Hdf5Id properties(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_obj_track_times(properties, false);
  if (compressed && std::find(shape.begin(), shape.end(), 0) == shape.end()) {
    Extent chunk = shape;
    chunk[0] = chunk_rows(shape[0]);
    H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
    if (value_size > 1) H5Pset_shuffle(properties);
    H5Pset_deflate(properties, 1);
  }
  return properties;
}

void synchronize(const std::string& path) {
  for (const std::string& name : {path, std::filesystem::absolute(path).parent_path().string()}) {
    const int descriptor = ::open(name.c_str(), O_RDONLY);
    // Some file systems refuse to synchronise directories: only the file itself has to succeed.
    const bool done = descriptor >= 0 && (::fsync(descriptor) == 0 || name != path);
    const int reason = errno;
    if (descriptor >= 0) ::close(descriptor);
    if (!done) throw SystemError(fmt::format("{}: cannot write to disk: {}", path, std::strerror(reason)));
  }
}

void ensure_space(const std::string& path, std::size_t bytes) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT, 0666);
  if (file < 0) throw SystemError(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
  const off_t size = ::lseek(file, 0, SEEK_END);
  int reason = ::fallocate(file, 0, size, static_cast<off_t>(bytes)) == 0 ? 0 : errno;
  if (::ftruncate(file, size) != 0 && reason == 0) reason = errno;
  ::close(file);
  if (reason == EOPNOTSUPP) {  // the file system cannot reserve: ask how much is free
    const auto folder = std::filesystem::absolute(path).parent_path();
    reason = std::filesystem::space(folder).available < bytes ? ENOSPC : 0;
  }
  if (reason != 0) {
    throw SystemError(fmt::format("{}: no room for {:.1f} MB more: {}", path, 1e-6 * static_cast<double>(bytes), std::strerror(reason)));
  }
}

Hdf5File::Hdf5File(const std::string& path, Mode mode) : path_(path) {
  silence_hdf5();
  const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_file_locking(access, false, true);  // somebody who looks at the results must not stop the job
  if (mode == Mode::create) {
    file_ = Hdf5Id(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access));
  } else {
    file_ = Hdf5Id(H5Fopen(path.c_str(), mode == Mode::read ? H5F_ACC_RDONLY : H5F_ACC_RDWR, access));
  }
  if (!file_.valid()) fail(mode == Mode::create ? "be created" : "be opened");
}

Hdf5File::~Hdf5File() = default;

void Hdf5File::close() {
  const bool flushed = H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
  if (!file_.close() || !flushed) fail("be written (disk full?)");
}

void Hdf5File::fail(const std::string& action) const {
  throw SystemError(fmt::format("{}: file cannot {}", path_, action));
}

std::unique_ptr<Hdf5File> open_existing(const std::string& path) {
  silence_hdf5();
  if (!std::filesystem::is_regular_file(path)) throw InputError(fmt::format("{}: error: no such file", path));
  if (H5Fis_hdf5(path.c_str()) <= 0)
    throw InputError(fmt::format("{}: error: no HDF5 file, or the beginning of one is missing", path));
  try {
    return std::make_unique<Hdf5File>(path, Hdf5File::Mode::read);
  } catch (const SystemError&) {
    throw InputError(fmt::format("{}: error: the file is not whole (cut off while it was copied or written?)", path));
  }
}

bool Hdf5File::exists(const std::string& path) const {
  for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1)) {
    if (H5Lexists(file_, path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return path == "/" || H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0;
}

bool Hdf5File::is_group(const std::string& path) const {
  H5O_info_t info;
  return H5Oget_info_by_name(file_, path.c_str(), &info, H5P_DEFAULT) >= 0 && info.type == H5O_TYPE_GROUP;
}

void Hdf5File::create_group(const std::string& path) const {
  const Hdf5Id group(H5Gcreate2(file_, path.c_str(), link_properties(), group_properties(), H5P_DEFAULT));
  if (!group.valid()) fail("take the group " + path);
}

void Hdf5File::remove(const std::string& path) const {
  if (H5Ldelete(file_, path.c_str(), H5P_DEFAULT) < 0) fail("release " + path);
}

std::vector<std::string> Hdf5File::children(const std::string& path) const {
  std::vector<std::string> names;
  const Hdf5Id group(H5Gopen2(file_, path.c_str(), H5P_DEFAULT));
  if (!group.valid() || H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, add_name, &names) < 0) fail("list " + path);
  std::sort(names.begin(), names.end(), by_number);
  return names;
}

void Hdf5File::set_scalar(const std::string& object, const std::string& name, hid_t stored, hid_t memory,
                          const void* value) const {
  if (H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0) {
    H5Adelete_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT);
  }
  const Hdf5Id space(H5Screate(H5S_SCALAR));
  const Hdf5Id attribute(
      H5Acreate_by_name(file_, object.c_str(), name.c_str(), stored, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  if (!attribute.valid() || H5Awrite(attribute, memory, value) < 0) fail("take attribute " + name + " of " + object);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, const std::string& value) const {
  const Hdf5Id type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, value.size() + 1);
  H5Tset_cset(type, H5T_CSET_UTF8);
  set_scalar(object, name, type, type, value.c_str());
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, double value) const {
  set_scalar(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, std::int64_t value) const {
  set_scalar(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

bool Hdf5File::has_attribute(const std::string& object, const std::string& name) const {
  return H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

void Hdf5File::get_scalar(const std::string& object, const std::string& name, hid_t memory, void* value) const {
  const Hdf5Id attribute(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
  if (!attribute.valid() || H5Aread(attribute, memory, value) < 0) fail("give attribute " + name + " of " + object);
}

std::string Hdf5File::text_attribute(const std::string& object, const std::string& name) const {
  const Hdf5Id attribute(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
  if (!attribute.valid()) fail("give attribute " + name + " of " + object);
  const Hdf5Id type(H5Aget_type(attribute));
  std::string text(H5Tget_size(type), '\0');
  if (H5Aread(attribute, type, text.data()) < 0) fail("give attribute " + name + " of " + object);
  return text.c_str();
}

double Hdf5File::number_attribute(const std::string& object, const std::string& name) const {
  double value = 0.0;
  get_scalar(object, name, H5T_NATIVE_DOUBLE, &value);
  return value;
}

std::int64_t Hdf5File::integer_attribute(const std::string& object, const std::string& name) const {
  std::int64_t value = 0;
  get_scalar(object, name, H5T_NATIVE_INT64, &value);
  return value;
}

void Hdf5File::write_values(const std::string& path, const Extent& shape, hid_t stored, hid_t memory,
                            const void* values) const {
  if (std::find(shape.begin(), shape.end(), 0) != shape.end()) return;
  const Hdf5Id space = space_of(shape);
  const Hdf5Id properties = dataset_properties(shape, H5Tget_size(stored), true);
  const Hdf5Id dataset(H5Dcreate2(file_, path.c_str(), stored, space, link_properties(), properties, H5P_DEFAULT));
  if (!dataset.valid() || H5Dwrite(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) {
    fail("take " + path);
  }
}

void Hdf5File::write(const std::string& path, const Extent& shape, std::span<const double> values) const {
  write_values(path, shape, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data());
}

void Hdf5File::write(const std::string& path, const Extent& shape, std::span<const std::int32_t> values) const {
  write_values(path, shape, H5T_STD_I32LE, H5T_NATIVE_INT32, values.data());
}

void Hdf5File::write(const std::string& path, const Extent& shape, std::span<const std::int64_t> values) const {
  write_values(path, shape, H5T_STD_I64LE, H5T_NATIVE_INT64, values.data());
}

Extent Hdf5File::extent(const std::string& path) const {
  const Hdf5Id dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT));
  if (!dataset.valid()) fail("give " + path);
  const Hdf5Id space(H5Dget_space(dataset));
  Extent size(H5Sget_simple_extent_ndims(space));
  H5Sget_simple_extent_dims(space, size.data(), nullptr);
  return size;
}

std::size_t Hdf5File::bytes_per_value(const std::string& path) const {
  const Hdf5Id dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT));
  if (!dataset.valid()) fail("give " + path);
  const Hdf5Id type(H5Dget_type(dataset));
  return H5Tget_size(type);
}

std::vector<double> Hdf5File::read(const std::string& path) const {
  const Hdf5Id dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT));
  if (!dataset.valid()) fail("give " + path);
  const Hdf5Id space(H5Dget_space(dataset));
  std::vector<double> values(H5Sget_simple_extent_npoints(space));
  if (!values.empty() && H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    fail("give " + path);
  }
  return values;
}

std::vector<std::int64_t> Hdf5File::read_integers(const std::string& path) const {
  const Hdf5Id dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT));
  if (!dataset.valid()) fail("give " + path);
  const Hdf5Id space(H5Dget_space(dataset));
  std::vector<std::int64_t> values(H5Sget_simple_extent_npoints(space));
  if (!values.empty() && H5Dread(dataset, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    fail("give " + path);
  }
  return values;
}

void Hdf5File::append(const std::string& path, int columns, std::span<const double> values) const {
  const hsize_t added = values.size() / columns;
  Hdf5Id dataset;
  Extent start(columns > 1 ? 2 : 1, 0), size = start;
  if (exists(path)) {
    dataset = Hdf5Id(H5Dopen2(file_, path.c_str(), H5P_DEFAULT));
    start[0] = extent(path)[0];
  } else {
    Extent largest{H5S_UNLIMITED}, chunk{history_chunk_rows};
    if (columns > 1) largest.push_back(columns), chunk.push_back(columns), size.back() = columns;
    const Hdf5Id space(H5Screate_simple(static_cast<int>(size.size()), size.data(), largest.data()));
    Hdf5Id properties = dataset_properties({}, sizeof(double), false);
    H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
    dataset = Hdf5Id(H5Dcreate2(file_, path.c_str(), H5T_IEEE_F64LE, space, link_properties(), properties, H5P_DEFAULT));
  }
  if (columns > 1) size.back() = columns;
  if (!dataset.valid()) fail("take " + path);
  size[0] = start[0] + added;
  if (H5Dset_extent(dataset, size.data()) < 0) fail("extend " + path);
  const Hdf5Id stored(H5Dget_space(dataset));
  size[0] = added;
  H5Sselect_hyperslab(stored, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr);
  const Hdf5Id memory = space_of(size);
  if (added > 0 && H5Dwrite(dataset, H5T_NATIVE_DOUBLE, memory, stored, H5P_DEFAULT, values.data()) < 0) {
    fail("extend " + path);
  }
}

void Hdf5File::truncate(const std::string& path, hsize_t rows) const {
  Extent size = extent(path);
  size[0] = rows;
  const Hdf5Id dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT));
  if (!dataset.valid() || H5Dset_extent(dataset, size.data()) < 0) fail("cut " + path);
}

}  // namespace balocco
