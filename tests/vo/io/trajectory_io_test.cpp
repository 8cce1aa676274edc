// SPDX-License-Identifier: MIT
#include "vo/io/trajectory_io.h"

#include <gmock/gmock.h>

#include <limits>
#include <string>

#include "tests/support/data.h"
#include "tests/support/matchers.h"
#include "tests/support/random.h"

namespace corvo {
namespace {

using test::IsMatrixNear;
using test::IsPoseNear;
using test::ThrowsError;

PoseSequence RandomPoses() {
  test::Random random(11);
  PoseSequence poses;
  TimeNs time_ns = 1403636579763555584;
  for (int i = 0; i < 50; ++i) {
    poses.push_back({time_ns, random.Pose(3.1, i % 2 == 0 ? 1e-7 : 1e5)});
    time_ns += random.UniformInt(1, 1000000000);
  }
  return poses;
}

TEST(TumTest, ReadsAKnownFile) {
  const test::TemporaryFolder dir;
  const auto file = dir.Write("a.tum",
                              "# timestamp tx ty tz qx qy qz qw\n"
                              "1.5 1 2 3 0 0 0 1\n\n"
                              "1403636579.763555584\t-1e-3 0 +4 0 0.6 0 0.8\r\n");
  const PoseSequence poses = ReadTum(file);
  ASSERT_EQ(poses.size(), 2);
  EXPECT_EQ(poses[0].time_ns, 1500000000);
  EXPECT_EQ(poses[0].world_from_camera, SE3(SO3(), Eigen::Vector3d(1, 2, 3)));
  EXPECT_EQ(poses[1].time_ns, 1403636579763555584);
  EXPECT_EQ(poses[1].world_from_camera.translation(), Eigen::Vector3d(-1e-3, 0, 4));
  EXPECT_THAT(poses[1].world_from_camera.rotation().quaternion().coeffs(),
              IsMatrixNear(Eigen::Vector4d(0, 0.6, 0, 0.8), 1e-15));
}

TEST(TumTest, WritesTheExpectedText) {
  const test::TemporaryFolder dir;
  WriteTum(dir.path() / "a.tum", {{1403636579763555584, SE3(SO3(), Eigen::Vector3d(1, -0.5, 0))}});
  EXPECT_EQ(test::ReadText(dir.path() / "a.tum"),
            "# timestamp tx ty tz qx qy qz qw\n"
            "1403636579.763555584 1 -0.5 0 0 0 0 1\n");
}

TEST(TumTest, RoundTripIsExactUpToNormalization) {
  const test::TemporaryFolder dir;
  const PoseSequence poses = RandomPoses();
  WriteTum(dir.path() / "a.tum", poses);
  const PoseSequence back = ReadTum(dir.path() / "a.tum");
  ASSERT_EQ(back.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(back[i].time_ns, poses[i].time_ns);
    EXPECT_EQ(back[i].world_from_camera.translation(), poses[i].world_from_camera.translation());
    EXPECT_THAT(back[i].world_from_camera, IsPoseNear(poses[i].world_from_camera, 1e-13, 0.0));
  }
}

TEST(TumTest, PartsFollowTheirCommentsAndAreReadAsOneTrajectory) {
  const test::TemporaryFolder dir;
  const TimedPose first{1'000'000'000, SE3()}, second{2'000'000'000, SE3(SO3(), {1, 0, 0})};
  WriteTumParts(dir.path() / "a.tum", {{"part 0", {first}}, {"part 1", {second}}});
  EXPECT_EQ(test::ReadText(dir.path() / "a.tum"),
            "# timestamp tx ty tz qx qy qz qw\n"
            "# part 0\n1.000000000 0 0 0 0 0 0 1\n"
            "# part 1\n2.000000000 1 0 0 0 0 0 1\n");
  const PoseSequence back = ReadTum(dir.path() / "a.tum");
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(back[1].world_from_camera, second.world_from_camera);
}

TEST(TumTest, EmptyTrajectoryRoundTrips) {
  const test::TemporaryFolder dir;
  WriteTum(dir.path() / "a.tum", {});
  EXPECT_TRUE(ReadTum(dir.path() / "a.tum").empty());
}

TEST(TumTest, NormalizesNearlyUnitQuaternionsOnly) {
  const test::TemporaryFolder dir;
  const PoseSequence poses = ReadTum(dir.Write("a.tum", "1 0 0 0 0 0 0 1.009\n"));
  EXPECT_EQ(poses[0].world_from_camera, SE3());
  EXPECT_THAT([&] { ReadTum(dir.Write("b.tum", "1 0 0 0 0 0 0 1.011\n")); },
              ThrowsError("b.tum:1: ", "norm is 1.011", "0.99 to 1.01"));
  EXPECT_THAT([&] { ReadTum(dir.Write("c.tum", "1 0 0 0 0 0 0 0\n")); },
              ThrowsError("c.tum:1: ", "norm is 0"));
}

TEST(TumTest, ErrorsNameFileLineAndValue) {
  const test::TemporaryFolder dir;
  const std::string good = "# comment\n1 0 0 0 0 0 0 1\n";
  const auto expect_error = [&](const std::string& line, const std::string& message) {
    EXPECT_THAT([&] { ReadTum(dir.Write("a.tum", good + line + "\n")); },
                ThrowsError("a.tum:3: ", message));
  };
  expect_error("2 0 0 0 0 0 0", "7 fields");
  expect_error("2 0 0 0 0 0 0 1 9", "9 fields");
  expect_error("2 0 x 0 0 0 0 1", "'x'");
  expect_error("2 0 nan 0 0 0 0 1", "'nan'");
  expect_error("2 0 0 0 0 0 0 inf", "'inf'");
  expect_error("two 0 0 0 0 0 0 1", "'two'");
  expect_error("1 0 0 0 0 0 0 1", "does not lie after");
  expect_error("0.999999999 0 0 0 0 0 0 1", "0.999999999 s does not lie after");
  EXPECT_THAT([&] { ReadTum(dir.path() / "none.tum"); }, ThrowsError("none.tum"));
}

TEST(TumTest, TextsAsPeopleHaveThemHoldTheSamePoses) {
  const test::TemporaryFolder dir;
  const PoseSequence expected = ReadTum(dir.Write("a.tum", "1403636579.5 1 2 3 0 0 0 1\n"));
  for (const char* text : {"\xEF\xBB\xBF"
                           "1403636579.5 1 2 3 0 0 0 1\n",
                           "timestamp tx ty tz qx qy qz qw\n1403636579.5 1 2 3 0 0 0 1",
                           "1.4036365795e+09 1 2 3 0 0 0 1\r\n", "1403636579.5,1,2,3,0,0,0,1",
                           "1403636579.5; 1; 2; 3; 0; 0; 0; 1",
                           "1403636579.5\t1\t2\t3\t0\t0\t0\t1  \r", "1403636579500 1 2 3 0 0 0 1",
                           "1403636579500000000 1 2 3 0 0 0 1", "1.4036365795e+18 1 2 3 0 0 0 1"}) {
    const PoseSequence poses = ReadTum(dir.Write("b.tum", text));
    ASSERT_EQ(poses.size(), 1) << text;
    EXPECT_EQ(poses[0].time_ns, expected[0].time_ns) << text;
    EXPECT_EQ(poses[0].world_from_camera, expected[0].world_from_camera) << text;
  }
}

TEST(TumTest, PosesThatNoComputationHoldsAreNeitherReadNorWritten) {
  const test::TemporaryFolder dir;
  EXPECT_THAT([&] { ReadTum(dir.Write("a.tum", "1 0 0 0 0 0 0 1\n2 0 1e160 0 0 0 0 1\n")); },
              ThrowsError("a.tum:2: ", "y is 1e+160", "-1e+24 to 1e+24"));
  EXPECT_THAT([&] { ReadTum(dir.Write("a.tum", "2 0 0 0 0 0 0 1e160\n")); },
              ThrowsError("a.tum:1: ", "norm"));
  EXPECT_THAT([&] { ReadKittiPoses(dir.Write("a.txt", "1 0 0 0 0 1 0 0 0 0 1 -1e160\n")); },
              ThrowsError("a.txt:1: ", "z is -1e+160"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const SE3 bad(SO3(), Eigen::Vector3d(nan, 0, 0));
  const auto file = dir.path() / "out";
  EXPECT_THAT([&] { WriteTum(file, {{1, bad}}); }, ThrowsError("out: at 0.000000001 s: x is nan"));
  EXPECT_THAT([&] { WriteTumParts(file, {{"", {{1, bad}}}}); }, ThrowsError("out", "nan"));
  EXPECT_THAT([&] { WriteKittiPoses(file, {bad}); }, ThrowsError("out", "nan"));
  EXPECT_THAT([&] { WriteEurocPoses(file, {{1, bad}}); }, ThrowsError("out", "nan"));
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(KittiTest, RowsMayBeWholeMatrices) {
  const test::TemporaryFolder dir;
  const auto poses = ReadKittiPoses(dir.Write("a.txt", "1 0 0 7 0 1 0 8 0 0 1 9 0 0 0 1\n"));
  ASSERT_EQ(poses.size(), 1);
  EXPECT_EQ(poses[0].translation(), Eigen::Vector3d(7, 8, 9));
  EXPECT_THAT([&] { ReadKittiPoses(dir.Write("a.txt", "1 0 0 7 0 1 0 8 0 0 1 9 0 0 0 2\n")); },
              ThrowsError("a.txt:1: ", "0 0 0 1"));
}

TEST(EurocTest, TimesMayHaveExponents) {
  const test::TemporaryFolder dir;
  const PoseSequence poses = ReadEurocPoses(
      dir.Write("a.csv", "time,x,y,z,qw,qx,qy,qz\n1.403636579763555584e+18,1,2,3,1,0,0,0\n"));
  ASSERT_EQ(poses.size(), 1);
  EXPECT_EQ(poses[0].time_ns, 1403636579763555584);
}

TEST(TumTest, NamesTheFileThatCannotBeWritten) {
  const test::TemporaryFolder dir;
  EXPECT_THAT([&] { WriteTum(dir.path() / "no_folder" / "a.tum", {}); },
              ThrowsError("no_folder/a.tum", "written"));
}

TEST(KittiTest, RowsHoldRotationAndTranslation) {
  const test::TemporaryFolder dir;
  const auto poses = ReadKittiPoses(dir.Write("a.txt", "0 -1 0 10 1 0 0 20 0 0 1 30\n"));
  ASSERT_EQ(poses.size(), 1);
  EXPECT_THAT(poses[0] * Eigen::Vector3d(1, 0, 0),
              IsMatrixNear(Eigen::Vector3d(10, 21, 30), 1e-14));
  WriteKittiPoses(dir.path() / "b.txt", {SE3(SO3(), Eigen::Vector3d(1, 2, 3.5))});
  EXPECT_EQ(test::ReadText(dir.path() / "b.txt"), "1 0 0 1 0 1 0 2 0 0 1 3.5\n");
}

TEST(KittiTest, RoundTrips) {
  const test::TemporaryFolder dir;
  std::vector<SE3> poses;
  for (const TimedPose& pose : RandomPoses()) poses.push_back(pose.world_from_camera);
  WriteKittiPoses(dir.path() / "a.txt", poses);
  const std::vector<SE3> back = ReadKittiPoses(dir.path() / "a.txt");
  ASSERT_EQ(back.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i)
    EXPECT_THAT(back[i], IsPoseNear(poses[i], 1e-12, 0.0));
}

TEST(KittiTest, ErrorsNameFileLineAndValue) {
  const test::TemporaryFolder dir;
  const auto expect_error = [&](const std::string& line, const std::string& message) {
    EXPECT_THAT([&] { ReadKittiPoses(dir.Write("a.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n" + line)); },
                ThrowsError("a.txt:2: ", message));
  };
  expect_error("1 0 0 0 0 1 0 0 0 0 1", "11 fields");
  expect_error("1 0 0 0 0 1 0 0 0 0 1 nan", "'nan'");
  expect_error("1 0 0 0 0 1 0 0 0 0 -1 0", "not a rotation");
  EXPECT_THAT([&] { ReadKittiTimes(dir.Write("t.txt", "0\n0.1\n0.1\n")); },
              ThrowsError("t.txt:3: "));
  EXPECT_THAT([&] { ReadKittiTimes(dir.Write("t.txt", "0 1\n")); },
              ThrowsError("t.txt:1: ", "2 fields"));
}

TEST(KittiTest, NumbersOfTimesAndPosesMustBeEqual) {
  EXPECT_THAT([] { WithTimes({SE3(), SE3()}, {1}); }, ThrowsError("2 poses, but 1 times"));
  const PoseSequence poses = WithTimes({SE3(), SE3(SO3(), Eigen::Vector3d(1, 2, 3))}, {5, 7});
  EXPECT_EQ(poses[1].time_ns, 7);
  EXPECT_EQ(poses[1].world_from_camera.translation(), Eigen::Vector3d(1, 2, 3));
}

TEST(EurocTest, QuaternionsHaveTheirRealPartFirst) {
  const test::TemporaryFolder dir;
  const PoseSequence poses = ReadEurocPoses(
      dir.Write("data.csv", "#timestamp, p_x\n1403636584313555479,1,2,3,0.8,0.6,0,0,9,9\n"));
  ASSERT_EQ(poses.size(), 1);
  EXPECT_EQ(poses[0].time_ns, 1403636584313555479);
  EXPECT_THAT(poses[0].world_from_camera.data(),
              IsMatrixNear((SE3::Data() << 0.6, 0, 0, 0.8, 1, 2, 3).finished(), 1e-15));
  EXPECT_THAT([&] { ReadEurocPoses(dir.Write("bad.csv", "1,2,3\n")); },
              ThrowsError("bad.csv:1: 3 fields"));
}

TEST(EurocTest, RoundTrips) {
  const test::TemporaryFolder dir;
  const PoseSequence poses = RandomPoses();
  WriteEurocPoses(dir.path() / "a.csv", poses);
  EXPECT_THAT(test::ReadText(dir.path() / "a.csv"),
              ::testing::StartsWith("#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w [],q_x []"));
  const PoseSequence back = ReadEurocPoses(dir.path() / "a.csv");
  ASSERT_EQ(back.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(back[i].time_ns, poses[i].time_ns);
    EXPECT_THAT(back[i].world_from_camera, IsPoseNear(poses[i].world_from_camera, 1e-13, 0.0));
  }
}

TEST(TumTest, ReadTumWithGapsSkipsNanPoses) {
  const test::TemporaryFolder dir;
  const auto file = dir.Write("a.txt",
                              "1 0 0 0 0 0 0 1\n2 NaN NaN NaN NaN NaN NaN NaN\n"
                              "3 nan nan nan nan nan nan nan\n4 5 0 0 0 0 0 1\n");
  const PoseSequence poses = ReadTumWithGaps(file);
  ASSERT_EQ(poses.size(), 2);
  EXPECT_EQ(poses[1].world_from_camera.translation().x(), 5);
  EXPECT_THAT([&] { ReadTumWithGaps(dir.Write("b.txt", "1 0 0\n")); }, ThrowsError("b.txt:1: 3"));
}

TEST(TrajectoryDataTest, GroundTruthOfTheDatasetsIsReadable) {
  CORVO_REQUIRE_DATA("kitti/poses/03.txt");
  const auto kitti = WithTimes(ReadKittiPoses(test::DataPath("kitti/poses/03.txt")),
                               ReadKittiTimes(test::DataPath("kitti/sequences/03/times.txt")));
  EXPECT_EQ(kitti.size(), 300);
  EXPECT_EQ(ReadTum(test::DataPath("7scenes/redkitchen/groundtruth.txt")).size(), 500);
  EXPECT_FALSE(ReadTum(test::DataPath("tum/rgbd_dataset_freiburg1_rpy/groundtruth.txt")).empty());
  const auto body =
      ReadEurocPoses(test::DataPath("euroc/MH_01_easy/mav0/state_groundtruth_estimate0/data.csv"));
  EXPECT_GE(body.size(), 140);
}

}  // namespace
}  // namespace corvo
