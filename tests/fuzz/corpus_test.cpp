// SPDX-License-Identifier: MIT
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <vector>

#include <gtest/gtest.h>

#include "tests/data/data_path.h"
#include "tests/fuzz/targets.h"

namespace corvo::fuzz {

/// Prints a target in GoogleTest's messages, and in CTest's list of tests.
void PrintTo(const Target& target, std::ostream* stream) { *stream << target.name; }

namespace {

namespace fs = std::filesystem;

std::vector<std::uint8_t> ReadBytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return std::vector<std::uint8_t>(std::istreambuf_iterator<char>(stream), {});
}

class FuzzCorpus : public ::testing::TestWithParam<Target> {};

TEST_P(FuzzCorpus, BreaksNoPromise) {
  GetParam().run({});
  int num_files = 0;
  for (const auto& entry :
       fs::directory_iterator(test::SourceDir() / "tests/fuzz/corpus" / GetParam().name)) {
    SCOPED_TRACE(entry.path().filename());
    const std::vector<std::uint8_t> bytes = ReadBytes(entry.path());
    GetParam().run(bytes);
    ++num_files;
  }
  EXPECT_GT(num_files, 0);
}

INSTANTIATE_TEST_SUITE_P(, FuzzCorpus, ::testing::ValuesIn(kTargets),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace corvo::fuzz
