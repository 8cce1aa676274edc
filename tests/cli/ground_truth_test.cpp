// SPDX-License-Identifier: MIT
#include "apps/dataset/ground_truth.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/cli/expect_error.h"
#include "tests/data/temporary_folder.h"
#include "tests/support/matchers.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kTumLine = "1 0 0 0 0 0 0 1\n";
constexpr const char* kBodyLine = "1000000000,1,2,3,1,0,0,0,9,9,9\n";

/// The body's x, y and z axes are the camera's z, -x and -y axes; the camera is at (0.5, 0, 0).
constexpr const char* kBodyFromCamera = "0, 0, 1, 0.5, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 1";

class GroundTruth : public testing::Test {
 protected:
  fs::path Add(const std::string& name, const std::string& text) const {
    WriteText(folder_ / name, text);
    return folder_ / name;
  }

  TemporaryFolder folder_;
};

TEST_F(GroundTruth, IsFoundInEveryLayout) {
  const auto expect_found = [&](const std::string& file, const std::string& input) {
    const fs::path truth = Add(file, kTumLine);
    EXPECT_EQ(FindGroundTruth(folder_ / input), truth) << file;
    EXPECT_EQ(FindGroundTruth(folder_ / (input + "/")), truth) << file;
  };
  fs::create_directories(folder_ / "kitti/sequences/03");
  expect_found("kitti/poses/03.txt", "kitti/sequences/03");
  expect_found("mh/mav0/state_groundtruth_estimate0/data.csv", "mh");
  expect_found("mh/mav0/state_groundtruth_estimate0/data.csv", "mh/mav0");
  fs::create_directories(folder_ / "vi/mav0");
  expect_found("vi/dso/gt_imu.csv", "vi/mav0");
  expect_found("vi/mav0/mocap0/data.csv", "vi");
  expect_found("rgbd/groundtruth.txt", "rgbd");
  expect_found("mono/groundtruthSync.txt", "mono");
}

TEST_F(GroundTruth, IsNotFoundElsewhere) {
  Add("poses/03.txt", kTumLine);
  Add("images/0.png", "");
  EXPECT_EQ(FindGroundTruth(folder_ / "images"), fs::path());
  EXPECT_EQ(FindGroundTruth(folder_ / "none"), fs::path());
  EXPECT_EQ(FindGroundTruth(folder_ / "images/0.png"), fs::path());
}

TEST_F(GroundTruth, EurocBodyPosesAreConvertedToCameraPoses) {
  const fs::path file = Add("mav0/state_groundtruth_estimate0/data.csv", kBodyLine);
  Add("mav0/cam0/sensor.yaml",
      fmt::format("%YAML:1.0\nT_BS:\n  cols: 4\n  rows: 4\n  data: [{}]\n", kBodyFromCamera));
  const PoseSequence poses = ReadGroundTruth(file, {});
  ASSERT_EQ(poses.size(), 1);
  EXPECT_THAT(poses[0].world_from_camera * Eigen::Vector3d::Zero(),
              IsMatrixNear(Eigen::Vector3d(1.5, 2, 3), 1e-12));
  EXPECT_THAT(poses[0].world_from_camera * Eigen::Vector3d(0, 0, 1),
              IsMatrixNear(Eigen::Vector3d(2.5, 2, 3), 1e-12));
}

TEST_F(GroundTruth, TumViBodyPosesAreConvertedToCameraPoses) {
  const fs::path file = Add("vi/mav0/mocap0/data.csv", kBodyLine);
  Add("vi/dso/camchain.yaml",
      "cam0:\n  T_cam_imu:\n  - [0, -1, 0, 0]\n  - [0, 0, -1, 0]\n  - [1, 0, 0, -0.5]\n"
      "  - [0, 0, 0, 1]\n");
  EXPECT_THAT(ReadGroundTruth(file, {}).at(0).world_from_camera * Eigen::Vector3d(0, 0, 1),
              IsMatrixNear(Eigen::Vector3d(2.5, 2, 3), 1e-12));
}

TEST_F(GroundTruth, BodyPosesRequireTheCameraExtrinsics) {
  const fs::path file = Add("mav0/state_groundtruth_estimate0/data.csv", kBodyLine);
  EXPECT_THAT(
      ErrorOf([&] { ReadGroundTruth(file, {}); }),
      AllOf(HasSubstr("data.csv: contains poses of the body"), HasSubstr("cam0/sensor.yaml")));
  Add("mav0/cam0/sensor.yaml", "T_BS: [1, 2]\n");
  EXPECT_THAT(ErrorOf([&] { ReadGroundTruth(file, {}); }),
              HasSubstr("sensor.yaml: T_BS has 2 numbers"));
  Add("mav0/cam0/sensor.yaml", "T_BS: [1, 2, what]\n");
  EXPECT_THAT(ErrorOf([&] { ReadGroundTruth(file, {}); }), HasSubstr("sensor.yaml: "));
}

TEST_F(GroundTruth, KittiPosesMustMatchTheNumberOfFrames) {
  const fs::path file = Add("03.txt", "1 0 0 7 0 1 0 0 0 0 1 0\n1 0 0 8 0 1 0 0 0 0 1 0\n");
  const PoseSequence poses = ReadGroundTruth(file, {5, 9});
  ASSERT_EQ(poses.size(), 2);
  EXPECT_EQ(poses[1].time_ns, 9);
  EXPECT_EQ(poses[1].world_from_camera.translation().x(), 8);
  EXPECT_THAT(ErrorOf([&] {
                ReadGroundTruth(file, {1, 2, 3});
              }),
              HasSubstr("03.txt: 2 poses for a sequence of 3 frames"));
}

TEST_F(GroundTruth, SevenScenesPosesAreReadFromOneFilePerFrame) {
  const char* matrix = "1 0 0 {}\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  Add("seq-01/frame-2.pose.txt", fmt::format(fmt::runtime(matrix), 8));
  Add("seq-01/frame-10.pose.txt", fmt::format(fmt::runtime(matrix), 9));
  const fs::path truth = FindGroundTruth(folder_ / "seq-01");
  EXPECT_EQ(truth, folder_ / "seq-01");
  const PoseSequence poses = ReadGroundTruth(truth, {5, 6});
  ASSERT_EQ(poses.size(), 2);
  EXPECT_EQ(poses[1].world_from_camera.translation().x(), 9);
  EXPECT_THAT(ErrorOf([&] { ReadGroundTruth(truth, {5}); }), HasSubstr("seq-01: 2 poses for"));
  Add("seq-01/frame-11.pose.txt", "1 2 3\n");
  EXPECT_THAT(ErrorOf([&] { ReadGroundTruth(truth, {5}); }),
              HasSubstr("frame-11.pose.txt: 3 numbers"));
}

TEST_F(GroundTruth, TumMonoPosesThatAreNanAreSkipped) {
  const fs::path file = Add("groundtruthSync.txt",
                            "1 0 0 0 0 0 0 1\n2 NaN NaN NaN NaN NaN NaN NaN\n3 1 0 0 0 0 0 1\n");
  EXPECT_EQ(ReadGroundTruth(file, {}).size(), 2);
}

}  // namespace
}  // namespace corvo::test
