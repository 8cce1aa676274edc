// SPDX-License-Identifier: MIT
#include "vo/io/file_bytes.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/data.h"
#include "tests/support/matchers.h"

namespace corvo {
namespace {

using test::ThrowsError;

TEST(ReadFileBytes, ReturnsFilesUpToTheLimit) {
  const test::TemporaryFolder dir;
  const std::string text("a\0\n\xff", 4);
  EXPECT_EQ(ReadFileBytes(dir.Write("a", text), 4), text);
  EXPECT_EQ(ReadFileBytes(dir.Write("empty", ""), 4), "");
  const std::string large(200'000, 'x');
  EXPECT_EQ(ReadFileBytes(dir.Write("large", large), 1 << 20), large);
  EXPECT_THAT([&] { ReadFileBytes(dir.path() / "a", 3); },
              ThrowsError("a: has more than 3 bytes; allowed is 0 to 3"));
}

TEST(ReadFileBytes, EndsForEndlessAndSparseFiles) {
  EXPECT_THAT([] { ReadFileBytes("/dev/zero", 1000); }, ThrowsError("/dev/zero: has more than"));
  const test::TemporaryFolder dir;
  const auto sparse = dir.Write("sparse", "");
  std::filesystem::resize_file(sparse, std::uintmax_t{1} << 40);
  EXPECT_THAT([&] { ReadFileBytes(sparse, 1000); }, ThrowsError("sparse: has more than 1000"));
}

TEST(ReadFileBytes, NamesWhatCannotBeRead) {
  const test::TemporaryFolder dir;
  EXPECT_THAT([&] { ReadFileBytes(dir.path() / "none", 9); }, ThrowsError("none: cannot be read"));
  EXPECT_THAT([&] { ReadFileBytes(dir.path(), 9); }, ThrowsError("is a folder"));
}

}  // namespace
}  // namespace corvo
