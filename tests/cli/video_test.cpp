// SPDX-License-Identifier: MIT
// Videos and images as cameras, cards and radio links leave them.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/videoio.hpp>

#include "apps/dataset/image_source.h"
#include "apps/run/run_warnings.h"
#include "orb/error.h"
#include "tests/cli/command.h"
#include "tests/cli/tiny_sequence.h"
#include "tests/support/data.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int kVideoFrames = 20;

/// Returns an image of brightness 20 + 5 `index` whose upper left quarter is white.
cv::Mat Quartered(int index, const cv::Size& size = {kTinyWidth, kTinyHeight}) {
  cv::Mat image(size, CV_8UC3, cv::Scalar::all(20 + 5 * index));
  image(cv::Rect(0, 0, size.width / 2, size.height / 2)).setTo(cv::Scalar::all(250));
  return image;
}

void WriteVideo(const fs::path& file, const cv::VideoWriter& opened) {
  cv::VideoWriter writer = opened;
  ASSERT_TRUE(writer.isOpened()) << file;
  for (int i = 0; i < kVideoFrames; ++i) writer.write(Quartered(i));
}

/// Writes 20 images at 25 Hz.
void WriteMotionJpeg(const fs::path& file) {
  WriteVideo(file, cv::VideoWriter(file.string(), cv::CAP_OPENCV_MJPEG,
                                   cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25.0,
                                   cv::Size(kTinyWidth, kTinyHeight)));
}

void WriteMpeg4(const fs::path& file) {
  WriteVideo(file, cv::VideoWriter(file.string(), cv::CAP_FFMPEG,
                                   cv::VideoWriter::fourcc('m', 'p', '4', 'v'), 25.0,
                                   cv::Size(kTinyWidth, kTinyHeight)));
}

ImageSource Open(const fs::path& file) { return OpenImages(file.string(), {}, {}); }

std::vector<TimedImage> ReadAll(ImageSource& source) {
  std::vector<TimedImage> images;
  while (const auto next = source.Next()) images.push_back(*next);
  return images;
}

TEST(DamagedVideo, ThatIsCutOffIsToldInTheSummary) {
  TemporaryFolder folder;
  WriteMotionJpeg(folder / "whole.avi");
  const std::string whole = ReadText(folder / "whole.avi");
  WriteText(folder / "cut.avi", whole.substr(0, whole.size() * 6 / 10));
  const auto summary_of = [&](const std::string& name) {
    const auto run = RunCorvo({"run", folder / name, "--fov", "70", "-o", folder / "out"});
    EXPECT_EQ(run.exit_code, 2) << run.err;  // Images without a scene yield no pose.
    return nlohmann::json::parse(ReadText(folder / "out/summary.json"));
  };
  nlohmann::json complete = summary_of("whole.avi");
  EXPECT_EQ(complete["video_frames"]["frames_promised"], kVideoFrames);
  EXPECT_EQ(complete["video_frames"]["frames_read"], kVideoFrames);
  EXPECT_EQ(complete["warnings"].dump().find("promises"), std::string::npos);
  nlohmann::json cut = summary_of("cut.avi");
  EXPECT_EQ(cut["video_frames"]["frames_promised"], kVideoFrames);
  EXPECT_EQ(cut["video_frames"]["frames_read"], cut["frames"]);
  EXPECT_LT(cut["frames"], kVideoFrames);
  EXPECT_THAT(cut["warnings"].dump(), HasSubstr("cut off or damaged: it promises 20 frames"));
}

TEST(DamagedVideo, IsReadOnBehindTheDamage) {
  TemporaryFolder folder;
  WriteMpeg4(folder / "drive.mp4");
  std::string bytes = ReadText(folder / "drive.mp4");
  std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() * 4 / 10), bytes.size() / 5,
              '\0');
  WriteText(folder / "drive.mp4", bytes);
  ImageSource source = Open(folder / "drive.mp4");
  const std::vector<TimedImage> images = ReadAll(source);
  const VideoFrames frames = source.video_frames().value();
  EXPECT_EQ(images.back().index, kVideoFrames - 1);
  EXPECT_EQ(images.back().time_ns, (kVideoFrames - 1) * 40'000'000LL);
  EXPECT_GT(frames.num_damaged, 0);
  EXPECT_EQ(frames.num_damaged + frames.num_read, kVideoFrames);
  EXPECT_EQ(static_cast<int>(images.size()), frames.num_read);
  EXPECT_THAT(VideoWarning(frames), HasSubstr("between them cannot be decoded"));
}

TEST(DamagedVideo, WarningsCountFrames) {
  EXPECT_EQ(VideoWarning(std::nullopt), "");
  EXPECT_EQ(VideoWarning(VideoFrames{60, 28, 0, false}), "");
  EXPECT_EQ(VideoWarning(VideoFrames{60, 28, 0, true}),
            "the video is cut off or damaged: it promises 60 frames, 28 were read");
  EXPECT_EQ(VideoWarning(VideoFrames{60, 57, 3, false}),
            "the video is damaged: it promises 60 frames, 57 were read, and 3 between them cannot "
            "be decoded");
}

/// A raw Motion JPEG stream: images one after the other.
void WriteSizes(const fs::path& file, const std::vector<cv::Size>& sizes) {
  std::string stream;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    std::vector<std::uint8_t> jpeg;
    ASSERT_TRUE(cv::imencode(".jpg", Quartered(static_cast<int>(i), sizes[i]), jpeg));
    stream.append(jpeg.begin(), jpeg.end());
  }
  WriteText(file, stream);
}

TEST(DamagedVideo, ImagesOfAnotherSizeAreMissing) {
  TemporaryFolder folder;
  const cv::Size first(kTinyWidth, kTinyHeight);
  WriteSizes(folder / "a.mjpeg", {first, first, {64, 48}, {128, 96}, first, {64, 64}});
  ImageSource source = Open(folder / "a.mjpeg");
  std::vector<Reason> reasons;
  for (const TimedImage& image : ReadAll(source)) reasons.push_back(image.missing);
  EXPECT_THAT(reasons, ElementsAre(Reason::kNone, Reason::kNone, Reason::kWrongSize,
                                   Reason::kWrongSize, Reason::kNone, Reason::kWrongSize));
}

/// Writes the matrix of a track's header in an MP4 file, which says how to turn its images.
void SetRotation(const fs::path& file, int clockwise_deg) {
  std::string bytes = ReadText(file);
  const std::size_t matrix = bytes.find("tkhd") + 4 + 4 + 20 + 8 + 8;
  const int cosine = clockwise_deg == 180 ? -1 : 0;
  const int sine = clockwise_deg == 180 ? 0 : (clockwise_deg == 90 ? 1 : -1);
  const int one = 1 << 16;
  const int values[] = {cosine * one, sine * one, 0, -sine * one, cosine * one};
  for (std::size_t i = 0; i < std::size(values); ++i) {
    for (std::size_t byte = 0; byte < 4; ++byte) {
      const auto value = static_cast<std::uint32_t>(values[i]);
      bytes[matrix + 4 * i + byte] = static_cast<char>(value >> (24 - 8 * byte));
    }
  }
  WriteText(file, bytes);
}

/// Returns the corner of the image that is white: 0 upper left, then clockwise.
int WhiteCorner(const cv::Mat& image) {
  const cv::Point corners[] = {
      {3, 3}, {image.cols - 4, 3}, {image.cols - 4, image.rows - 4}, {3, image.rows - 4}};
  for (int i = 0; i < 4; ++i) {
    if (image.at<std::uint8_t>(corners[i]) > 200) return i;
  }
  return -1;
}

TEST(Video, IsTurnedUprightAsThePhoneSays) {
  for (const int clockwise_deg : {90, 180, 270}) {
    TemporaryFolder folder;
    WriteMpeg4(folder / "phone.mp4");
    SetRotation(folder / "phone.mp4", clockwise_deg);
    const cv::Mat image = Open(folder / "phone.mp4").First().image;
    const bool is_turned_aside = clockwise_deg != 180;
    EXPECT_EQ(image.cols, is_turned_aside ? kTinyHeight : kTinyWidth);
    EXPECT_EQ(WhiteCorner(image), clockwise_deg / 90) << clockwise_deg;
  }
}

bool IsReadable(const fs::path& file) {
  try {
    return !ReadGrayImage(file).empty();
  } catch (const Error&) {
    return false;
  }
}

/// Returns the number of damaged images that are not used, of 20.
int CountRejected(const std::string& whole, const fs::path& file) {
  int num_rejected = 0;
  for (int i = 0; i < 20; ++i) {
    std::string bytes = whole;
    const std::size_t begin = whole.size() * (30 + static_cast<std::size_t>(i)) / 100;
    for (std::size_t k = 0; k < 40; ++k) bytes[begin + k] = static_cast<char>(37 * k + 11 * i);
    WriteText(file, bytes);
    num_rejected += !IsReadable(file);
  }
  return num_rejected;
}

TEST(DamagedImage, IsNotUsed) {
  TemporaryFolder folder;
  for (const char* name : {"a.jpg", "a.png"}) {
    WriteImage(folder / name, SmoothImage(1, 320, 240));
    // Some damage of a JPEG decodes without a complaint.
    EXPECT_GE(CountRejected(ReadText(folder / name), folder / name), 15) << name;
  }
}

TEST(DamagedImage, FewBytesBeforeAMarkerDamageNothing) {
  TemporaryFolder folder;
  WriteImage(folder / "a.jpg", SmoothImage(1, 320, 240));
  std::string bytes = ReadText(folder / "a.jpg");
  bytes.insert(bytes.size() - 2, 2, '\0');
  WriteText(folder / "a.jpg", bytes);
  EXPECT_EQ(ReadGrayImage(folder / "a.jpg").size(), cv::Size(320, 240));
}

}  // namespace
}  // namespace corvo::test
