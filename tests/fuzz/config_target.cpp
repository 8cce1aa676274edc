// SPDX-License-Identifier: MIT
#include "tests/fuzz/scratch_file.h"
#include "tests/fuzz/targets.h"
#include "vo/io/config.h"

namespace corvo::fuzz {

void FuzzConfig(Bytes bytes) {
  AllowError([&] {
    const OdometryOptions options = ReadOptions(WriteScratchFile(Input(bytes).Text()));
    const std::string text = WriteOptions(options);
    Require(WriteOptions(ReadOptions(WriteScratchFile(text))) == text,
            "options that are written are read back unchanged");
  });
}

}  // namespace corvo::fuzz
