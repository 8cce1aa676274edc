// SPDX-License-Identifier: MIT
#include "apps/dataset/image_layouts.h"

#include <fmt/format.h>

#include "apps/dataset/ground_truth.h"
#include "apps/dataset/image_source.h"
#include "tests/cli/expect_error.h"
#include "tests/cli/tiny_sequence.h"
#include "tests/support/matchers.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<TimeNs> TimesOf(const ImageList& list) {
  std::vector<TimeNs> times;
  for (const TimedFile& image : list.images) times.push_back(image.time_ns);
  return times;
}

std::string ErrorOfListing(const fs::path& input, const InputOptions& options = {}) {
  return ErrorOf([&] { ListImages(input, options); });
}

class Layouts : public testing::Test {
 protected:
  fs::path Folder() const { return folder_.path(); }

  void AddImages(const std::string& subfolder, const std::vector<std::string>& names) const {
    for (const std::string& name : names) WriteImage(folder_ / subfolder / name, TinyImage(1));
  }

  TemporaryFolder folder_;
};

TEST_F(Layouts, TimesInNamesAreUsedUnlessAFrameRateIsGiven) {
  AddImages("ns", {"1403636579763555584.png", "1403636579813555456.png"});
  AddImages("us", {"1403636579763555.png", "1403636579813555.png"});
  AddImages("s", {"1305031102.175304.png", "1305031102.211214.png"});
  AddImages("dates", {"20260101120000.png", "20260101120001.png"});
  EXPECT_THAT(TimesOf(ListImages(Folder() / "ns")),
              ElementsAre(1403636579763555584, 1403636579813555456));
  EXPECT_THAT(TimesOf(ListImages(Folder() / "us/*.png")),
              ElementsAre(1403636579763555000, 1403636579813555000));
  EXPECT_THAT(TimesOf(ListImages(Folder() / "s")),
              ElementsAre(1305031102175304000, 1305031102211214000));
  EXPECT_THAT(TimesOf(ListImages(Folder() / "dates")), ElementsAre(0, 33333333));
  InputOptions options;
  options.frame_rate_hz = 10;
  EXPECT_THAT(TimesOf(ListImages(Folder() / "ns", options)), ElementsAre(0, 100000000));
}

TEST_F(Layouts, AFileOfTimesReplacesAllOthers) {
  AddImages("", {"a.png", "b.png"});
  InputOptions options;
  options.times = folder_ / "times";
  for (const char* text : {"12.5\n12.75\n", "a.png 12.5\nb.png 12.75\n", "12.5 a\n12.75 b\n",
                           "time,name\n12.5,x/a.png\n12.75,x/b.png\n"}) {
    WriteText(options.times, text);
    EXPECT_THAT(TimesOf(ListImages(Folder(), options)), ElementsAre(12500000000, 12750000000))
        << text;
  }
  WriteText(options.times, "1403636579763555584\n1403636579813555456\n");
  EXPECT_THAT(TimesOf(ListImages(Folder(), options)),
              ElementsAre(1403636579763555584, 1403636579813555456));
  WriteText(options.times, "1\n");
  EXPECT_THAT(ErrorOfListing(Folder(), options), HasSubstr("times: 1 timestamps for 2 images"));
  WriteText(options.times, "1 b.png\n2 a.png\n");
  EXPECT_THAT(ErrorOfListing(Folder(), options), HasSubstr("times:1: '1 b.png'"));
  WriteText(options.times, "2\n1\n");
  EXPECT_THAT(ErrorOfListing(Folder(), options), HasSubstr("is not later"));
}

TEST_F(Layouts, AnyCameraOfKittiIsReadAndTimesMayBeMissing) {
  AddImages("color/image_3", {"000000.png", "000001.png"});
  WriteText(folder_ / "color/calib.txt",
            "P2: 70 0 47.5 0 0 71 31.5 0 0 0 1 0\nP3: 80 0 47.5 -9 0 81 31.5 0 0 0 1 0\n");
  const ImageList list = ListImages(Folder() / "color");
  EXPECT_EQ(list.layout, "kitti");
  ASSERT_TRUE(list.camera);
  EXPECT_EQ(list.camera->fx, 80);
  EXPECT_EQ(list.camera->width, kTinyWidth);
  EXPECT_THAT(TimesOf(list), ElementsAre(0, 33333333));
  WriteText(folder_ / "color/times.txt", "0\n0.5\n");
  EXPECT_THAT(TimesOf(ListImages(Folder() / "color")), ElementsAre(0, 500000000));
}

TEST_F(Layouts, EurocWithoutAListHasItsTimesInNames) {
  WriteEuroc(Folder() / "mav0", 2);
  const ImageList listed = ListImages(Folder());
  fs::remove(folder_ / "mav0/cam0/data.csv");
  for (const char* input : {"", "mav0", "mav0/cam0"}) {
    const ImageList list = ListImages(Folder() / input);
    EXPECT_EQ(list.layout, "euroc") << input;
    EXPECT_EQ(TimesOf(list), TimesOf(listed));
    EXPECT_TRUE(list.camera);
  }
  AddImages("mav0/cam0/data", {"another.png"});
  EXPECT_THAT(ErrorOfListing(Folder()), HasSubstr("data.csv: is missing"));
}

TEST_F(Layouts, EurocMayHaveTheOtherCameraOrFoldersInItsList) {
  WriteEuroc(Folder() / "mav0", 2);
  fs::rename(folder_ / "mav0/cam0", folder_ / "mav0/cam1");
  EXPECT_EQ(ListImages(Folder()).images.size(), 2u);
  WriteText(folder_ / "mav0/cam1/data.csv",
            "1403636579763555584,cam1/data/1403636579763555584.png\n");
  EXPECT_TRUE(fs::exists(ListImages(Folder()).images.at(0).file));
}

TEST_F(Layouts, AssociationsListTheImagesBesideDepth) {
  AddImages("rgb", {"1.png", "2.png"});
  for (const char* text : {"1.5 rgb/1.png 1.6 depth/1.png\n2.5 rgb/2.png 2.6 depth/2.png\n",
                           "1.6 depth/1.png 1.5 rgb/1.png\n2.6 depth/2.png 2.5 rgb/2.png\n"}) {
    WriteText(folder_ / "associations.txt", text);
    const ImageList list = ListImages(Folder());
    EXPECT_EQ(list.layout, "tum");
    EXPECT_THAT(TimesOf(list), ElementsAre(1500000000, 2500000000));
    EXPECT_EQ(list.images[1].file, folder_ / "rgb/2.png");
  }
}

TEST_F(Layouts, RawKittiHasDatesAsTimes) {
  const std::string drive = "2011_09_26/2011_09_26_drive_0001_sync";
  AddImages(drive + "/image_02/data", {"0000000000.png", "0000000001.png"});
  const fs::path times = folder_ / (drive + "/image_02/timestamps.txt");
  WriteText(times, "2011-09-26 13:02:25.964389445\n2011-09-26 13:02:26.067749888\n");
  for (const char* input : {"", "image_02", "image_02/", "image_02/data"}) {
    const ImageList list = ListImages(Folder() / drive / input);
    EXPECT_EQ(list.layout, "kitti-raw") << input;
    EXPECT_THAT(TimesOf(list), ElementsAre(1317042145964389445, 1317042146067749888));
  }
  EXPECT_FALSE(ListImages(Folder() / drive).camera);
  WriteText(folder_ / "2011_09_26/calib_cam_to_cam.txt",
            "calib_time: 09-Jan-2012 13:57:47\nS_rect_02: 96 64\n"
            "P_rect_02: 80 0 47.5 0 0 81 31.5 0 0 0 1 0\n");
  EXPECT_EQ(ListImages(Folder() / drive).camera.value().fx, 80);
  WriteText(times, "2011-09-26 13:02:25.9\n2011-13-26 13:02:26.0\n");
  EXPECT_THAT(ErrorOfListing(Folder() / drive), HasSubstr("timestamps.txt:2: '2011-13-26"));
  WriteText(times, "2011-09-26 13:02:25.9\n");
  EXPECT_THAT(ErrorOfListing(Folder() / drive), HasSubstr("1 timestamps for the 2 images"));
}

TEST_F(Layouts, RawKittiHasItsTruthInOxts) {
  const fs::path drive = Folder() / "2011_09_26/drive";
  WriteText(drive / "../calib_imu_to_velo.txt", "R: 1 0 0 0 1 0 0 0 1\nT: 1 0 0\n");
  WriteText(drive / "../calib_velo_to_cam.txt", "R: 0 -1 0 0 0 -1 1 0 0\nT: 0 0 0\n");
  WriteText(drive / "oxts/timestamps.txt", "2011-09-26 13:02:25.5\n2011-09-26 13:02:26.5\n");
  // Eastward along the 60th parallel, where a degree of longitude is half as long.
  const std::string rest = " 100 0 0 0 0 0 0 0 0 0\n";
  WriteText(drive / "oxts/data/0.txt", "60 8.0" + rest);
  WriteText(drive / "oxts/data/1.txt", "60 8.0001" + rest);
  AddImages("2011_09_26/drive/image_00/data", {"0.png"});
  for (const char* input : {"", "image_00", "image_00/data"}) {
    EXPECT_EQ(FindGroundTruth(drive / input), drive / "oxts") << input;
  }
  const PoseSequence poses = ReadTruthFile(drive / "oxts").poses();
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[1].time_ns - poses[0].time_ns, 1000000000);
  const double step = 0.5 * 6378137 * 0.0001 * M_PI / 180;
  const SE3 moved = poses[0].world_from_camera.Inverse() * poses[1].world_from_camera;
  EXPECT_THAT(moved.translation(), IsMatrixNear(Eigen::Vector3d(0, 0, step), 1e-6)) << "forward";
  EXPECT_THAT(poses[0].world_from_camera * Eigen::Vector3d(0, 0, 1),
              IsMatrixNear(Eigen::Vector3d(0, 0, 0), 1e-9))
      << "the camera is 1 m behind the origin of the world";
  fs::remove(drive / "../calib_imu_to_velo.txt");
  EXPECT_THAT(ErrorOf([&] { ReadTruthFile(drive / "oxts"); }), HasSubstr("calib_imu_to_velo.txt"));
}

TEST_F(Layouts, TartanAirHasOneCameraAndPosesInItsOwnAxes) {
  AddImages("P000/image_left", {"000000_left.png", "000001_left.png"});
  const fs::path truth = folder_ / "P000/pose_left.txt";
  WriteText(truth, "0 0 0 0 0 0 1\n2 0.5 0.25 0 0 0 1\n");
  const ImageList list = ListImages(Folder() / "P000");
  EXPECT_EQ(list.layout, "tartanair");
  ASSERT_TRUE(list.camera);
  EXPECT_EQ(list.camera->fx, 320);
  EXPECT_EQ(FindGroundTruth(Folder() / "P000"), truth);
  const PoseSequence poses = ReadGroundTruth(truth, TimesOf(list));
  EXPECT_EQ(poses[1].time_ns, list.images[1].time_ns);
  const SE3 moved = poses[0].world_from_camera.Inverse() * poses[1].world_from_camera;
  EXPECT_THAT(moved.translation(), IsMatrixNear(Eigen::Vector3d(0.5, 0.25, 2), 1e-12))
      << "right, down, forward";
}

TEST_F(Layouts, TheOnlyFolderWithImagesIsUsed) {
  AddImages("images", {"1.webp", "2.PGM"});
  WriteText(folder_ / "notes/a.txt", "");
  EXPECT_EQ(ListImages(Folder()).images.size(), 2u);
  AddImages("others", {"1.png"});
  EXPECT_THAT(ErrorOfListing(Folder()), AllOf(HasSubstr("/images"), HasSubstr("/others")));
}

TEST_F(Layouts, ErrorsNameWhatALayoutLacks) {
  WriteText(folder_ / "calib.txt", "");
  EXPECT_THAT(ErrorOfListing(Folder()), AllOf(HasSubstr("calib.txt"), HasSubstr("image_0")));
  WriteText(folder_ / "mav0/cam0/notes.txt", "");
  EXPECT_THAT(ErrorOfListing(Folder()), HasSubstr("mav0/cam0/data.csv"));
  EXPECT_THAT(ErrorOfListing("rtsp://10.0.0.1/live"), HasSubstr("is a stream's address"));
  EXPECT_THAT(ErrorOfListing("none"), HasSubstr("no such folder"));
}

TEST_F(Layouts, BracketsInTheNamesOfFoldersAreNoWildcards) {
  AddImages("a [1080p] *", {"img1.JPG", "img2.JPG"});
  EXPECT_EQ(ListImages(Folder() / "a [1080p] *" / "img*.JPG").images.size(), 2u);
  EXPECT_EQ(ListImages(Folder() / "a [1080p] *" / "img[12].JPG").images.size(), 2u);
  EXPECT_EQ(ListImages(Folder() / "a*" / "img[1].JPG").images.size(), 1u);
}

}  // namespace
}  // namespace corvo::test
