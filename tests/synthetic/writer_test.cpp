// SPDX-License-Identifier: MIT
#include "apps/synthetic/writer.h"

#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include "apps/dataset/ground_truth.h"
#include "apps/dataset/image_source.h"
#include "tests/cli/expect_error.h"
#include "tests/data/temporary_folder.h"
#include "tests/support/data.h"
#include "tests/support/matchers.h"
#include "vo/io/config.h"
#include "vo/io/trajectory_io.h"

namespace corvo::synthetic {
namespace {

using test::ErrorOf;
using test::IsMatrixNear;
using test::IsPoseNear;
using test::ReadText;
using test::TemporaryFolder;
using test::WriteText;
using ::testing::AllOf;
using ::testing::HasSubstr;

Sequence ShortWall(int frames = 3) {
  SequenceOptions options;
  options.frames = frames;
  options.width = 128;
  return MakePlanarWall(options);
}

void ExpectSameImages(const ImageList& list, const Sequence& sequence) {
  ASSERT_EQ(list.images.size(), static_cast<std::size_t>(sequence.size()));
  for (int i = 0; i < sequence.size(); ++i) {
    const TimedFile& file = list.images[static_cast<std::size_t>(i)];
    EXPECT_EQ(file.time_ns, sequence.poses()[static_cast<std::size_t>(i)].time_ns);
    EXPECT_EQ(cv::norm(ReadGrayImage(file.file), sequence.Render(i), cv::NORM_INF), 0);
  }
}

TEST(WriteSequence, TumLayoutIsReadBack) {
  const TemporaryFolder folder;
  const Sequence sequence = ShortWall();
  WriteSequence(sequence, folder / "new", Layout::kTum);
  const ImageList list = ListImages(folder / "new");
  EXPECT_EQ(list.layout, "tum");
  ExpectSameImages(list, sequence);
}

TEST(WriteSequence, KittiLayoutIsReadBack) {
  const TemporaryFolder folder;
  const Sequence sequence = ShortWall();
  WriteSequence(sequence, folder.path(), Layout::kKitti);
  const ImageList list = ListImages(folder / "sequences/00");
  EXPECT_EQ(list.layout, "kitti");
  ExpectSameImages(list, sequence);
  EXPECT_EQ(list.camera, sequence.camera().parameters());
}

TEST(WriteSequence, EurocLayoutIsReadBack) {
  SequenceOptions options;
  options.frames = 3;
  for (const CameraModel model : {CameraModel::kPinhole, CameraModel::kKb4}) {
    const TemporaryFolder folder;
    options.camera = ShortWall().camera().parameters();
    options.camera->model = model;
    options.camera->k1 = -0.2;
    (model == CameraModel::kKb4 ? options.camera->k4 : options.camera->p2) = 0.001;
    const Sequence sequence = MakePlanarWall(options);
    WriteSequence(sequence, folder.path(), Layout::kEuroc);
    const ImageList list = ListImages(folder / "mav0");
    EXPECT_EQ(list.layout, "euroc");
    ExpectSameImages(list, sequence);
    EXPECT_EQ(list.camera, sequence.camera().parameters());
  }
}

TEST(WriteSequence, EurocGroundTruthIsOfTheBodyAndConvertsBackToTheCamera) {
  const TemporaryFolder folder;
  const Sequence sequence = ShortWall();
  WriteSequence(sequence, folder.path(), Layout::kEuroc);
  const auto file = FindGroundTruth(folder / "mav0");
  ASSERT_FALSE(file.empty());
  EXPECT_GT(ReadEurocPoses(file)[0].world_from_camera.rotation().Angle(), 1);
  const PoseSequence truth = ReadGroundTruth(file, {});
  ASSERT_EQ(truth.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(truth[i].time_ns, sequence.poses()[i].time_ns);
    EXPECT_THAT(truth[i].world_from_camera,
                IsPoseNear(sequence.poses()[i].world_from_camera, 1e-6, 1e-9));
  }
}

TEST(WriteSequence, RejectsCamerasThatTheLayoutCannotDescribe) {
  const TemporaryFolder folder;
  SequenceOptions options;
  options.frames = 1;
  options.camera = ShortWall().camera().parameters();
  options.camera->k1 = 0.01;
  EXPECT_THAT(
      ErrorOf([&] { WriteSequence(MakePlanarWall(options), folder / "kitti", Layout::kKitti); }),
      HasSubstr("layout kitti"));
  options.camera->model = CameraModel::kFov;
  options.camera->k1 = 0;
  options.camera->omega = 0.5;
  EXPECT_THAT(
      ErrorOf([&] { WriteSequence(MakePlanarWall(options), folder / "euroc", Layout::kEuroc); }),
      AllOf(HasSubstr("layout euroc"), HasSubstr("fov")));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  WriteSequence(MakePlanarWall(options), folder / "tum", Layout::kTum);
  EXPECT_EQ(ReadCameraFile(folder / "tum/camera.yaml").camera.parameters(), *options.camera);
}

TEST(WriteSequence, TumGroundTruthIsExact) {
  const TemporaryFolder folder;
  const Sequence sequence = ShortWall();
  WriteSequence(sequence, folder.path(), Layout::kTum);
  std::istringstream truth(ReadText(folder / "groundtruth.txt"));
  std::string comment, seconds;
  std::getline(truth, comment);
  for (const TimedPose& pose : sequence.poses()) {
    double t[3], q[4];
    truth >> seconds >> t[0] >> t[1] >> t[2] >> q[0] >> q[1] >> q[2] >> q[3];
    const double data[] = {q[0], q[1], q[2], q[3], t[0], t[1], t[2]};
    EXPECT_THAT(SE3::FromData(data), IsPoseNear(pose.world_from_camera, 1e-5, 1e-12));
  }
  EXPECT_EQ(seconds, "0.066666667");
}

TEST(WriteSequence, KittiGroundTruthIsExact) {
  const TemporaryFolder folder;
  const Sequence sequence = ShortWall();
  WriteSequence(sequence, folder.path(), Layout::kKitti);
  std::istringstream truth(ReadText(folder / "poses/00.txt"));
  for (const TimedPose& pose : sequence.poses()) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    for (int i = 0; i < 12; ++i) truth >> matrix(i / 4, i % 4);
    EXPECT_THAT(matrix, IsMatrixNear(pose.world_from_camera.matrix(), 1e-14));
  }
}

TEST(WriteSequence, WritesTheCameraFile) {
  const TemporaryFolder folder;
  WriteSequence(ShortWall(), folder.path(), Layout::kTum);
  EXPECT_EQ(ReadText(folder / "camera.yaml"),
            "model: pinhole-radtan\nwidth: 128\nheight: 96\nfx: 105\nfy: 105\ncx: 63.5\ncy: 47.5\n"
            "k1: 0\nk2: 0\np1: 0\np2: 0\nk3: 0\nframe_rate_hz: 30\n");
}

TEST(WriteSequence, ReplacesASequenceThatItWrote) {
  const TemporaryFolder folder;
  WriteSequence(ShortWall(3), folder.path(), Layout::kTum);
  WriteText(folder / "notes.txt", "mine");
  WriteSequence(ShortWall(2), folder.path(), Layout::kTum);
  EXPECT_EQ(ListImages(folder.path()).images.size(), 2u);
  EXPECT_FALSE(std::filesystem::exists(folder / "rgb/0.066666667.png"));
  EXPECT_EQ(ReadText(folder / "notes.txt"), "mine");
}

TEST(WriteSequence, RefusesToOverwriteForeignFiles) {
  const TemporaryFolder folder;
  WriteText(folder / "groundtruth.txt", "mine");
  EXPECT_THAT(ErrorOf([&] { WriteSequence(ShortWall(), folder.path(), Layout::kTum); }),
              AllOf(HasSubstr(folder.path().string()), HasSubstr("--force")));
  EXPECT_EQ(ReadText(folder / "groundtruth.txt"), "mine");
}

TEST(WriteSequence, OverwritesForeignFilesIfForced) {
  const TemporaryFolder folder;
  WriteText(folder / "groundtruth.txt", "mine");
  WriteText(folder / "notes.txt", "mine");
  WriteSequence(ShortWall(), folder.path(), Layout::kTum, true);
  EXPECT_NE(ReadText(folder / "groundtruth.txt"), "mine");
  EXPECT_EQ(ReadText(folder / "notes.txt"), "mine");
}

TEST(WriteSequence, RejectsATargetThatIsNotAFolder) {
  const TemporaryFolder folder;
  WriteText(folder / "file", "");
  EXPECT_THAT(ErrorOf([&] { WriteSequence(ShortWall(), folder / "file", Layout::kTum); }),
              HasSubstr("is not a folder"));
}

TEST(WriteSequence, ReportsProgress) {
  const TemporaryFolder folder;
  std::vector<int> done;
  WriteSequence(ShortWall(), folder.path(), Layout::kTum, false, [&](int n) { done.push_back(n); });
  EXPECT_THAT(done, ::testing::ElementsAre(1, 2, 3));
}

}  // namespace
}  // namespace corvo::synthetic
