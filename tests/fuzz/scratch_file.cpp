// SPDX-License-Identifier: MIT
#include "tests/fuzz/scratch_file.h"

#include "tests/data/temporary_folder.h"

namespace corvo::fuzz {

std::filesystem::path WriteScratchFile(const std::string& text) {
  static const test::TemporaryFolder folder;
  return folder.Write("input", text);
}

}  // namespace corvo::fuzz
