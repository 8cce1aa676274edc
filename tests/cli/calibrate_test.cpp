// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "tests/cli/command.h"
#include "tests/cli/tiny_sequence.h"
#include "tests/support/data.h"
#include "vo/io/config.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Calibrate : public testing::Test {
 protected:
  void ExpectError(const CommandResult& result, const std::string& message) const {
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, testing::ContainsRegex("corvo: error: .*" + message));
  }

  TemporaryFolder folder_;
  fs::path camera_ = folder_ / "out/camera.yaml";
};

TEST_F(Calibrate, FindsACameraFromItsImagesAlone) {
  CORVO_SKIP_IF_SHORT();
  const fs::path room = folder_ / "room";
  ASSERT_EQ(RunCorvo({"synth", "room", "-o", room, "--frames", "80", "--width", "400"}).exit_code,
            0);
  const Camera truth = ReadCameraFile(room / "camera.yaml").camera;
  fs::remove(room / "camera.yaml");
  const CommandResult result = RunCorvo({"calibrate", room / "rgb", "-o", camera_});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("* pinhole "));
  EXPECT_TRUE(fs::exists(folder_ / "out/camera_residuals.png"));
  const CameraFile found = ReadCameraFile(camera_);
  EXPECT_NEAR(found.camera.fx(), truth.fx(), 0.02 * truth.fx());
  ASSERT_TRUE(found.sigma);
  EXPECT_EQ(found.sigma->front().name, "focal");
  EXPECT_LT(found.sigma->front().sigma, 0.02);
  const fs::path again = folder_ / "again/camera.yaml";
  ASSERT_EQ(RunCorvo({"calibrate", room / "rgb", "-o", again, "--threads", "2"}).exit_code, 0);
  EXPECT_EQ(ReadText(again), ReadText(camera_));
}

TEST_F(Calibrate, FindsTheFocalLengthOfKittiFromATurn) {
  CORVO_SKIP_IF_SHORT();
  CORVO_REQUIRE_DATA("kitti/sequences/05");
  const CommandResult result =
      RunCorvo({"calibrate", DataPath("kitti/sequences/05"), "-o", camera_, "--model", "radtan"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const CameraFile found = ReadCameraFile(camera_);
  constexpr double kTruth = 707.0912;
  EXPECT_NEAR(found.camera.fx(), kTruth, 0.02 * kTruth);
  EXPECT_NEAR(found.camera.parameters().k1, 0.02, 0.015);
}

TEST_F(Calibrate, WritesNothingIfTrackingFails) {
  WriteFolder(folder_ / "noise", 5);
  const CommandResult result = RunCorvo({"calibrate", folder_ / "noise", "-o", camera_});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("no input could be tracked; nothing was written"));
  EXPECT_FALSE(fs::exists(camera_));
}

TEST_F(Calibrate, ReadsTheGivenTimesAsRunDoes) {
  WriteFolder(folder_ / "noise", 5);
  WriteText(folder_ / "times", "1\n2\n3\n4\n");
  ExpectError(RunCorvo({"calibrate", folder_ / "noise", "--times", folder_ / "times", "--bits",
                        "12", "-o", camera_}),
              "5 images");
  EXPECT_FALSE(fs::exists(camera_));
}

TEST_F(Calibrate, ErrorsNameTheInvalidInput) {
  WriteFolder(folder_ / "noise", 3);
  WriteImage(folder_ / "large/0.png", TinyImage(0, 128, 96));
  ExpectError(RunCorvo({"calibrate", "camera:97", "-o", camera_}), "camera:97: is a live camera");
  ExpectError(RunCorvo({"calibrate", folder_ / "noise", "-o", folder_ / "noise"}),
              "is a folder; the output is written to a file");
  ExpectError(RunCorvo({"calibrate", folder_ / "noise", folder_ / "large", "-o", camera_}),
              "0.png: the image is 128 x 96 px, others 96 x 64 px");
  EXPECT_THAT(RunCorvo({"calibrate", folder_ / "noise", "-o", camera_, "--model", "omni"}).err,
              HasSubstr("--model"));
  EXPECT_THAT(RunCorvo({"calibrate", folder_ / "noise", "-o", camera_, "--focal", "auto"}).err,
              HasSubstr("--focal: is not needed"));
}

}  // namespace
}  // namespace corvo::test
