// SPDX-License-Identifier: MIT
#include "apps/output/manifest.h"

#include <gmock/gmock.h>

#include "tests/data/temporary_folder.h"

namespace corvo {
namespace {

using test::TemporaryFolder;
using test::WriteText;

/// Returns a manifest that lists one file of this name.
std::string ManifestOf(const std::string& name) {
  return R"({"format": "corvo result", "version": 1, "complete": true,
             "files": [{"name": ")" +
         name + R"(", "bytes": 1, "crc32": "0"}]})";
}

TEST(Crc32, IsThatOfTheStandard) {
  EXPECT_EQ(Crc32("123456789"), 0xCBF43926U);
  EXPECT_EQ(Crc32("6789", Crc32("12345")), 0xCBF43926U);
}

TEST(Manifest, IsReadAsItWasWritten) {
  TemporaryFolder folder;
  Manifest manifest{false, {{"a.txt", 3, 7}, {"100% gr\xfcn \xc3\xa4.png", 1u << 31, 0xCBF43926U}}};
  WriteText(folder / "manifest.json", ToText(manifest));
  const auto read = ReadManifest(folder / "manifest.json");
  ASSERT_TRUE(read);
  EXPECT_FALSE(read->is_complete);
  EXPECT_EQ(read->files, manifest.files);
}

TEST(Manifest, OfAnotherProgramOrCutOffIsNone) {
  TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    WriteText(folder / "manifest.json", text);
    return ReadManifest(folder / "manifest.json").has_value();
  };
  EXPECT_TRUE(read(ManifestOf("a.txt")));
  EXPECT_FALSE(read(R"({"name": "web app", "files": []})"));
  EXPECT_FALSE(read(ManifestOf("a.txt").substr(0, 60)));
  EXPECT_FALSE(read(""));
  EXPECT_FALSE(ReadManifest(folder / "none.json"));
}

TEST(Manifest, ListsNoFileOutsideOfItsFolder) {
  TemporaryFolder folder;
  for (const char* name : {"../a.txt", "/etc/passwd", "sub/a.txt", "..", "%2Fetc", ""}) {
    WriteText(folder / "manifest.json", ManifestOf(name));
    EXPECT_FALSE(ReadManifest(folder / "manifest.json")) << name;
  }
}

TEST(Manifest, TellsAChangedFile) {
  TemporaryFolder folder;
  WriteText(folder / "a.txt", "abc");
  const ManifestFile file = Describe(folder / "a.txt");
  EXPECT_EQ(file, (ManifestFile{"a.txt", 3, Crc32("abc")}));
  EXPECT_TRUE(IsUnchanged(folder / "a.txt", file));
  WriteText(folder / "a.txt", "abd");
  EXPECT_FALSE(IsUnchanged(folder / "a.txt", file));
  EXPECT_FALSE(IsUnchanged(folder / "none.txt", file));
  WriteText(folder / "b.txt", "abc");
  std::filesystem::remove(folder / "a.txt");
  std::filesystem::create_symlink(folder / "b.txt", folder / "a.txt");
  EXPECT_FALSE(IsUnchanged(folder / "a.txt", file)) << "corvo writes no links";
}

}  // namespace
}  // namespace corvo
