#include "kept_checkpoints.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <vector>

#include "checkpoint_file.hpp"
#include "hdf5_file.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

namespace fs = std::filesystem;

struct Kept {
  std::int32_t step = 0;
  std::int64_t increment = 0;
  std::string path;
  auto operator<=>(const Kept&) const = default;
};

/// Of the job whose last, or any kept, checkpoint `path` is: DIRECTORY/JOB.
std::string job_of(const std::string& path) {
  static const std::regex ending(R"((\.step\d+\.increment\d+)?\.ckpt\.h5$)");
  return std::regex_replace(path, ending, "");
}

/// In order.
std::vector<Kept> kept_checkpoints(const std::string& path) {
  static const std::regex ending(R"(\.step(\d+)\.increment(\d+)\.ckpt\.h5)");
  const fs::path job = job_of(path);
  const std::string name = job.filename().string();
  std::vector<Kept> kept;
  std::error_code none;  // no folder: nothing is kept
  for (const auto& entry : fs::directory_iterator(job.has_parent_path() ? job.parent_path() : fs::path("."), none)) {
    const std::string file = entry.path().filename().string();
    std::smatch match;
    if (!file.starts_with(name)) continue;
    const std::string rest = file.substr(name.size());
    if (std::regex_match(rest, match, ending)) kept.push_back({std::stoi(match[1]), std::stoll(match[2]), entry.path().string()});
  }
  std::ranges::sort(kept);
  return kept;
}

CheckpointPlace place_of(const std::string& path) { return CheckpointPlace(*open_checkpoint(path)); }

std::string what_is_kept(const std::vector<Kept>& kept) {
  if (kept.empty()) return "that job keeps its last state alone: let it write *RESTART, WRITE without OVERLAY";
  std::vector<std::string> words;
  for (const auto& each : kept) words.push_back(fmt::format("increment {} of step {}", each.increment, each.step));
  constexpr std::size_t most = 12;
  const auto left = words.size() - std::min(words.size(), most);
  words.resize(words.size() - left);
  return fmt::format("kept are {}{}", fmt::join(words, ", "), left > 0 ? fmt::format(" and {} more", left) : "");
}

std::string choose(const std::string& path, const StateChoice& choice, const std::string& who) {
  if (!choice.step && !choice.increment && !choice.interval) return path;
  auto kept = kept_checkpoints(path);
  const auto step = choice.step ? std::int64_t{*choice.step} : place_of(path).number();
  const auto of_step = [&] {
    std::vector<Kept> list;
    std::ranges::copy_if(kept, std::back_inserter(list), [&](const Kept& each) { return each.step == step; });
    return list;
  }();
  if (!choice.increment && !choice.interval) {
    const bool is_other = place_of(path).number() != step && !of_step.empty() && !place_of(of_step.back().path).within_step();
    return is_other ? of_step.back().path : path;  // whose reader tells where it stands
  }
  const auto found = choice.increment ? std::ranges::find(of_step, std::int64_t{*choice.increment}, &Kept::increment)
                                      : of_step.begin() + std::min<std::ptrdiff_t>(*choice.interval - 1, std::ssize(of_step));
  if (found != of_step.end()) return found->path;
  throw InputError(fmt::format("{}: no state of {} {} of step {} is kept beside {}; {}", who, choice.increment ? "increment" : "interval",
                               choice.increment ? *choice.increment : *choice.interval, step, path, what_is_kept(kept)));
}

}  // namespace

void keep_checkpoint(const std::string& path, std::int32_t step_number, std::int64_t increment) {
  const auto kept = fmt::format("{}.step{}.increment{}.ckpt.h5", job_of(path), step_number, increment);
  std::error_code error;
  fs::remove(kept, error);
  fs::create_hard_link(path, kept, error);
  if (error) fs::copy_file(path, kept, error);  // on disks that have no links
  if (error) throw SystemError(fmt::format("{}: checkpoint cannot be kept: {}", kept, error.message()));
}

void forget_kept_checkpoints(const std::string& path) {
  std::error_code error;
  for (const auto& kept : kept_checkpoints(path))
    if (!fs::remove(kept.path, error) && error) throw SystemError(fmt::format("{}: cannot be removed: {}", kept.path, error.message()));
}

std::string chosen_checkpoint(const std::string& path, const Model& model) {
  if (const auto& read = model.restart_read) return choose(path, read->choice, fmt::format("{}: error: *RESTART, READ", model.where(read->location)));
  if (const auto& import = model.state_import) return choose(path, import->choice, fmt::format("{}: error: *IMPORT", model.where(import->location)));
  return path;
}

}  // namespace balocco
