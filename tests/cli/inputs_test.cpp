// SPDX-License-Identifier: MIT
// These tests cover the inputs of `corvo run` other than folders of gray 8-bit images.
#include <cmath>
#include <csignal>
#include <numeric>

#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "apps/dataset/camera_formats/calibration_file.h"
#include "apps/dataset/image_source.h"
#include "apps/run/camera_start.h"
#include "apps/run/run_inputs.h"
#include "apps/run/sequence_stream.h"
#include "apps/system/interruption.h"
#include "tests/cli/expect_error.h"
#include "tests/cli/tiny_sequence.h"
#include "tests/support/data.h"
#include "vo/io/config.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;
using test::ErrorOf;
using test::kTinyHeight;
using test::kTinyWidth;
using test::TemporaryFolder;
using test::TinyImage;
using test::WriteText;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

ImageSource Open(const fs::path& input, const Selection& selection = {}) {
  return OpenImages(input.string(), {}, selection);
}

std::vector<TimedImage> ReadAll(ImageSource source) {
  std::vector<TimedImage> images;
  while (const auto next = source.Next()) images.push_back(*next);
  return images;
}

std::vector<int> Indices(const std::vector<TimedImage>& images) {
  std::vector<int> indices;
  for (const TimedImage& image : images) indices.push_back(image.index);
  return indices;
}

double Difference(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF); }

/// Writes a video of `count` frames at 25 Hz; the gray value of frame i is 20 i.
void WriteVideo(const fs::path& file, int count) {
  cv::VideoWriter writer(file.string(), cv::CAP_OPENCV_MJPEG,
                         cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25.0,
                         cv::Size(kTinyWidth, kTinyHeight));
  ASSERT_TRUE(writer.isOpened());
  for (int i = 0; i < count; ++i) {
    writer.write(cv::Mat(kTinyHeight, kTinyWidth, CV_8UC3, cv::Scalar::all(20 * i)));
  }
}

TEST(Glob, ListsMatchingImagesInNaturalOrder) {
  TemporaryFolder folder;
  for (const char* name : {"left10.png", "left9.png", "right1.png"}) {
    test::WriteImage(folder / name, TinyImage(0));
  }
  WriteText(folder / "left1.txt", "not an image");
  const ImageList list = ListImages(folder / "left*");
  EXPECT_EQ(list.layout, "glob");
  ASSERT_EQ(list.images.size(), 2u);
  EXPECT_EQ(list.images[0].file.filename(), "left9.png");
  EXPECT_EQ(list.images[1].file.filename(), "left10.png");
  EXPECT_EQ(list.images[1].time_ns, 33333333);
  EXPECT_THAT(ErrorOf([&] { ListImages(folder / "up*.png"); }),
              HasSubstr("up*.png: matches no image"));
}

TEST(Glob, MatchesAcrossSeveralFolders) {
  TemporaryFolder folder;
  test::WriteImage(folder / "b/1.png", TinyImage(0));
  test::WriteImage(folder / "a/2.png", TinyImage(0));
  const ImageList list = ListImages(folder / "*/?.png");
  ASSERT_EQ(list.images.size(), 2u);
  EXPECT_EQ(list.images[0].file, folder / "a/2.png");
}

TEST(Video, TimestampsComeFromTheVideo) {
  TemporaryFolder folder;
  WriteVideo(folder / "drive.avi", 8);
  const std::vector<TimedImage> images = ReadAll(Open(folder / "drive.avi"));
  ASSERT_EQ(images.size(), 8u);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(images[i].index, i);
    EXPECT_NEAR(1e-9 * static_cast<double>(images[i].time_ns - images[0].time_ns), 0.04 * i, 1e-6);
    ASSERT_EQ(images[i].image.type(), CV_8UC1);
    EXPECT_NEAR(cv::mean(images[i].image)[0], 20 * i, 3) << "frames must not share memory";
  }
  EXPECT_THAT(images[3].name, HasSubstr("drive.avi, frame 3"));
}

TEST(Video, GivenFrameRateOverridesTheTimestamps) {
  TemporaryFolder folder;
  WriteVideo(folder / "drive.avi", 3);
  InputOptions options;
  options.frame_rate_hz = 100.0;
  const std::vector<TimedImage> images =
      ReadAll(OpenImages((folder / "drive.avi").string(), options, {}));
  ASSERT_EQ(images.size(), 3u);
  EXPECT_EQ(images[2].time_ns, 20000000);
}

TEST(Video, SelectionPicksFrames) {
  TemporaryFolder folder;
  WriteVideo(folder / "drive.avi", 8);
  const std::vector<TimedImage> images =
      ReadAll(Open(folder / "drive.avi", {.start = 1, .every = 3, .count = std::nullopt}));
  EXPECT_THAT(Indices(images), ElementsAre(1, 4, 7));
  EXPECT_NEAR(cv::mean(images[1].image)[0], 80, 3);
}

TEST(Video, ErrorNamesAFileThatIsNoVideo) {
  TemporaryFolder folder;
  WriteText(folder / "file.txt", "text");
  EXPECT_THAT(ErrorOf([&] { Open(folder / "file.txt"); }),
              HasSubstr("file.txt: neither a folder of images nor a video"));
  test::WriteFolder(folder.path(), 1);
  EXPECT_THAT(ErrorOf([&] { Open(folder / "0.png"); }),
              HasSubstr("0.png: is a single image; give its"));
}

TEST(CameraInput, ErrorNamesAMissingCamera) {
  EXPECT_THAT(ErrorOf([] { Open("camera:97"); }), HasSubstr("camera:97: there is no such camera"));
  EXPECT_THAT(ErrorOf([] { Open("97"); }), HasSubstr("camera:97: there is no such camera"));
}

TEST(SelectedImages, KeepTheirTimestampsAndIndices) {
  TemporaryFolder folder;
  test::WriteFolder(folder.path(), 10);
  ImageSource source = Open(folder.path(), {.start = 2, .every = 3, .count = 2});
  EXPECT_EQ(source.size(), 2);
  const std::vector<TimedImage> images = ReadAll(std::move(source));
  EXPECT_THAT(Indices(images), ElementsAre(2, 5));
  EXPECT_EQ(images[1].time_ns, std::llround(5e9 / InputOptions().default_frame_rate_hz));
  EXPECT_EQ(Difference(images[1].image, TinyImage(5)), 0);
}

TEST(SelectedImages, SizeEqualsTheNumberOfImagesRead) {
  TemporaryFolder folder;
  test::WriteFolder(folder.path(), 10);
  for (const Selection& selection :
       {Selection{}, Selection{3, 1, {}}, Selection{0, 4, {}}, Selection{9, 2, {}},
        Selection{0, 3, 7}, Selection{10, 1, {}}}) {
    const int num_read = static_cast<int>(ReadAll(Open(folder.path(), selection)).size());
    EXPECT_EQ(Open(folder.path(), selection).size(), num_read)
        << selection.start << " " << selection.every;
  }
  EXPECT_THAT(ErrorOf([&] { Open(folder.path(), {10, 1, {}}).First(); }), HasSubstr("--start"));
}

TEST(GrayImage, KeepsTheUpperByteOfSixteenBits) {
  TemporaryFolder folder;
  cv::Mat image(16, 256, CV_16UC1);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 256; ++x) {
      image.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(256 * x + 16 * y + 15);
    }
  }
  for (const char* name : {"deep.png", "deep.pgm", "deep.tiff"}) {
    test::WriteImage(folder / name, image);
    const cv::Mat gray = ReadGrayImage(folder / name);
    ASSERT_EQ(gray.type(), CV_8UC1);
    for (int x = 0; x < 256; ++x) {
      ASSERT_EQ(gray.at<std::uint8_t>(0, x), x) << name;
      ASSERT_EQ(gray.at<std::uint8_t>(15, x), x) << name;
    }
  }
}

TEST(GrayImage, WeightsColorChannels) {
  TemporaryFolder folder;
  const cv::Mat color(8, 8, CV_8UC3, cv::Scalar(200, 100, 50));  // B, G, R
  const double expected = 0.114 * 200 + 0.587 * 100 + 0.299 * 50;
  test::WriteImage(folder / "c.png", color);
  EXPECT_NEAR(ReadGrayImage(folder / "c.png").at<std::uint8_t>(4, 4), expected, 1);
  test::WriteImage(folder / "c.jpg", color);
  EXPECT_NEAR(ReadGrayImage(folder / "c.jpg").at<std::uint8_t>(4, 4), expected, 2);
  cv::Mat deep;
  color.convertTo(deep, CV_16U, 256);
  test::WriteImage(folder / "d.png", deep);
  EXPECT_NEAR(ReadGrayImage(folder / "d.png").at<std::uint8_t>(4, 4), expected, 1);
  const cv::Mat with_alpha(8, 8, CV_8UC4, cv::Scalar(200, 100, 50, 255));
  EXPECT_NEAR(ToGray(with_alpha, "a").at<std::uint8_t>(4, 4), expected, 1);
}

TEST(GrayImage, RejectsUnsupportedPixelTypes) {
  EXPECT_THAT(
      ErrorOf([] { ToGray(cv::Mat(8, 8, CV_32FC1), "depth.exr"); }),
      HasSubstr("depth.exr: images of type CV_32FC1 are not supported, only 8 and 16 bits"));
}

TEST(GrayImage, ErrorNamesATruncatedImage) {
  TemporaryFolder folder;
  for (const char* name : {"p.jpg", "p.png"}) {
    test::WriteImage(folder / name, TinyImage(1));
    const std::string whole = test::ReadText(folder / name);
    EXPECT_EQ(ReadGrayImage(folder / name).size(), TinyImage(1).size());
    for (const double share : {0.0, 0.1, 0.5, 0.95}) {
      const auto kept = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
      WriteText(folder / name, whole.substr(0, kept));
      EXPECT_THAT(ErrorOf([&] { ReadGrayImage(folder / name); }),
                  HasSubstr(std::string(name) + ": not a readable image"))
          << share;
    }
    WriteText(folder / name, whole + "trailing bytes");
    EXPECT_EQ(ReadGrayImage(folder / name).size(), TinyImage(1).size());
  }
}

/// Writes a TUM-mono sequence: times with exposures, images, and the camera in units of the image
/// size.
void WriteTumMono(const fs::path& folder, int count) {
  std::string times;
  for (int i = 0; i < count; ++i) {
    const std::string name = "0000" + std::to_string(i);
    test::WriteImage(folder / "images" / (name + ".jpg"), TinyImage(i));
    times += name + " 1436023524." + std::to_string(100 + 50 * i) + " 0.0107\n";
  }
  WriteText(folder / "times.txt", times);
  WriteText(folder / "camera.txt", "0.5\t0.75\t0.5\t0.5\t0.9\n96 64\n0.4 0.53 0.5 0.5 0\n64 48\n");
}

TEST(TumMonoSequence, ReadsTimesAndCamera) {
  TemporaryFolder folder;
  WriteTumMono(folder.path(), 3);
  const ImageList list = ListImages(folder.path());
  EXPECT_EQ(list.layout, "tum-mono");
  ASSERT_EQ(list.images.size(), 3u);
  EXPECT_EQ(list.images[2].time_ns, 1436023524200000000);
  CameraParameters expected;
  expected.model = CameraModel::kFov;
  expected.width = 96;
  expected.height = 64;
  expected.fx = 48;
  expected.fy = 48;
  expected.cx = 47.5;  // 0.5 is the image center, between pixels 47 and 48.
  expected.cy = 31.5;
  expected.omega = 0.9;
  ASSERT_TRUE(list.camera);
  EXPECT_EQ(*list.camera, expected);
}

TEST(TumMonoSequence, ErrorsNameTheMalformedFile) {
  TemporaryFolder folder;
  const auto error = [&] { return ErrorOf([&] { ListImages(folder.path()); }); };
  WriteText(folder / "images.zip", "zip");
  WriteText(folder / "times.txt", "00000 1.5 0.01\n");
  EXPECT_THAT(error(), HasSubstr("images.zip: unpack it"));
  WriteTumMono(folder.path(), 2);
  WriteText(folder / "times.txt", "00000 1.5 0.01\n");
  EXPECT_THAT(error(), HasSubstr("times.txt: 1 timestamps for the 2 images"));
  WriteText(folder / "times.txt", "00000 1.5 0.01\n00007 1.6\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("times.txt:2"), HasSubstr("00001.jpg")));
  WriteTumMono(folder.path(), 2);
  WriteText(folder / "camera.txt", "0.5 0.75 0.5 0.5\n96 64\n");
  EXPECT_THAT(error(), HasSubstr("camera.txt: is no camera file of a known form"));
  WriteText(folder / "camera.txt", "48 48 47 0.5 0.9\n96 64\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("camera.txt:1"), HasSubstr("fractions of the image's")));
  WriteText(folder / "camera.txt", "0.5 0.75 0.5 0.5 9\n96 64\n");
  EXPECT_THAT(error(), HasSubstr("camera.txt:1: camera.omega is 9"));
  WriteText(folder / "camera.txt", "0.5 0.75 0.5 0.5 0.9\n");
  EXPECT_THAT(error(), HasSubstr("camera.txt: has no second line"));
}

TEST(EurocSequence, EquidistantDistortionIsKb4) {
  TemporaryFolder folder;
  test::WriteEuroc(folder / "dataset-room1_512_16/mav0", 1);
  std::string sensor = test::EurocSensor();
  sensor.replace(sensor.find("radial-tangential"), 17, "equidistant");
  WriteText(folder / "dataset-room1_512_16/mav0/cam0/sensor.yaml", sensor);
  const ImageList list = ListImages(folder / "dataset-room1_512_16");
  ASSERT_TRUE(list.camera);
  EXPECT_EQ(list.camera->model, CameraModel::kKb4);
  EXPECT_EQ(list.camera->k1, -0.28);
  EXPECT_EQ(list.camera->k3, 0.0002);
  EXPECT_EQ(list.camera->k4, 1.76e-05);
  EXPECT_EQ(list.camera->p1, 0);
}

TEST(EurocSequence, TumViCalibrationIsReadFromBesideMav0) {
  TemporaryFolder folder;
  const fs::path room = folder / "dataset-room1_512_16";
  test::WriteEuroc(room / "mav0", 1);
  fs::remove(room / "mav0/cam0/sensor.yaml");
  EXPECT_FALSE(ListImages(room).camera);
  WriteText(room / "dso/camchain.yaml",
            "cam0:\n  camera_model: pinhole\n  distortion_coeffs: [0.003, 0.0007, -0.002, 0.0002]\n"
            "  distortion_model: equidistant\n  intrinsics: [40.5, 40.25, 47.5, 31.5]\n"
            "  resolution: [96, 64]\n");
  for (const fs::path& input : {room, room / "mav0"}) {
    const ImageList list = ListImages(input);
    ASSERT_TRUE(list.camera) << input;
    EXPECT_EQ(list.camera->model, CameraModel::kKb4);
    EXPECT_EQ(list.camera->fy, 40.25);
    EXPECT_EQ(list.camera->k3, -0.002);
  }
  WriteText(room / "dso/camchain.yaml", "cam1:\n  camera_model: pinhole\n");
  EXPECT_THAT(ErrorOf([&] { ListImages(room); }),
              HasSubstr("camchain.yaml: holds no camera cam0; it holds cam1"));
}

TEST(ParseResize, AcceptsASizeOrAFactor) {
  const cv::Size size(640, 481);
  EXPECT_EQ(ParseResize("320x200", size), cv::Size(320, 200));
  EXPECT_EQ(ParseResize("0.5", size), cv::Size(320, 241));
  EXPECT_EQ(ParseResize("2", size), cv::Size(1280, 962));
  for (const char* text : {"", "half", "320x", "x200", "320x200x3", "-1", "0", "0.01", "nan"}) {
    EXPECT_THAT(ErrorOf([&] { ParseResize(text, size); }),
                HasSubstr(std::string("--resize '") + text + "'"))
        << text;
  }
}

/// A fixture that prepares the inputs of `corvo run` from a folder of six tiny images and further
/// arguments.
class PreparedInputs : public testing::Test {
 protected:
  PreparedInputs() {
    test::WriteFolder(folder_ / "images", 6);
    WriteText(folder_ / "camera.yaml",
              "model: pinhole\nwidth: 96\nheight: 64\nfx: 80\nfy: 81\ncx: 47\ncy: 31\n");
    arguments_.input = folder_ / "images";
    arguments_.camera = folder_ / "camera.yaml";
    arguments_.output = folder_ / "result";
  }

  std::vector<TimedImage> Prepared() const {
    return ReadAll(ReadInputs(arguments_, Interruption()).source);
  }

  TemporaryFolder folder_;
  RunArguments arguments_;
};

TEST_F(PreparedInputs, ResizeScalesTheCameraWithTheImages) {
  arguments_.resize = "48x16";
  RunInputs inputs = ReadInputs(arguments_, Interruption());
  EXPECT_EQ(inputs.camera.given.width, 48);
  EXPECT_EQ(inputs.camera.given.height, 16);
  EXPECT_EQ(inputs.camera.given.fx, 40);
  EXPECT_EQ(inputs.camera.given.fy, 20.25);
  EXPECT_EQ(inputs.camera.given.cx, 23.25);  // (47 + 0.5) / 2 - 0.5
  EXPECT_EQ(inputs.camera.given.cy, 7.375);  // (31 + 0.5) / 4 - 0.5
  const cv::Mat image = inputs.source.Next()->image;
  ASSERT_EQ(image.size(), cv::Size(48, 16));
  const cv::Mat block = TinyImage(0)(cv::Rect(2 * 10, 4 * 5, 2, 4));
  EXPECT_NEAR(image.at<std::uint8_t>(5, 10), cv::mean(block)[0], 1);
}

TEST_F(PreparedInputs, SingleMaskAppliesToAllImages) {
  cv::Mat mask(kTinyHeight, kTinyWidth, CV_8UC1, cv::Scalar(255));
  mask.colRange(0, 48) = 0;
  test::WriteImage(folder_ / "mask.png", mask);
  arguments_.mask = folder_ / "mask.png";
  for (const TimedImage& image : Prepared()) EXPECT_EQ(Difference(image.mask, mask), 0);
  arguments_.resize = "48x32";
  for (const TimedImage& image : Prepared()) {
    ASSERT_EQ(image.mask.size(), cv::Size(48, 32));
    EXPECT_EQ(cv::countNonZero(image.mask), 24 * 32);
  }
}

TEST_F(PreparedInputs, FolderOfMasksIsMatchedByName) {
  for (int i = 0; i < 6; ++i) {
    test::WriteImage(folder_ / ("masks/" + std::to_string(i) + ".pgm"),
                     cv::Mat(kTinyHeight, kTinyWidth, CV_8UC1, cv::Scalar(10 * i)));
  }
  arguments_.mask = folder_ / "masks";
  arguments_.selection.every = 2;
  const std::vector<TimedImage> images = Prepared();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(images[i].mask.at<std::uint8_t>(0, 0), 20 * i);
  fs::remove(folder_ / "masks/4.pgm");
  EXPECT_THAT(ErrorOf([&] { Prepared(); }),
              AllOf(HasSubstr("masks: contains no mask for"), HasSubstr("4.png")));
}

TEST_F(PreparedInputs, FolderOfMasksWithOtherNamesIsMatchedByOrder) {
  for (int i = 0; i < 5; ++i) {
    test::WriteImage(folder_ / ("masks/mask_" + std::to_string(i) + ".png"),
                     cv::Mat(kTinyHeight, kTinyWidth, CV_8UC1, cv::Scalar(10 * i)));
  }
  arguments_.mask = folder_ / "masks";
  arguments_.selection = {1, 3, {}};
  const std::vector<TimedImage> images = Prepared();
  EXPECT_EQ(images[0].mask.at<std::uint8_t>(0, 0), 10);
  EXPECT_EQ(images[1].mask.at<std::uint8_t>(0, 0), 40);
  arguments_.selection = {};
  EXPECT_THAT(ErrorOf([&] { Prepared(); }), HasSubstr("5.png"));
}

TEST_F(PreparedInputs, ErrorNamesAMaskOfAnotherSize) {
  test::WriteImage(folder_ / "mask.png", TinyImage(0, 90, 64));
  arguments_.mask = folder_ / "mask.png";
  EXPECT_THAT(ErrorOf([&] { Prepared(); }),
              AllOf(HasSubstr("mask.png: the mask is 90 x 64 px"), HasSubstr("96 x 64 px")));
}

TEST_F(PreparedInputs, AcceptTheCameraFileOfTumMono) {
  WriteText(folder_ / "camera.txt", "0.5 0.75 0.5 0.5 0.9\n96 64\n");
  arguments_.camera = folder_ / "camera.txt";
  EXPECT_EQ(ReadInputs(arguments_, Interruption()).camera.given,
            ReadCalibrationFile(folder_ / "camera.txt").camera.parameters);
}

TEST_F(PreparedInputs, StatedFocalLengthIsThatOfTheImagesBeforeTheyAreResized) {
  arguments_.camera.clear();
  arguments_.focal = "80";
  arguments_.resize = "0.5";
  const CameraPrior prior = ReadInputs(arguments_, Interruption()).camera;
  EXPECT_EQ(prior, StatedFocalPrior(80, {kTinyWidth, kTinyHeight}).Resized(48, 32));
  EXPECT_EQ(prior.given.fx, 40);
}

TEST_F(PreparedInputs, StatedFieldOfViewOverridesTheDatasetsCalibration) {
  test::WriteKitti(folder_ / "kitti", 2);
  arguments_.input = folder_ / "kitti";
  arguments_.camera.clear();
  EXPECT_EQ(ReadInputs(arguments_, Interruption()).camera.given.fx, 80);
  arguments_.fov_deg = 90;
  EXPECT_NEAR(ReadInputs(arguments_, Interruption()).camera.given.fx, 48, 1e-9);
}

TEST_F(PreparedInputs, FocalSearchCanBeInterrupted) {
  const Interruption interruption;
  raise(SIGINT);
  const StreamOpener open = ToStreamOpener([&] { return Open(arguments_.input); });
  EXPECT_THROW(FindSequenceCamera(open, {}, interruption), Interrupted);
}

TEST_F(PreparedInputs, VideoAcceptsOnlyGroundTruthWithTimestamps) {
  WriteVideo(folder_ / "drive.avi", 3);
  arguments_.input = folder_ / "drive.avi";
  EXPECT_TRUE(ReadInputs(arguments_, Interruption()).truth.poses.empty());
  WriteText(folder_ / "tum.txt", "0 0 0 0 0 0 0 1\n0.04 1 0 0 0 0 0 1\n");
  arguments_.truth = folder_ / "tum.txt";
  EXPECT_EQ(ReadInputs(arguments_, Interruption()).truth.poses.size(), 2u);
  WriteText(folder_ / "kitti.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  arguments_.truth = folder_ / "kitti.txt";
  EXPECT_THAT(ErrorOf([&] { ReadInputs(arguments_, Interruption()); }),
              HasSubstr("kitti.txt: KITTI format has no timestamps"));
}

TEST(ShippedCameras, EqualTheCalibrationsOfTheDatasets) {
  CORVO_REQUIRE_DATA("kitti/sequences/03");
  const auto shipped = [](const char* name) {
    return ReadCameraFile(test::SourceDir() / "configs" / name).camera.parameters();
  };
  const auto own = [](const char* name) { return *ListImages(test::DataPath(name)).camera; };
  EXPECT_EQ(shipped("kitti_03.yaml"), own("kitti/sequences/03"));
  EXPECT_EQ(shipped("kitti_04-12.yaml"), own("kitti/sequences/05"));
  EXPECT_EQ(shipped("kitti_04-12.yaml"), own("kitti/sequences/06"));
  EXPECT_EQ(shipped("euroc.yaml"), own("euroc/MH_01_easy"));
}

}  // namespace
}  // namespace corvo
