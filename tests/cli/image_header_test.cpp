// SPDX-License-Identifier: MIT
#include "apps/dataset/image_header.h"

#include <algorithm>

#include <gmock/gmock.h>

#include "apps/dataset/image_reader.h"
#include "tests/cli/command.h"
#include "tests/cli/expect_error.h"
#include "tests/cli/tiny_sequence.h"
#include "tests/support/data.h"
#include "vo/io/file_bytes.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Returns a JPEG of 30 x 20 px whose EXIF says `orientation`.
std::string JpegWithOrientation(char orientation) {
  std::vector<std::uint8_t> encoded;
  cv::imencode(".jpg", TinyImage(1, 30, 20), encoded);
  const std::string jpeg(encoded.begin(), encoded.end());
  std::string exif("Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0", 24);
  exif += orientation;
  exif += std::string(7, '\0');
  const std::string length{'\0', static_cast<char>(exif.size() + 2)};
  return jpeg.substr(0, 2) + "\xFF\xE1" + length + exif + jpeg.substr(2);
}

/// Overwrites a big-endian number.
void PutBig(std::uint32_t value, std::size_t size, std::size_t at, std::string& bytes) {
  for (std::size_t i = 0; i < size; ++i) {
    bytes[at + size - 1 - i] = static_cast<char>(value >> (8 * i) & 0xff);
  }
}

class ImageHeaders : public testing::Test {
 protected:
  std::string Encoded(const std::string& name) const {
    WriteImage(folder_ / name, TinyImage(1, 30, 20));
    return ReadText(folder_ / name);
  }

  TemporaryFolder folder_;
};

TEST_F(ImageHeaders, StateTheSizeInEveryFormat) {
  for (const char* name : {"a.png", "a.jpg", "a.bmp", "a.pgm", "a.tif", "a.webp"}) {
    const auto header = ParseImageHeader(Encoded(name));
    ASSERT_TRUE(header) << name;
    EXPECT_EQ(header->width, 30) << name;
    EXPECT_EQ(header->height, 20) << name;
    EXPECT_EQ(header->orientation, 1) << name;
  }
  EXPECT_EQ(ParseImageHeader("P5 # comment\n 7\n#more\n 9 255\n")->height, 9);
}

TEST_F(ImageHeaders, AreParsedWithinTheBytes) {
  for (const char* name : {"a.png", "a.jpg", "a.bmp", "a.pgm", "a.tif", "a.webp"}) {
    const std::string bytes = Encoded(name);
    for (std::size_t size = 0; size < std::min<std::size_t>(bytes.size(), 600); ++size) {
      ParseImageHeader(bytes.substr(0, size));
    }
  }
  EXPECT_FALSE(ParseImageHeader(""));
  EXPECT_FALSE(ParseImageHeader("text"));
  EXPECT_FALSE(ParseImageHeader("P5 x"));
}

TEST_F(ImageHeaders, StateTheOrientation) {
  EXPECT_EQ(ParseImageHeader(JpegWithOrientation(1))->orientation, 1);
  EXPECT_EQ(ParseImageHeader(JpegWithOrientation(6))->orientation, 6);
  EXPECT_EQ(ParseImageHeader(JpegWithOrientation(99))->orientation, 1);
  EXPECT_EQ(ParseImageHeader(JpegWithOrientation(6))->width, 30);
}

TEST_F(ImageHeaders, ImagesThatWouldNeedTooMuchMemoryAreNotDecoded) {
  std::string png = Encoded("a.png"), jpeg = Encoded("a.jpg");
  PutBig(50000, 4, 16, png);
  PutBig(50000, 4, 20, png);
  const std::size_t frame = jpeg.find("\xFF\xC0");
  ASSERT_NE(frame, std::string::npos);
  PutBig(20000, 2, frame + 5, jpeg);
  PutBig(60000, 2, frame + 7, jpeg);
  WriteText(folder_ / "bomb.png", png);
  WriteText(folder_ / "bomb.jpg", jpeg);
  EXPECT_THAT(ErrorOf([&] { ReadGrayImage(folder_ / "bomb.png"); }),
              AllOf(HasSubstr("bomb.png: the image is 50000 x 50000 px"), HasSubstr("100000000")));
  EXPECT_THAT(ErrorOf([&] { ReadGrayImage(folder_ / "bomb.jpg"); }),
              HasSubstr("bomb.jpg: the image is 60000 x 20000 px"));
  EXPECT_THAT(ErrorOf([] { ReadGrayImage("/dev/zero"); }), HasSubstr("/dev/zero: has more than"));
}

TEST_F(ImageHeaders, OrientationIsIgnoredWithAWarningThatNamesTheFile) {
  WriteText(folder_ / "turned.jpg", JpegWithOrientation(6));
  const cv::Mat image = ReadGrayImage(folder_ / "turned.jpg");
  EXPECT_EQ(image.cols, 30);
  WriteText(folder_ / "upright.jpg", JpegWithOrientation(1));
  const auto features = [&](const std::string& name) {
    return RunCorvo({"features", folder_ / name, "-o", folder_ / "out"}).err;
  };
  EXPECT_THAT(features("turned.jpg"), AllOf(HasSubstr("corvo: warning: "),
                                            HasSubstr("turned.jpg: has the EXIF orientation 6")));
  EXPECT_THAT(features("upright.jpg"), Not(HasSubstr("EXIF")));
}

TEST_F(ImageHeaders, ComplaintsOfDecodersNameTheFile) {
  std::string png = Encoded("a.png");
  png[png.find("IDAT") + 30] ^= 0x55;
  WriteText(folder_ / "damaged.png", png);
  const CommandResult result = RunCorvo({"features", folder_ / "damaged.png", "-o", folder_ / "o"});
  EXPECT_THAT(result.err, testing::StartsWith("corvo: error: "));
  EXPECT_THAT(result.err, HasSubstr("damaged.png: not a readable image (libpng"));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

}  // namespace
}  // namespace corvo::test
