#include "model_digest.hpp"

#include <gtest/gtest.h>

#include "deck_support.hpp"

namespace balocco {
namespace {

/// Names of the parts in which two decks differ.
std::vector<std::string> differing_parts(const std::string& a, const std::string& b) {
  const auto of_a = model_digests(test::read(a).model), of_b = model_digests(test::read(b).model);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < of_a.size(); ++i)
    if (of_a[i] != of_b[i]) names.push_back(of_a[i].first);
  return names;
}

std::string pressed(const std::string& faces, const std::string& top) {
  return test::brick + "*NODE\n9, 0., 0., 0.\n*SURFACE, NAME=SOLE\nALL, " + faces +
         "\n*SURFACE, TYPE=SEGMENTS, NAME=ROAD\nSTART, -9., " + top + "\nLINE, 9., " + top +
         "\n*RIGID BODY, REF NODE=9, ANALYTICAL SURFACE=ROAD\n*SURFACE INTERACTION, NAME=I\n*CONTACT PAIR, INTERACTION=I\nSOLE, ROAD\n"
         "*STEP, NLGEOM\n*STATIC\n*BOUNDARY\n9, 1, 6\n*END STEP\n";
}

TEST(ModelDigest, TellsOtherSlavesAndNotOtherMasters) {
  EXPECT_EQ(differing_parts(pressed("S1", "0."), pressed("S2", "0.")), std::vector<std::string>{"contact pairs"});
  EXPECT_TRUE(differing_parts(pressed("S1", "0."), pressed("S1", "-0.5")).empty()) << "the same car may drive on another road";
}

}  // namespace
}  // namespace balocco
