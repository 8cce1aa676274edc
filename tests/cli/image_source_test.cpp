// SPDX-License-Identifier: MIT
#include "apps/dataset/image_source.h"

#include <opencv2/core.hpp>

#include "apps/dataset/image_layouts.h"
#include "apps/output/manifest.h"
#include "tests/cli/expect_error.h"
#include "tests/cli/tiny_sequence.h"

namespace corvo {
namespace {

using test::ErrorOf;
using test::TemporaryFolder;
using test::TinyImage;
using test::WriteText;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::vector<std::string> FileNames(const ImageList& list) {
  std::vector<std::string> names;
  for (const TimedFile& image : list.images) names.push_back(image.file.filename().string());
  return names;
}

std::string ErrorOfListing(const std::filesystem::path& input) {
  return ErrorOf([&] { ListImages(input); });
}

TEST(NaturalLess, ComparesRunsOfDigitsAsNumbers) {
  EXPECT_TRUE(NaturalLess("2.png", "10.png"));
  EXPECT_FALSE(NaturalLess("10.png", "2.png"));
  EXPECT_TRUE(NaturalLess("a9b2", "a9b10"));
  EXPECT_TRUE(NaturalLess("frame", "frame1"));
  EXPECT_FALSE(NaturalLess("x", "x"));
}

TEST(NaturalLess, OrdersEqualNumbersByTheirLeadingZeros) {
  EXPECT_NE(NaturalLess("1.png", "01.png"), NaturalLess("01.png", "1.png"));
}

TEST(NaturalLess, ComparesNumbersTooLongForAnInteger) {
  EXPECT_TRUE(NaturalLess("99999999999999999999998", "99999999999999999999999"));
}

TEST(FolderSequence, ImagesAreInNaturalOrderWithTimesByFrameRate) {
  TemporaryFolder folder;
  for (const char* name : {"10.png", "9.png", "1.PNG", "2.jpg"}) {
    test::WriteImage(folder / name, TinyImage(0));
  }
  WriteText(folder / "notes.md", "not an image");
  const ImageList list = ListImages(folder.path());
  EXPECT_EQ(list.layout, "folder");
  EXPECT_FALSE(list.camera);
  EXPECT_THAT(FileNames(list), testing::ElementsAre("1.PNG", "2.jpg", "9.png", "10.png"));
  EXPECT_EQ(list.images[1].time_ns, 33333333);
  EXPECT_EQ(list.images[3].time_ns, 100000000);
}

TEST(FolderSequence, SkipsDepthImages) {
  TemporaryFolder folder;
  test::WriteImage(folder / "frame-000000.color.png", TinyImage(0));
  test::WriteImage(folder / "frame-000000.depth.png", TinyImage(0));
  EXPECT_THAT(FileNames(ListImages(folder.path())), testing::ElementsAre("frame-000000.color.png"));
}

TEST(FolderSequence, ErrorsNameTheInvalidInput) {
  TemporaryFolder folder;
  WriteText(folder / "file.txt", "text");
  EXPECT_THAT(ErrorOfListing(folder / "missing"), HasSubstr("missing: no such folder"));
  EXPECT_THAT(ErrorOfListing(folder / "file.txt"), HasSubstr("file.txt: not a folder"));
  EXPECT_THAT(ErrorOfListing(folder.path()), HasSubstr("contains no images"));
}

TEST(KittiSequence, ReadsTimesAndCalibration) {
  TemporaryFolder folder;
  test::WriteKitti(folder.path(), 3);
  const ImageList list = ListImages(folder.path());
  EXPECT_EQ(list.layout, "kitti");
  ASSERT_EQ(list.images.size(), 3u);
  EXPECT_EQ(list.images[2].time_ns, 200000000);
  CameraParameters expected;
  expected.width = test::kTinyWidth;
  expected.height = test::kTinyHeight;
  expected.fx = 80;
  expected.fy = 81;
  expected.cx = 47.5;
  expected.cy = 31.5;
  ASSERT_TRUE(list.camera);
  EXPECT_EQ(*list.camera, expected);
}

TEST(KittiSequence, ErrorsNameTheMalformedFile) {
  TemporaryFolder folder;
  test::WriteKitti(folder.path(), 3);
  WriteText(folder / "calib.txt", "P0: 80 0 47.5\n");
  EXPECT_THAT(ErrorOfListing(folder.path()),
              HasSubstr("calib.txt:1: 3 values after P0:; needed are 12"));
  WriteText(folder / "calib.txt", "P0: 80 0 47.5 0 0 hm 31.5 0 0 0 1 0\n");
  EXPECT_THAT(ErrorOfListing(folder.path()), HasSubstr("calib.txt:1: 'hm' is not a number"));
  WriteText(folder / "calib.txt", "P0: -80 0 47.5 0 0 81 31.5 0 0 0 1 0\n");
  EXPECT_THAT(ErrorOfListing(folder.path()), HasSubstr("calib.txt:1: camera.fx is -80"));
  WriteText(folder / "calib.txt", "P7: 1\n");
  EXPECT_THAT(ErrorOfListing(folder.path()),
              HasSubstr("calib.txt: holds no camera P0; it holds P7"));
}

TEST(KittiSequence, RequiresOneAscendingTimePerImage) {
  TemporaryFolder folder;
  test::WriteKitti(folder.path(), 3);
  WriteText(folder / "times.txt", "0\n0.1\n");
  EXPECT_THAT(ErrorOfListing(folder.path()), HasSubstr("2 timestamps for the 3 images"));
  WriteText(folder / "times.txt", "0\n0.1\n0.1\n");
  EXPECT_THAT(ErrorOfListing(folder.path()),
              AllOf(HasSubstr("000002.png"), HasSubstr("is not later than 100000000 ns")));
  WriteText(folder / "times.txt", "0\nsoon\n0.2\n");
  EXPECT_THAT(ErrorOfListing(folder.path()), HasSubstr("times.txt:2: 'soon'"));
}

TEST(EurocSequence, IsRecognizedFromMav0AndFromItsParent) {
  TemporaryFolder folder;
  test::WriteEuroc(folder / "mav0", 3);
  for (const std::filesystem::path& input : {folder.path(), folder / "mav0"}) {
    const ImageList list = ListImages(input);
    EXPECT_EQ(list.layout, "euroc");
    ASSERT_EQ(list.images.size(), 3u);
    EXPECT_EQ(list.images[1].time_ns, 1403636579813555584);
  }
}

TEST(EurocSequence, ReadsTheSensorsCalibration) {
  TemporaryFolder folder;
  test::WriteEuroc(folder / "mav0", 1);
  const ImageList list = ListImages(folder.path());
  CameraParameters expected;
  expected.width = test::kTinyWidth;
  expected.height = test::kTinyHeight;
  expected.fx = 80.5;
  expected.fy = 81.5;
  expected.cx = 47.25;
  expected.cy = 31.25;
  expected.k1 = -0.28;
  expected.k2 = 0.07;
  expected.p1 = 0.0002;
  expected.p2 = 1.76e-05;
  ASSERT_TRUE(list.camera);
  EXPECT_EQ(*list.camera, expected);
}

TEST(EurocSequence, ErrorsNameTheMalformedFile) {
  TemporaryFolder folder;
  test::WriteEuroc(folder / "mav0", 2);
  const std::filesystem::path cam0 = folder / "mav0/cam0";
  WriteText(cam0 / "sensor.yaml", "resolution: [96, 64]\ncamera_model: fisheye\n");
  EXPECT_THAT(ErrorOfListing(folder.path()),
              HasSubstr("sensor.yaml: camera_model is 'fisheye'; only pinhole can be read"));
  std::string sensor = test::EurocSensor();
  sensor.replace(sensor.find("[96"), 3, "[-9");
  WriteText(cam0 / "sensor.yaml", sensor);
  EXPECT_THAT(ErrorOfListing(folder.path()), HasSubstr("sensor.yaml: resolution: width is -9"));
  WriteText(cam0 / "sensor.yaml", "resolution: [96, 64\n");
  EXPECT_THAT(ErrorOfListing(folder.path()), HasSubstr("sensor.yaml:2: "));
  WriteText(cam0 / "data.csv", "#timestamp [ns],filename\n12 13.png 14\n");
  EXPECT_THAT(ErrorOfListing(folder.path()), HasSubstr("data.csv:2: '12 13.png 14'"));
  WriteText(cam0 / "data.csv", "12,12.png\nx,13.png\n");
  EXPECT_THAT(ErrorOfListing(folder.path()), HasSubstr("data.csv:2: 'x'"));
}

TEST(TumSequence, ReadsExactTimesAndConvertsColor) {
  TemporaryFolder folder;
  test::WriteTum(folder.path(), 3);
  ImageSource source(ListImages(folder.path()));
  EXPECT_EQ(source.list().layout, "tum");
  EXPECT_FALSE(source.list().camera);
  const auto first = source.Next();
  const auto second = source.Next();
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->time_ns, 1305031102175304000);
  EXPECT_EQ(second->time_ns, 1305031102215304000);
  ASSERT_EQ(second->image.type(), CV_8UC1);
  EXPECT_LE(cv::norm(second->image, TinyImage(1), cv::NORM_INF), 1.0);
}

TEST(TumSequence, ErrorsNameMissingImagesAndMalformedLines) {
  TemporaryFolder folder;
  test::WriteTum(folder.path(), 2);
  WriteText(folder / "rgb.txt", "# c\n1.5 rgb/none.png\n");
  EXPECT_THAT(ErrorOf([&] { ImageSource(ListImages(folder.path())).First(); }),
              HasSubstr("none.png: "));
  WriteText(folder / "rgb.txt", "# c\n\n1.5\n");
  EXPECT_THAT(ErrorOfListing(folder.path()), HasSubstr("rgb.txt:3: '1.5'"));
  WriteText(folder / "rgb.txt", "# nothing\n");
  EXPECT_THAT(ErrorOfListing(folder.path()), HasSubstr("contains no images"));
}

TEST(ImageSource, ReturnsEveryImageOnce) {
  TemporaryFolder folder;
  test::WriteFolder(folder.path(), 3);
  ImageSource source(ListImages(folder.path()));
  for (int i = 0; i < 3; ++i) {
    const auto next = source.Next();
    ASSERT_TRUE(next);
    EXPECT_EQ(cv::norm(next->image, TinyImage(i), cv::NORM_INF), 0.0);
  }
  EXPECT_FALSE(source.Next());
  EXPECT_FALSE(source.Next());
}

TEST(ImageSource, ReturnsAnUnreadableImageAsMissing) {
  TemporaryFolder folder;
  test::WriteFolder(folder.path(), 6);
  WriteText(folder / "0.png", "garbage");
  WriteText(folder / "4.png", "");
  ImageSource source(ListImages(folder.path()), {0, 2, {}});
  EXPECT_EQ(source.First().index, 2) << "the first that can be read";
  std::vector<TimedImage> images;
  while (auto next = source.Next()) images.push_back(std::move(*next));
  ASSERT_EQ(images.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(images[i].index, 2 * i);
    EXPECT_EQ(images[i].time_ns, ListImages(folder.path()).images[2 * i].time_ns);
    EXPECT_EQ(images[i].missing, i == 1 ? Reason::kNone : Reason::kUnreadableImage);
    EXPECT_EQ(images[i].image.empty(), i != 1);
  }
  EXPECT_THAT(images[2].error, HasSubstr("4.png: not a readable image"));
}

TEST(ImageSource, ReturnsAnImageOfAnotherSizeAsMissing) {
  TemporaryFolder folder;
  test::WriteFolder(folder.path(), 3);
  test::WriteImage(folder / "0.png", TinyImage(0, 80, 60));
  ImageSource source(ListImages(folder.path()));
  const cv::Size size(test::kTinyWidth, test::kTinyHeight);
  source.Prepare({size, size, MaskSource()});
  const auto first = source.Next();
  EXPECT_EQ(first->missing, Reason::kWrongSize);
  EXPECT_THAT(first->error, HasSubstr("0.png: the image is 80 x 60 px, the camera 96 x 64 px"));
  EXPECT_EQ(source.Next()->missing, Reason::kNone);
  EXPECT_THAT(ErrorOf([&] {
                source.Prepare({{50, 50}, {50, 50}, MaskSource()});
              }),
              HasSubstr("96 x 64 px, the camera 50 x 50 px"));
}

TEST(ImageSource, ErrorNamesAnUnreadableImageIfAllAreRequiredOrNoneIsReadable) {
  TemporaryFolder folder;
  test::WriteFolder(folder.path(), 2);
  WriteText(folder / "0.png", "garbage");
  ImageSource strict(ListImages(folder.path()));
  strict.RequireAll();
  EXPECT_THAT(ErrorOf([&] { strict.Next(); }), HasSubstr("0.png: not a readable image"));
  WriteText(folder / "1.png", "garbage");
  ImageSource source(ListImages(folder.path()));
  EXPECT_THAT(ErrorOf([&] { source.First(); }),
              HasSubstr("0.png: not a readable image (none of 2 images can be read)"));
}

TEST(ImageSource, DoesNotReadWhatCorvoWrote) {
  TemporaryFolder folder;
  test::WriteFolder(folder.path(), 2);
  test::WriteImage(folder / "trajectory.png", TinyImage(9));
  test::WriteImage(folder / "users.png", TinyImage(9));
  const auto names = [](const ImageList& list) {
    std::vector<std::string> found;
    for (const TimedFile& image : list.images) found.push_back(image.file.filename());
    return found;
  };
  EXPECT_EQ(ListImages(folder.path()).images.size(), 4u);
  const Manifest manifest{true, {Describe(folder / "trajectory.png")}};
  for (const char* name : {"manifest.json", ".camera.yaml.manifest.json"}) {
    WriteText(folder / name, ToText(manifest));
    EXPECT_THAT(names(ListImages(folder.path())),
                testing::ElementsAre("0.png", "1.png", "users.png"));
    EXPECT_THAT(names(ListImages(folder / "*.png")),
                testing::ElementsAre("0.png", "1.png", "users.png"));
    std::filesystem::remove(folder / name);
  }
}

}  // namespace
}  // namespace corvo
