// SPDX-License-Identifier: MIT
#include "tests/support/data.h"

#include <stdlib.h>

#include <fstream>
#include <iterator>

namespace corvo::test {

bool DataIsRequired() {
  const char* ci = ::getenv("CI");
  return ci && *ci;
}

bool IsShortRun() { return ::getenv("CORVO_SHORT_TESTS") != nullptr; }

std::string ReadText(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << "cannot read " << path;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace corvo::test
