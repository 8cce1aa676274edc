// SPDX-License-Identifier: MIT
// These tests cover the values of --camera that are not a camera file of corvo.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "apps/dataset/image_source.h"
#include "apps/run/run_inputs.h"
#include "apps/system/interruption.h"
#include "tests/cli/command.h"
#include "tests/cli/expect_error.h"
#include "tests/cli/tiny_sequence.h"
#include "tests/data/data_path.h"
#include "tests/support/data.h"
#include "vo/io/config.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr int kNotCalibrated = 2;

class NamedCamera : public testing::Test {
 protected:
  NamedCamera() { WriteFolder(images_, 3); }

  RunInputs InputsWith(const std::string& text) {
    WriteText(folder_ / "calibration", text);
    arguments_.input = images_;
    arguments_.output = folder_ / "result";
    if (arguments_.camera.empty()) arguments_.camera = folder_ / "calibration";
    return ReadInputs(arguments_, Interruption());
  }

  CommandResult RunWith(const std::string& camera) const {
    return RunCorvo({"run", images_, "--camera", camera, "-o", folder_ / "result"});
  }

  TemporaryFolder folder_;
  const fs::path images_ = folder_ / "images";
  RunArguments arguments_;
};

TEST_F(NamedCamera, WithoutASizeHasThatOfTheImages) {
  const CameraParameters camera = InputsWith("80 81 47 31\n").camera.given;
  EXPECT_EQ(camera.width, kTinyWidth);
  EXPECT_EQ(camera.height, kTinyHeight);
  EXPECT_EQ(camera.fx, 80);
}

TEST_F(NamedCamera, WithoutASizeIsThatOfTheImagesBeforeTheyAreResized) {
  arguments_.resize = "0.5";
  const CameraParameters camera = InputsWith("80 81 47 31\n").camera.given;
  EXPECT_EQ(camera.width, kTinyWidth / 2);
  EXPECT_EQ(camera.fx, 40);
  EXPECT_EQ(camera.cx, 23.25);  // (47 + 0.5) / 2 - 0.5
}

TEST_F(NamedCamera, GivesTheFrameRateOfImagesWithoutTimestamps) {
  const std::string settings =
      "%YAML:1.0\nCamera.fx: 80\nCamera.fy: 81\nCamera.cx: 47\nCamera.cy: 31\nCamera.fps: 5\n";
  EXPECT_EQ(InputsWith(settings).source.list().images.at(1).time_ns, 200'000'000);
}

TEST_F(NamedCamera, OfOtherSizeThanTheImagesIsAnError) {
  EXPECT_THAT(ErrorOf([&] { InputsWith("1 PINHOLE 640 480 520 510 320 240\n"); }),
              AllOf(HasSubstr("96 x 64 px"), HasSubstr("640 x 480 px")));
}

TEST_F(NamedCamera, IsTheFirstOrTheNamedOneOfAFile) {
  WriteText(folder_ / "cameras.txt",
            "1 PINHOLE 96 64 80 81 47.5 31.5\n2 PINHOLE 96 64 90 91 47.5 31.5\n");
  const std::string file = folder_ / "cameras.txt";
  const auto summary = [&] {
    return nlohmann::json::parse(ReadText(folder_ / "result/summary.json"));
  };
  const CommandResult first = RunWith(file);
  EXPECT_EQ(first.exit_code, kNeverInitialized) << first.err;
  EXPECT_THAT(first.out + first.err, HasSubstr("the first of 2 cameras, 1, is used"));
  EXPECT_EQ(summary()["camera"]["fx"], 80.0);
  const CommandResult second = RunWith(file + ":2");
  EXPECT_EQ(second.exit_code, kNeverInitialized) << second.err;
  EXPECT_THAT(second.out + second.err, Not(HasSubstr("is used")));
  EXPECT_EQ(summary()["camera"]["fx"], 90.0);
  EXPECT_THAT(RunWith(file + ":3").err, HasSubstr("holds no camera 3; it holds 1, 2"));
}

TEST_F(NamedCamera, MayBeShippedWithCorvo) {
  for (int i = 0; i < 3; ++i) {
    WriteImage(images_ / (std::to_string(i) + ".png"), TinyImage(i, 640, 480));
  }
  for (const std::string name : {"tum_fr1", "tum_fr1.yaml"}) {
    const CommandResult result = RunWith(name);
    EXPECT_EQ(result.exit_code, kNeverInitialized) << result.err;
    const nlohmann::json summary = nlohmann::json::parse(ReadText(folder_ / "result/summary.json"));
    EXPECT_EQ(summary["camera"]["fx"],
              ReadCameraFile(SourceDir() / "configs/tum_fr1.yaml").camera.fx());
  }
}

TEST_F(NamedCamera, OfUnknownNameIsAnErrorThatListsTheShippedOnes) {
  const CommandResult result = RunWith("tum_fr9");
  EXPECT_EQ(result.exit_code, kBadInput);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("tum_fr9: there is no such file"), HasSubstr("7scenes, euroc"),
                    HasSubstr("tum_fr1, tum_fr2, tum_fr3"), Not(HasSubstr("default"))));
  EXPECT_THAT(RunWith("missing.yaml").err, HasSubstr("missing.yaml: cannot be read"));
  EXPECT_THAT(RunWith((folder_ / "missing").string()).err, HasSubstr("missing: cannot be read"));
}

TEST_F(NamedCamera, OfAFileIsPreferredToAShippedOne) {
  const fs::path here = fs::current_path();
  fs::current_path(folder_.path());
  WriteText(fs::path(".") / "tum_fr1", "80 81 47 31\n");
  const CommandResult result = RunWith("tum_fr1");
  fs::current_path(here);
  EXPECT_EQ(result.exit_code, kNeverInitialized) << result.err;
}

TEST_F(NamedCamera, OfSyntheticImagesNeedsASize) {
  const auto synth = [&](const std::string& camera) {
    return RunCorvo({"synth", "wall", "-o", folder_ / "out", "--frames", "1", "--camera", camera});
  };
  WriteText(folder_ / "droid.txt", "80 81 47 31\n");
  EXPECT_THAT(synth(folder_ / "droid.txt").err, HasSubstr("droid.txt: states no image size"));
  WriteText(folder_ / "cameras.txt", "1 PINHOLE 96 64 80 81 47.5 31.5\n");
  const CommandResult result = synth(folder_ / "cameras.txt");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(ReadCameraFile(folder_ / "out/camera.yaml").camera.fx(), 80);
}

TEST(Datasets, ShipCalibrationsInAnyForm) {
  const TemporaryFolder folder;
  WriteKitti(folder.path(), 2);
  WriteText(folder / "calib.txt",
            "P0: 80 0 47 0 0 81 31 0 0 0 1 0\nP2: 90 0 47 0 0 91 31 0 0 0 1 0\n");
  EXPECT_EQ(ListImages(folder.path()).camera->fx, 80);
  fs::rename(folder / "image_0", folder / "image_2");
  EXPECT_EQ(ListImages(folder.path()).camera->fx, 90);
  const TemporaryFolder euroc;
  WriteEuroc(euroc / "mav0", 2);
  WriteText(euroc / "mav0/cam0/sensor.yaml",
            "%YAML:1.0\nCamera.fx: 80\nCamera.fy: 81\nCamera.cx: 47\nCamera.cy: 31\n");
  const CameraParameters camera = *ListImages(euroc.path()).camera;
  EXPECT_EQ(camera.fx, 80);
  EXPECT_EQ(camera.width, kTinyWidth);
}

TEST(Datasets, OfKittiRawHaveTheCameraOfTheFolderAndImageSize) {
  const TemporaryFolder folder;
  const fs::path images = folder / "2011_09_26/drive_0001_sync/image_02";
  WriteText(images / "timestamps.txt", "2011-09-26 13:02:25.9\n2011-09-26 13:02:26.0\n");
  for (const int i : {0, 1}) WriteImage(images / "data" / fmt::format("{}.png", i), TinyImage(i));
  EXPECT_FALSE(ListImages(images).camera);
  const auto calibration = [](const std::string& rectified, const std::string& raw) {
    return "S_02: " + raw +
           "\nK_02: 70 0 47 0 71 31 0 0 1\nD_02: -0.3 0.1 0 0 0\nS_rect_00: " + rectified +
           "\nP_rect_00: 60 0 47 0 0 61 31 0 0 0 1 0\nS_rect_02: " + rectified +
           "\nP_rect_02: 80 0 47 9 0 81 31 0 0 0 1 0\n";
  };
  const fs::path file = folder / "2011_09_26/calib_cam_to_cam.txt";
  WriteText(file, calibration("96 64", "100 70"));
  EXPECT_EQ(ListImages(images.parent_path()).camera->fx, 80);
  EXPECT_EQ(ListImages(images / "data").camera->k1, 0);
  WriteText(file, calibration("90 60", "96 64"));
  EXPECT_EQ(ListImages(images).camera->fx, 70);
  EXPECT_EQ(ListImages(images).camera->k1, -0.3);
  WriteText(file, calibration("90 60", "100 70"));
  EXPECT_EQ(ListImages(images).camera->width, 90) << "of other size than the images";
}

/// Writes a sequence whose calibration is malformed, in a layout of which corvo reads one.
fs::path WriteUncalibrated(const std::string& layout, const TemporaryFolder& folder) {
  if (layout == "kitti") {
    WriteKitti(folder.path(), 2);
    WriteText(folder / "calib.txt", "P0: 80 0 47.5 0 0 eighty 31.5 0 0 0 1 0\n");
    return folder.path();
  }
  if (layout == "euroc") {
    WriteEuroc(folder / "mav0", 2);
    WriteText(folder / "mav0/cam0/sensor.yaml", "intrinsics: [80, eighty, 47, 31]\n");
    return folder.path();
  }
  const bool is_raw = layout == "kitti-raw";
  const fs::path sequence = folder / (is_raw ? "2011_09_26/drive" : "mono");
  const fs::path images = sequence / (is_raw ? "image_00/data" : "images");
  for (const int i : {0, 1}) WriteImage(images / fmt::format("{}.png", i), TinyImage(i));
  if (is_raw) {
    WriteText(images.parent_path() / "timestamps.txt",
              "2011-09-26 13:02:25\n2011-09-26 13:02:26\n");
    WriteText(folder / "2011_09_26/calib_cam_to_cam.txt", "P_rect_00: eighty\n");
  } else {
    WriteText(sequence / "times.txt", "0 1.0 1\n1 1.1 1\n");
    WriteText(sequence / "camera.txt", "eighty\n");
  }
  return sequence;
}

/// Parameters: the layout of a dataset and the name of its calibration.
class MalformedCalibration : public testing::TestWithParam<std::pair<const char*, const char*>> {
 protected:
  MalformedCalibration() {
    arguments_.input = WriteUncalibrated(GetParam().first, folder_);
    arguments_.output = folder_ / "result";
  }

  TemporaryFolder folder_;
  RunArguments arguments_;
};

TEST_P(MalformedCalibration, OfADatasetIsAnError) {
  EXPECT_THAT(ErrorOf([&] { ReadInputs(arguments_, Interruption()); }),
              HasSubstr(GetParam().second));
}

TEST_P(MalformedCalibration, IsNotReadIfAnotherCameraReplacesIt) {
  WriteText(folder_ / "camera", "80 81 47 31\n");
  arguments_.camera = folder_ / "camera";
  const RunInputs given = ReadInputs(arguments_, Interruption());
  EXPECT_EQ(given.camera.given.fx, 80);
  EXPECT_EQ(given.source.list().layout, GetParam().first);
  arguments_.camera.clear();
  arguments_.focal = "90";
  EXPECT_EQ(ReadInputs(arguments_, Interruption()).camera.given.fx, 90);
  arguments_.focal.clear();
  arguments_.fov_deg = 60;
  EXPECT_NO_THROW(ReadInputs(arguments_, Interruption()));
}

INSTANTIATE_TEST_SUITE_P(OfLayout, MalformedCalibration,
                         testing::Values(std::pair("kitti", "calib.txt"),
                                         std::pair("kitti-raw", "calib_cam_to_cam.txt"),
                                         std::pair("euroc", "sensor.yaml"),
                                         std::pair("tum-mono", "camera.txt")));

TEST(Datasets, MalformedCalibrationIsNotReadForACalibrationFromTheImages) {
  const TemporaryFolder folder;
  const CommandResult result =
      RunCorvo({"calibrate", WriteUncalibrated("kitti", folder), "-o", folder / "found.yaml"});
  EXPECT_EQ(result.exit_code, kNotCalibrated) << result.err;
}

TEST(Datasets, OfTheRightTumViCameraHaveItsCalibration) {
  const TemporaryFolder folder;
  WriteEuroc(folder / "mav0", 2);
  fs::rename(folder / "mav0/cam0", folder / "mav0/cam1");
  fs::remove(folder / "mav0/cam1/sensor.yaml");
  std::string chain;
  for (const int i : {0, 1}) {
    chain += fmt::format(
        "cam{}:\n  camera_model: pinhole\n  distortion_model: none\n  distortion_coeffs: []\n"
        "  intrinsics: [{}, 81, 47, 31]\n  resolution: [96, 64]\n",
        i, 80 + i);
  }
  WriteText(folder / "dso/camchain.yaml", chain);
  EXPECT_EQ(ListImages(folder.path()).camera->fx, 81);
}

}  // namespace
}  // namespace corvo::test
