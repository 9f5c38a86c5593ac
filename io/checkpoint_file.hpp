// What all readers of checkpoints begin with.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "hdf5_file.hpp"
#include "model/model.hpp"

namespace balocco {

/// @throws InputError if there is none, or it is not one, not whole, or of another version.
std::unique_ptr<Hdf5File> open_checkpoint(const std::string& path);

/// Where a checkpoint stands.
struct CheckpointPlace {
  std::int64_t step = 0;       // row of the step that is running or comes next
  std::int64_t increment = 0;  // 0: that step has not begun
  double step_time = 0.0, total_time = 0.0, time_increment = 0.0;

  explicit CheckpointPlace(const Hdf5File& file)
      : step(file.integer_attribute("/", "step")),
        increment(file.integer_attribute("/", "increment")),
        step_time(file.number_attribute("/", "step_time")),
        total_time(file.number_attribute("/", "total_time")),
        time_increment(file.number_attribute("/", "time_increment")) {}
  bool within_step() const { return increment > 0; }
  /// Number of the last step that has been begun.
  std::int64_t number() const { return step + (within_step() ? 1 : 0); }
};

/// Name of the dataset with the histories of elements of a type.
std::string history_path(const std::string& element_type);

/// Attributes: the number of the step that *RESTART, READ, END STEP ended, and how long it was.
constexpr const char* ended_step = "ended step";
constexpr const char* duration_of_ended_step = "duration of ended step";

/// Name of the dataset with the mass scales of elements of a type, and whether there are any: then those of all types of the file's
/// model.
std::string mass_scale_path(const std::string& element_type);
bool has_mass_scales(const Hdf5File& file, const Model& model);

}  // namespace balocco
