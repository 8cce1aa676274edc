// SPDX-License-Identifier: MIT
#include "tests/data/data_path.h"

#include <stdlib.h>

namespace corvo::test {

std::filesystem::path SourceDir() { return CORVO_SOURCE_DIR; }

std::filesystem::path DataPath(const std::filesystem::path& relative) {
  const char* data = ::getenv("CORVO_DATA");
  if (data && *data) return std::filesystem::path(data) / relative;
  return SourceDir().parent_path() / "shared" / "data" / relative;
}

}  // namespace corvo::test
