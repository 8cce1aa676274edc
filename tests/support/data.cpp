// SPDX-License-Identifier: MIT
#include "tests/support/data.h"

#include <stdlib.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace corvo::test {

bool DataIsRequired() {
  const char* ci = ::getenv("CI");
  return ci && *ci;
}

bool IsShortRun() { return ::getenv("CORVO_SHORT_TESTS") != nullptr; }

TemporaryDir::TemporaryDir() {
  std::string pattern = ::testing::TempDir() + "/corvo_test_XXXXXX";
  if (!::mkdtemp(pattern.data())) throw std::runtime_error("cannot make a folder " + pattern);
  path_ = pattern;
}

TemporaryDir::~TemporaryDir() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryDir::Write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return path_ / name;
}

std::string ReadFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << "cannot read " << path;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace corvo::test
