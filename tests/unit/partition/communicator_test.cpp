// Collectives; these tests hold on any number of ranks.
#include "communicator.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "door.hpp"
#include "model/diagnostics.hpp"

namespace balocco {
namespace {

TEST(Communicator, LocatedMinimumBreaksTiesByPayload) {
  const Communicator communicator;
  const auto tied = communicator.minimum(Communicator::Located{2.5, 100 - communicator.rank()});
  EXPECT_EQ(tied.value, 2.5);
  EXPECT_EQ(tied.payload, 100 - (communicator.size() - 1));
  const auto last = communicator.minimum(Communicator::Located{-1.0 * communicator.rank(), communicator.rank()});
  EXPECT_EQ(last.value, -1.0 * (communicator.size() - 1));
  EXPECT_EQ(last.payload, communicator.size() - 1);
}

TEST(Communicator, ScalarCollectives) {
  const Communicator communicator;
  const int ranks = communicator.size();
  EXPECT_EQ(communicator.minimum(3.0 + communicator.rank()), 3.0);
  EXPECT_EQ(communicator.maximum(3.0 + communicator.rank()), 2.0 + ranks);
  EXPECT_EQ(communicator.sum(std::int64_t{2}), 2 * ranks);
  EXPECT_TRUE(communicator.any(communicator.rank() == ranks - 1));
  EXPECT_FALSE(communicator.any(false));
}

TEST(Communicator, ExactSumsMergeWithoutRoundingAway) {
  const Communicator communicator;
  std::array<ExactSum, 2> sums;
  sums[0].add(1e100);
  sums[0].add(1.0);
  sums[0].add(-1e100);  // a plain sum would lose the 1
  sums[1].add(0.1);
  communicator.sum(sums);
  EXPECT_EQ(sums[0].value(), static_cast<double>(communicator.size()));
  ExactSum expected;
  for (int i = 0; i < communicator.size(); ++i) expected.add(0.1);
  EXPECT_EQ(sums[1].value(), expected.value());
}

TEST(Communicator, FailureOnOneRankIsThrownOnAll) {
  const Communicator communicator;
  const int last = communicator.size() - 1;
  const auto fail_with = [&](auto error) {
    communicator.together([&] {
      if (communicator.rank() == last) throw error;
    });
  };
  try {
    fail_with(InputError(std::vector<std::string>{"first", "second"}));
    FAIL() << "no rank may go on";
  } catch (const InputError& error) {
    EXPECT_EQ(error.messages(), (std::vector<std::string>{"first", "second"}));
  }
  try {
    fail_with(AnalysisError("no convergence"));
    FAIL() << "no rank may go on";
  } catch (const AnalysisError& error) {
    EXPECT_STREQ(error.what(), "no convergence");
  }
  EXPECT_THROW(fail_with(std::length_error("anything else")), SystemError);
  EXPECT_NO_THROW(communicator.together([] {}));
}

TEST(Communicator, LowestFailingRankIsHeard) {
  const Communicator communicator;
  try {
    communicator.together([&] { throw AnalysisError("rank " + std::to_string(communicator.rank())); });
    FAIL() << "no rank may go on";
  } catch (const AnalysisError& error) {
    EXPECT_STREQ(error.what(), "rank 0");
  }
}

TEST(Door, ARankThatFailsAloneLearnsIt) {
  const Communicator communicator;
  {
    Door shared(communicator);
    EXPECT_TRUE(shared.everyone_comes(10.0));
  }
  Door door(communicator);
  if (!communicator.is_root()) EXPECT_FALSE(door.everyone_comes(0.05));
  MPI_Barrier(communicator.handle());  // the collective in which the root was
  if (communicator.is_root()) EXPECT_TRUE(door.everyone_comes(10.0)) << "the others came before";
}

TEST(Communicator, BroadcastTakesTheRootsText) {
  const Communicator communicator;
  std::string text = communicator.is_root() ? "of the root" : "";
  communicator.broadcast(text);
  EXPECT_EQ(text, "of the root");
}

}  // namespace
}  // namespace balocco
