// Every deck of tests/badinput is refused by the reader with the one message on its first line. (The whole program is
// driven over the same decks by tests/badinput/run_case.sh.)
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "deck_reader.hpp"
#include "model/diagnostics.hpp"

namespace balocco {
namespace {

const std::filesystem::path folder = BALOCCO_TEST_DECKS;

std::vector<std::string> decks() {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".inp") paths.push_back(entry.path().stem().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

class BadInput : public testing::TestWithParam<std::string> {};

TEST_P(BadInput, IsRefusedWithOneMessage) {
  const auto path = folder / (GetParam() + ".inp");
  std::ifstream file(path);
  std::string first;
  std::getline(file, first);
  const std::string marker = "** expect: ";
  ASSERT_TRUE(first.starts_with(marker));
  try {
    read_deck(path.string(), file_loader());
    FAIL() << "accepted";
  } catch (const InputError& trouble) {
    ASSERT_EQ(trouble.messages().size(), 1u) << trouble.messages()[1];
    EXPECT_NE(trouble.messages()[0].find(first.substr(marker.size())), std::string::npos) << trouble.messages()[0];
  }
}

INSTANTIATE_TEST_SUITE_P(Decks, BadInput, testing::ValuesIn(decks()), [](const auto& info) { return info.param; });

}  // namespace
}  // namespace balocco
