// SPDX-License-Identifier: MIT
#include "apps/output/output_folder.h"

#include "tests/cli/expect_error.h"
#include "tests/cli/temp_folder.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;
using test::ReadText;
using test::TempFolder;
using test::WriteText;
using ::testing::HasSubstr;

int CountEntries(const fs::path& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(OutputFolder, PutsFilesInPlaceOnCommitOnly) {
  TempFolder folder;
  const fs::path out = folder / "a/b";
  OutputFolder output(out);
  output.Write("x.txt", "new");
  EXPECT_FALSE(fs::exists(out / "x.txt"));
  output.Commit({"x.txt"});
  EXPECT_EQ(ReadText(out / "x.txt"), "new");
}

TEST(OutputFolder, KeepsEarlierResultsWithoutCommit) {
  TempFolder folder;
  WriteText(folder / "x.txt", "old");
  {
    OutputFolder output(folder.path());
    output.Write("x.txt", "new");
  }
  EXPECT_EQ(ReadText(folder / "x.txt"), "old");
  EXPECT_EQ(CountEntries(folder.path()), 1);
}

TEST(OutputFolder, RemovesTheFolderItCreatedWithoutCommit) {
  TempFolder folder;
  { OutputFolder output(folder / "new"); }
  EXPECT_FALSE(fs::exists(folder / "new"));
}

TEST(OutputFolder, ListsNumberedFilesOfThisRunAndOfAnEarlierOne) {
  TempFolder folder;
  for (const char* name :
       {"part_0.txt", "part_2.txt", "part_x.txt", "part_.txt", "part_3.csv", "my_part_4.txt"}) {
    WriteText(folder / name, "old");
  }
  OutputFolder output(folder.path());
  output.Write("part_0.txt", "new");
  output.Write("part_1.txt", "new");
  EXPECT_THAT(output.NumberedNames("part_", ".txt"),
              testing::ElementsAre("part_0.txt", "part_1.txt", "part_2.txt"));
}

TEST(OutputFolder, RemovesFilesOfAnEarlierRunThatAreNotWrittenAgain) {
  TempFolder folder;
  WriteText(folder / "image.png", "old");
  WriteText(folder / "users.txt", "kept");
  {
    OutputFolder output(folder.path());
    output.Write("x.txt", "new");
    output.Commit({"x.txt", "image.png"});
  }
  EXPECT_FALSE(fs::exists(folder / "image.png"));
  EXPECT_TRUE(fs::exists(folder / "users.txt"));
  EXPECT_EQ(CountEntries(folder.path()), 2);
}

TEST(OutputFolder, LastFileExistsOnlyIfAllOthersWereWritten) {
  TempFolder folder;
  WriteText(folder / "summary.json", "old");
  WriteText(folder / "x.txt/in_the_way", "");
  OutputFolder output(folder.path());
  output.Write("x.txt", "new");
  output.Write("summary.json", "new");
  EXPECT_THAT(test::ErrorOf([&] { output.Commit({"x.txt", "summary.json"}); }), HasSubstr("x.txt"));
  EXPECT_FALSE(fs::exists(folder / "summary.json"));
}

TEST(OutputFolder, RejectsAFileAsFolder) {
  TempFolder folder;
  WriteText(folder / "file", "");
  EXPECT_THAT(test::ErrorOf([&] { OutputFolder output(folder / "file"); }),
              HasSubstr("the output folder is a file"));
  EXPECT_THAT(test::ErrorOf([&] { OutputFolder output(folder / "file/inside"); }),
              HasSubstr("cannot be written"));
}

}  // namespace
}  // namespace corvo
