// Results and checkpoints written and read back. All tests hold on any number of ranks.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include "hdf5_file.hpp"
#include "hdf5_rows.hpp"
#include "info.hpp"
#include "model/diagnostics.hpp"
#include "results_diff.hpp"
#include "results_fake.hpp"
#include "results_index.hpp"
#include "results_schedule.hpp"
#include "signals.hpp"
#include "xdmf.hpp"

namespace balocco {
namespace {

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// Paths of all datasets below a group that differ in shape or bits, or stand in one file only.
void compare(const Hdf5File& a, const Hdf5File& b, const std::string& group, std::vector<std::string>& different) {
  const auto names = a.children(group);
  if (names != b.children(group)) different.push_back(group);
  for (const std::string& name : names) {
    const std::string path = (group == "/" ? "" : group) + "/" + name;
    if (!b.exists(path)) continue;
    if (a.is_group(path)) {
      compare(a, b, path, different);
    } else if (a.extent(path) != b.extent(path) || !same_bits(a.read(path), b.read(path))) {
      different.push_back(path);
    }
  }
}

std::vector<std::string> differences(const std::string& a, const std::string& b) {
  std::vector<std::string> different;
  compare(Hdf5File(a, Hdf5File::Mode::read), Hdf5File(b, Hdf5File::Mode::read), "/", different);
  return different;
}

TEST(Schedule, MarksAreMultiplesAndTheEndIsOne) {
  Schedule schedule = Schedule::every(0.3, 1.0);
  EXPECT_FALSE(schedule.due(0.29, 1, false));
  EXPECT_TRUE(schedule.due(0.3 - 1e-12, 1, false));  // increments add up to marks within rounding
  schedule.pass(0.65);                               // an increment that jumps over two marks serves both
  EXPECT_NEAR(schedule.next(), 0.9, 1e-8);
  schedule.pass(0.95);
  EXPECT_NEAR(schedule.next(), 1.0, 1e-8);
  EXPECT_FALSE(schedule.due(0.99, 1, false));
  EXPECT_TRUE(schedule.due(1.0, 1, true));
}

TEST(Schedule, AfterARestartTheNextMarkIsTheSame) {
  for (const Schedule& fresh : {Schedule::every(0.1, 7.0), Schedule::equal_intervals(70, 7.0), Schedule::at({0.0, 2.0, 5.0}, 7.0)}) {
    Schedule running = fresh;
    for (int i = 1; i <= 40; ++i) running.pass(0.1 * i);
    Schedule resumed = fresh;
    resumed.pass(0.1 * 40);
    EXPECT_EQ(running.next(), resumed.next());
    EXPECT_GT(resumed.next(), 4.0);
  }
}

TEST(Schedule, WhatNobodyAskedForWaitsForAnIncrementThatCostsLittle) {
  Step step;
  step.procedure = ExplicitProcedure{.duration = 1.0};
  Schedule frames = Schedule::of(FieldOutput{}, step), rows = Schedule::of(HistoryOutput{}, step);
  EXPECT_EQ(frames.next(), 1.0) << "nobody is called for it";
  for (Schedule* schedule : {&frames, &rows}) {
    EXPECT_FALSE(schedule->due(0.5, 1999, false));
    EXPECT_FALSE(schedule->due(0.004, 1000, false)) << "before the first mark";
    EXPECT_TRUE(schedule->due(0.5, 2000, false));
    EXPECT_TRUE(schedule->due(1.0, 2001, true));
    schedule->pass(0.5);
    EXPECT_FALSE(schedule->due(0.504, 3000, false)) << "before the next";
  }
  EXPECT_FALSE(frames.due(0.6, 2500, false));
  EXPECT_TRUE(rows.due(0.6, 2500, false));
}

TEST(Schedule, EveryIncrements) {
  const Schedule schedule = Schedule::every_increments(3, 1.0);
  EXPECT_FALSE(schedule.due(0.1, 2, false));
  EXPECT_TRUE(schedule.due(0.1, 3, false));
  EXPECT_TRUE(schedule.due(1.0, 4, true));
}

TEST(RowExchange, ScatteredRowsReachSlabsAndComeBackToEveryCopy) {
  const Communicator world;
  const std::int64_t total = 30000;  // several chunks, hence several slabs with rows
  std::vector<std::int64_t> owned, copies;
  for (std::int64_t row = total - 1; row >= 0; --row) {
    if ((row * 7 + row / 100) % world.size() == world.rank() && row != 5) owned.push_back(row);
    if (row % 3 == 0) copies.push_back(row);
  }
  std::vector<double> values;
  for (std::int64_t row : owned) values.insert(values.end(), {1.0 * row, -1.0 * row});
  const RowExchange writing(world, total, owned);
  const auto slab = writing.to_slab(values, 2);
  for (std::int64_t i = 0; i < writing.slab_size(); ++i) {
    const double row = writing.slab_begin() + i == 5 ? 0.0 : static_cast<double>(writing.slab_begin() + i);
    ASSERT_EQ(slab[2 * i], row);
    ASSERT_EQ(slab[2 * i + 1], -row);
  }
  const RowExchange reading(world, total, copies);
  const auto back = reading.from_slab(slab, 2);
  ASSERT_EQ(back.size(), 2 * copies.size());
  for (std::size_t i = 0; i < copies.size(); ++i) ASSERT_EQ(back[2 * i], static_cast<double>(copies[i]));
}

class Results : public testing::Test {
 protected:
  Communicator world;
  Model model = fake::model(40);

  void TearDown() override { fake::remove_folders(); }

  /// Runs the whole job on `ranks`, in `directory`.
  void run_job(const Communicator& ranks, const std::string& directory) {
    fake::Analysis analysis(model, ranks);
    JobObserver observer(model, ranks, analysis.domain, {directory, "job"}, false);
    ASSERT_TRUE(analysis.run(observer));
    observer.finish(true, "");
  }
};

TEST_F(Results, FramesHoldWhatTheAnalysisHad) {
  const std::string directory = fake::folder("frames");
  run_job(world, directory);
  const Hdf5File file(directory + "/job.h5", Hdf5File::Mode::read);
  // Frames of the explicit step: at 0, four intervals of 2.5 and every 3; those at 10 are one.
  std::vector<double> times;
  for (const FrameRecord& frame : index_results(file).frames) {
    if (frame.path.starts_with("/step_2/")) times.push_back(frame.time - 1.0);
  }
  const std::vector<double> expected{0.0, 2.5, 3.0, 5.0, 6.0, 7.5, 9.0, 10.0};
  ASSERT_EQ(times.size(), expected.size());
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(times[i], expected[i], 1e-9);

  const auto reaction = file.read("/step_2/frame_1/node/RF");
  const std::size_t rows = model.nodes.id.size();
  ASSERT_EQ(reaction.size(), 3 * rows);
  for (std::size_t row = 0; row < rows; ++row) EXPECT_FLOAT_EQ(reaction[3 * row + 1], 100.0 * row + 1 + 2.5);
  EXPECT_EQ(file.bytes_per_value("/step_2/frame_1/node/RF"), 4u);
  EXPECT_FALSE(file.exists("/step_2/frame_1/node/CPRESS"));

  EXPECT_EQ(file.bytes_per_value("/step_2/frame_2/node/V"), 8u);
  EXPECT_EQ(file.extent("/step_2/frame_2/element/FAKE8/S_IP"), (Extent{40, 2, 6}));
  const auto points = file.read("/step_2/frame_2/element/FAKE8/S_IP");
  EXPECT_NEAR(points[12 * 17 + 6 + 2] - points[12 * 17], 12.0, 1e-12) << "second point, third component";
  EXPECT_FALSE(file.exists("/step_2/frame_1/element/FAKE8/STH")) << "bricks have no thickness";
  EXPECT_TRUE(file.exists("/step_2/frame_1/element/FAKE4/STH"));
  const auto mean = file.read("/step_2/frame_7/element/FAKE8/S");
  const auto at_points = file.read("/step_2/frame_7/element/FAKE8/S_IP");
  EXPECT_FLOAT_EQ(mean[6 * 3 + 4], 0.5 * (at_points[12 * 3 + 4] + at_points[12 * 3 + 6 + 4]));
  EXPECT_EQ(file.integer_attribute("/step_2", "completed"), 1);
  EXPECT_NEAR(file.number_attribute("/step_2", "time_end"), 11.0, 1e-9);
}

TEST_F(Results, FieldsOfASetAreNoNumbersElsewhere) {
  model.steps[1].field_outputs[0].node_set = 0;     // WATCHED: three nodes
  model.steps[1].field_outputs[0].element_set = 0;  // PAIR: the last membrane and the first brick
  model.element_sets.push_back({"LAST BRICK", {{1, 39}}});
  model.steps[1].field_outputs[1].element_set = 1;
  const std::string directory = fake::folder("sets");
  run_job(world, directory);
  const Hdf5File file(directory + "/job.h5", Hdf5File::Mode::read);
  const auto motion = file.read("/step_2/frame_1/node/U");
  const auto& watched = model.node_sets[0].nodes;
  for (std::size_t row = 0; row < model.nodes.id.size(); ++row) {
    const bool inside = std::find(watched.begin(), watched.end(), static_cast<std::int32_t>(row)) != watched.end();
    EXPECT_EQ(std::isnan(motion[3 * row]), !inside) << row;
    EXPECT_EQ(std::isnan(motion[3 * row + 2]), !inside) << row;
  }
  const auto stress = file.read("/step_2/frame_1/element/FAKE8/S");
  for (std::size_t row = 0; row < 40; ++row) EXPECT_EQ(std::isnan(stress[6 * row]), row != 0) << row;
  EXPECT_TRUE(file.exists("/step_2/frame_2/element/FAKE8/S_IP"));
  EXPECT_FALSE(file.exists("/step_2/frame_2/element/FAKE4")) << "no membrane is in the set";
  const auto velocity = file.read("/step_2/frame_2/node/V");
  EXPECT_EQ(std::count_if(velocity.begin(), velocity.end(), [](double v) { return std::isnan(v); }), 0);
}

TEST_F(Results, HistoryHoldsRowsAtItsMarks) {
  const std::string directory = fake::folder("history");
  run_job(world, directory);
  const Hdf5File file(directory + "/job.h5", Hdf5File::Mode::read);
  const auto times = file.read("/step_2/history/energy/time");
  ASSERT_EQ(times.size(), 21u);
  EXPECT_NEAR(times[7], 1.0 + 3.5, 1e-9);
  EXPECT_EQ(file.read("/step_2/history/energy/ALLKE")[7], std::sqrt(2.0) * times[7]);
  const auto node = 4 * 40 + 2;
  const std::string group = "/step_2/history/node_" + std::to_string(model.nodes.id[node]) + "/";
  EXPECT_NEAR(file.read(group + "RF2")[7], 100.0 * node + 1 + 3.5, 1e-9);
  EXPECT_EQ(file.extent(group + "U"), (Extent{21, 3}));
  EXPECT_FALSE(file.has_attribute(group, "set"));  // two more have it
  const std::string hub = "/step_2/history/node_" + std::to_string(model.nodes.id[model.node_sets[1].nodes[0]]);
  EXPECT_EQ(file.text_attribute(hub, "set"), "HUB");
  const auto stress = file.read("/step_2/history/element_10/S");
  EXPECT_EQ(file.read("/step_2/history/element_10/S12")[5], stress[6 * 5 + 3]);
  EXPECT_EQ(file.read("/step_2/history/contact_SKIN_ROAD/CFN")[3 * 7 + 2], times[7]);
  EXPECT_EQ(file.read("/step_2/history/contact_SKIN_ROAD/CAREA")[7], 2.0 * times[7]);
}

TEST_F(Results, AreTheSameBitsOnAnyNumberOfRanks) {
  const std::string directory = fake::folder("ranks");
  run_job(world, directory + "/all");
  MPI_Comm alone;
  MPI_Comm_split(MPI_COMM_WORLD, world.rank(), 0, &alone);
  if (world.is_root()) run_job(Communicator(alone), directory + "/one");
  MPI_Comm_free(&alone);
  world.together([&] {
    if (!world.is_root()) return;
    for (const char* file : {"/job.h5", "/job.ckpt.h5"}) {
      EXPECT_EQ(differences(directory + "/all" + file, directory + "/one" + file), std::vector<std::string>{});
    }
  });
}

TEST_F(Results, RestartAfterACrashEqualsTheUninterruptedRun) {
  const std::string directory = fake::folder("restart");
  run_job(world, directory + "/whole");
  const JobPaths paths{directory + "/torn", "job"};
  {
    // Killed at time 7.7 of the explicit step, with a checkpoint at 6 and a frame at 7.5 behind it.
    fake::Analysis analysis(model, world);
    JobObserver observer(model, world, analysis.domain, paths, false);
    ASSERT_TRUE(analysis.run(observer, 77));
  }
  fake::Analysis analysis(model, world);
  read_checkpoint(paths.checkpoint(), model, world, analysis.domain, analysis.groups(), analysis.current);
  EXPECT_EQ(analysis.current.increment, 60);
  EXPECT_TRUE(analysis.current.dynamic);
  JobObserver observer(model, world, analysis.domain, paths, true);
  ASSERT_TRUE(analysis.run(observer));
  observer.finish(true, "");
  world.together([&] {
    if (!world.is_root()) return;
    for (const char* file : {"/job.h5", "/job.ckpt.h5"}) {
      EXPECT_EQ(differences(directory + "/whole" + file, directory + "/torn" + file), std::vector<std::string>{});
    }
    std::ifstream whole(directory + "/whole/job.xdmf"), torn(directory + "/torn/job.xdmf");
    const std::string text{std::istreambuf_iterator<char>(whole), {}};
    EXPECT_EQ(text, std::string(std::istreambuf_iterator<char>(torn), {}));
    EXPECT_NE(text.find("job.h5:/step_2/frame_3/element/FAKE4/STH"), std::string::npos);
  });
}

TEST_F(Results, AskedToStopItLeavesACheckpointThatContinues) {
  const std::string directory = fake::folder("stop");
  const JobPaths paths{directory, "job"};
  fake::Analysis analysis(model, world);
  JobObserver observer(model, world, analysis.domain, paths, false);
  if (world.is_root()) std::ofstream(paths.control()) << "frame stop\n";
  EXPECT_FALSE(analysis.run(observer));
  EXPECT_TRUE(observer.stopped_on_request());
  observer.finish(false, "stopped on request");
  EXPECT_FALSE(std::filesystem::exists(paths.control()));
  fake::Analysis resumed(model, world);
  read_checkpoint(paths.checkpoint(), model, world, resumed.domain, resumed.groups(), resumed.current);
  EXPECT_EQ(resumed.current.increment, 1);
  EXPECT_TRUE(same_bits(resumed.current.position, analysis.current.position));
}

TEST_F(Results, CheckpointAtTheEndOfAStepStartsTheNext) {
  const std::string path = fake::folder("step_end") + "/job.ckpt.h5";
  fake::Analysis analysis(model, world);
  analysis.increment(1.0);
  write_checkpoint(path, model, world, analysis.domain, analysis.groups(), analysis.current, true);
  fake::Analysis other(model, world);
  read_checkpoint(path, model, world, other.domain, other.groups(), other.current);
  EXPECT_EQ(other.current.step, 1);
  EXPECT_EQ(other.current.step_time, 0.0);
  EXPECT_EQ(other.current.increment, 0);
  EXPECT_EQ(other.current.total_time, 1.0);
}

TEST_F(Results, CheckpointBringsBackEveryBitOnAnotherNumberOfRanks) {
  const std::string path = fake::folder("bits") + "/job.ckpt.h5";
  fake::Analysis analysis(model, world);
  for (int i = 0; i < 3; ++i) analysis.increment(0.1);
  write_checkpoint(path, model, world, analysis.domain, analysis.groups(), analysis.current);
  MPI_Comm alone;
  MPI_Comm_split(MPI_COMM_WORLD, world.rank(), 0, &alone);
  {
    const Communicator single(alone);
    fake::Analysis expected(model, single), read(model, single);
    for (int i = 0; i < 3; ++i) expected.increment(0.1);
    read_checkpoint(path, model, single, read.domain, read.groups(), read.current);
    EXPECT_TRUE(same_bits(read.current.position, expected.current.position));
    EXPECT_TRUE(same_bits(read.current.velocity, expected.current.velocity));
    for (std::size_t g = 0; g < expected.current.element_history.size(); ++g) {
      EXPECT_TRUE(same_bits(read.current.element_history[g], expected.current.element_history[g]));
    }
    for (std::size_t i = 0; i < expected.current.contact[0].size(); ++i) {
      EXPECT_EQ(std::memcmp(&read.current.contact[0][i], &expected.current.contact[0][i], sizeof(ContactPoint)), 0);
    }
    for (std::size_t i = 0; i < expected.current.nodal_work.size(); ++i) {
      EXPECT_EQ(std::memcmp(&read.current.nodal_work[i], &expected.current.nodal_work[i], sizeof(NodalWork)), 0);
    }
    const RigidBodyState &body = read.current.rigid_bodies[0], &wanted = expected.current.rigid_bodies[0];
    EXPECT_EQ(body.position, wanted.position);
    EXPECT_EQ(body.orientation, wanted.orientation);
    EXPECT_EQ(body.velocity, wanted.velocity);
    EXPECT_EQ(body.angular_velocity, wanted.angular_velocity);
    EXPECT_EQ(body.rotation, wanted.rotation);
    ASSERT_EQ(body.nodes.size(), 1u);
    EXPECT_EQ(body.nodes[0].node, 4);
    EXPECT_FALSE(body.nodes[0].tie);
    EXPECT_EQ(body.nodes[0].offset, wanted.nodes[0].offset);
    EXPECT_EQ(read.current.total_time, expected.current.total_time);
  }
  MPI_Comm_free(&alone);
}

TEST_F(Results, CheckpointOfAnotherDeckIsRefused) {
  const std::string path = fake::folder("other_deck") + "/job.ckpt.h5";
  fake::Analysis analysis(model, world);
  write_checkpoint(path, model, world, analysis.domain, analysis.groups(), analysis.current);
  Model other = fake::model(40);
  other.deck_sha256 = "another";
  EXPECT_THROW(read_checkpoint(path, other, world, analysis.domain, analysis.groups(), analysis.current), InputError);
  EXPECT_THROW(read_checkpoint(path + "x", model, world, analysis.domain, analysis.groups(), analysis.current), InputError);
}

TEST_F(Results, FolderThatCannotBeWrittenIsToldOnEveryRank) {
  const std::string directory = fake::folder("no_folder");
  if (world.is_root()) std::ofstream(directory + "/file") << "in the way";
  MPI_Barrier(MPI_COMM_WORLD);
  const fake::Analysis analysis(model, world);
  EXPECT_THROW(JobObserver(model, world, analysis.domain, {directory + "/file", "job"}, false), SystemError);
}

TEST_F(Results, FullDiskIsToldAndLeavesTheFramesBefore) {
  const std::string directory = fake::folder("full");
  model = fake::model(4000);
  fake::Analysis analysis(model, world);
  JobObserver observer(model, world, analysis.domain, {directory, "job"}, false);
  observer.step_started(analysis, 0);
  const auto size = std::filesystem::file_size(directory + "/job.h5");
  // A limit on the size of files stands for a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const rlimit tight{size + 20000, old.rlim_max};
  MPI_Barrier(MPI_COMM_WORLD);
  setrlimit(RLIMIT_FSIZE, &tight);
  analysis.increment(0.25);
  EXPECT_THROW(observer.advanced(analysis, {.increment = 1, .step_time = 0.25, .total_time = 0.25}), SystemError);
  setrlimit(RLIMIT_FSIZE, &old);
  MPI_Barrier(MPI_COMM_WORLD);
  const Hdf5File file(directory + "/job.h5", Hdf5File::Mode::read);
  EXPECT_EQ(index_results(file).frames.size(), 1u);
  EXPECT_EQ(file.read("/step_1/frame_0/node/U").size(), 3 * model.nodes.id.size());
}

TEST_F(Results, AFailedAnalysisLeavesALastFrame) {
  const std::string directory = fake::folder("failed");
  fake::Analysis analysis(model, world);
  JobObserver observer(model, world, analysis.domain, {directory, "job"}, false);
  ASSERT_TRUE(analysis.run(observer, 7));
  observer.finish(false, "error: element 12 is inverted");
  const Hdf5File file(directory + "/job.h5", Hdf5File::Mode::read);
  const auto frames = index_results(file).frames;
  EXPECT_EQ(frames.back().path, "/step_2/frame_1");
  EXPECT_NEAR(frames.back().time, 1.7, 1e-12);
  EXPECT_EQ(file.integer_attribute("/step_2", "completed"), 0);
}

TEST_F(Results, InfoTellsStepsFramesAndHistories) {
  const std::string directory = fake::folder("info");
  run_job(world, directory);
  const std::string text = describe_results(directory + "/job.h5");
  for (const char* part : {"40 FAKE8", "B: solid, material RUBBER", "step_2 ROLL (explicit dynamics)", "8 frames", "completed",
                           "contact_SKIN_ROAD", "HUB", "21 rows"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is missing in\n" << text;
  }
  EXPECT_THROW(describe_results(directory + "/job.sta"), InputError);
  EXPECT_THROW(describe_results(directory + "/none.h5"), InputError);
}

TEST_F(Results, DiffNamesWhereTwoRunsPart) {
  const std::string one = fake::folder("diff_one"), two = fake::folder("diff_two");
  run_job(world, one);
  run_job(world, two);
  const std::string a = one + "/job.h5", b = two + "/job.h5";
  EXPECT_TRUE(compare_results(a, b, 0.0).same);
  MPI_Barrier(MPI_COMM_WORLD);  // all have read what the root changes now
  if (world.is_root()) {
    const Hdf5File file(b, Hdf5File::Mode::modify);
    for (const std::string path : {"/step_2/frame_3/node/U", "/step_2/frame_1/element/FAKE4/S"}) {
      const Extent extent = file.extent(path);
      auto values = file.read(path);
      values.back() += 1e-3 * *std::max_element(values.begin(), values.end());
      file.remove(path);
      file.write(path, extent, values);
    }
  }
  MPI_Barrier(MPI_COMM_WORLD);
  const auto found = compare_results(a, b, 0.0);
  EXPECT_FALSE(found.same);
  for (const char* part : {"they part first at step 2 (ROLL), frame 1, time", "S of FAKE4 of element", "component 6", "U  "})
    EXPECT_NE(found.text.find(part), std::string::npos) << part << " is missing in\n" << found.text;
  EXPECT_TRUE(compare_results(a, b, 0.01).same) << "within the tolerance";
}

TEST_F(Results, DiffTellsWhatOneOfThemLacks) {
  const std::string one = fake::folder("diff_whole"), two = fake::folder("diff_cut");
  run_job(world, one);
  run_job(world, two);
  if (world.is_root()) Hdf5File(two + "/job.h5", Hdf5File::Mode::modify).remove("/step_2/frame_3");
  MPI_Barrier(MPI_COMM_WORLD);
  const auto found = compare_results(one + "/job.h5", two + "/job.h5", 1.0);
  EXPECT_FALSE(found.same);
  EXPECT_NE(found.text.find("step_2/frame_3 stands only in A"), std::string::npos) << found.text;
}

/// What open_results says of a file, or "".
std::string trouble_with(const std::string& path) {
  try {
    open_results(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(Results, FilesAreCalledWhatTheyAre) {
  const std::string directory = fake::folder("names");
  run_job(world, directory);
  const std::string whole = directory + "/job.h5", cut = directory + "/cut.h5";
  if (world.is_root()) {
    std::filesystem::copy_file(whole, cut);
    std::filesystem::resize_file(cut, std::filesystem::file_size(whole) / 2);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_EQ(trouble_with(whole), "");
  EXPECT_NE(trouble_with(cut).find("the file is not whole"), std::string::npos);
  EXPECT_NE(trouble_with(directory + "/job.sta").find("no HDF5 file"), std::string::npos);
  EXPECT_NE(trouble_with(directory + "/none.h5").find("no such file"), std::string::npos);
  EXPECT_NE(trouble_with(directory + "/job.ckpt.h5").find("this is a checkpoint"), std::string::npos);
}

TEST(Signals, ReachAllRanksFromAny) {
  const Communicator world;
  install_signal_handlers();
  EXPECT_FALSE(take_requests(world, "").frame);
  if (world.rank() == world.size() - 1) std::raise(SIGUSR2);
  EXPECT_TRUE(take_requests(world, "").frame);
  EXPECT_FALSE(take_requests(world, "").frame);
}

}  // namespace
}  // namespace balocco
