// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "tests/cli/command.h"
#include "tests/cli/tiny_sequence.h"
#include "tests/support/data.h"

namespace corvo::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Runs `corvo synth <scene> -o <folder>` for two frames with further arguments.
CommandResult Synth(const std::string& scene, const std::filesystem::path& folder,
                    const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"synth", scene, "-o", folder, "--frames", "2"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return RunCorvo(arguments);
}

TEST(Synth, WritesTheParametersOfTheSequence) {
  const TemporaryFolder folder;
  const CommandResult result =
      Synth("corridor", folder.path(),
            {"--width", "96", "--noise", "2", "--seed", "7", "--dark", "4,2", "--blur", "0.5,1.5",
             "--drift", "1", "--vignetting", "0.5", "--moving", "0.25"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(
      ReadText(folder / "synthetic.yaml"),
      AllOf(HasSubstr("scene: corridor\n"), HasSubstr("frames: 2\n"), HasSubstr("noise_sigma: 2\n"),
            HasSubstr("noise_seed: 7\n"), HasSubstr("dark_s: [4, 2]\n"),
            HasSubstr("blur_s: [0.5, 1.5]\n"), HasSubstr("exposure_drift: 1\n"),
            HasSubstr("vignetting: 0.5\n"), HasSubstr("moving_share: 0.25\n")));
}

TEST(Synth, RendersThroughAnyCamera) {
  const TemporaryFolder folder;
  const std::string camera =
      "model: kb4\nwidth: 80\nheight: 60\nfx: 40\nfy: 40\ncx: 39.5\ncy: 29.5\n"
      "k1: 0.01\nk2: 0\nk3: 0\nk4: 0\n";
  WriteText(folder / "camera.yaml", camera);
  const CommandResult result = Synth("room", folder / "out", {"--camera", folder / "camera.yaml"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(ReadText(folder / "out/camera.yaml"), camera + "frame_rate_hz: 30\n");
  EXPECT_EQ(cv::imread(folder / "out/rgb/0.000000000.png").size(), cv::Size(80, 60));
}

TEST(Synth, EurocSequencesNeedNoCameraFile) {
  const TemporaryFolder folder;
  ASSERT_EQ(Synth("wall", folder / "wall", {"--width", "96", "--layout", "euroc"}).exit_code, 0);
  const CommandResult run = RunCorvo({"run", folder / "wall/mav0", "-o", folder / "result"});
  EXPECT_EQ(run.exit_code, 2) << run.err;  // Two frames yield no pose.
}

TEST(Synth, LeavesTheUsersFilesBetweenItsImages) {
  for (const std::string layout : {"tum", "kitti", "euroc"}) {
    const TemporaryFolder folder;
    const std::vector<std::string> options = {"--width", "64", "--layout", layout};
    ASSERT_EQ(Synth("wall", folder.path(), options).exit_code, 0);
    EXPECT_EQ(Synth("wall", folder.path(), options).exit_code, 0);
    const std::string name = layout == "tum"     ? "rgb/notes.txt"
                             : layout == "kitti" ? "sequences/00/image_0/mask.png"
                                                 : "mav0/cam0/data/1a.png";
    WriteText(folder / name, "mine");
    const CommandResult again = Synth("room", folder.path(), options);
    EXPECT_EQ(again.exit_code, 1);
    EXPECT_THAT(again.err, HasSubstr(name + ": is not a file of a synthetic sequence"));
    EXPECT_THAT(ReadText(folder / "synthetic.yaml"), HasSubstr("scene: wall"));
    std::vector<std::string> forced = options;
    forced.emplace_back("--force");
    EXPECT_EQ(Synth("room", folder.path(), forced).exit_code, 0);
    EXPECT_EQ(ReadText(folder / name), "mine");
  }
}

TEST(Synth, ErrorsNameValuesOutOfRange) {
  const TemporaryFolder folder;
  for (const auto& [option, value, message] : {std::tuple{"--drift", "9", "--drift: 9"},
                                               {"--moving", "1", "--moving: 1"},
                                               {"--dark", "-1,2", "--dark: -1"},
                                               {"--blur", "1", "--blur"},
                                               {"--layout", "bag", "bag"}}) {
    const CommandResult result = Synth("room", folder / "out", {option, value});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, AllOf(StartsWith("corvo: error: "), HasSubstr(message)));
  }
}

}  // namespace
}  // namespace corvo::test
