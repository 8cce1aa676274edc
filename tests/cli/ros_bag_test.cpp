// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "apps/dataset/image_source.h"
#include "apps/dataset/ros_image.h"
#include "tests/cli/expect_error.h"
#include "tests/cli/tiny_sequence.h"

namespace corvo::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Returns an image of 3 x 2 px, whose rows are `step` bytes apart.
BagImage Image(const std::string& encoding, const std::string& data, std::int64_t step) {
  BagImage image;
  image.data = data;
  image.encoding = encoding;
  image.width = 3;
  image.height = 2;
  image.step = step;
  return image;
}

TEST(RosImage, MayHavePaddedRows) {
  const cv::Mat expected = (cv::Mat_<std::uint8_t>(2, 3) << 'a', 'b', 'c', 'd', 'e', 'f');
  for (const char* data : {"abc--def--", "abc--def"}) {
    const cv::Mat gray = RosImageToGray(Image("mono8", data, 5), "image");
    EXPECT_EQ(cv::norm(gray, expected, cv::NORM_INF), 0);
  }
}

TEST(RosImage, MayHaveEitherByteOrder) {
  BagImage image = Image("mono16", std::string("\1\2\3\4\5\6\7\0\1\2\3\4", 12), 6);
  EXPECT_EQ(RosImageToGray(image, "image").at<std::uint16_t>(1, 0), 0x0007);
  image.is_big_endian = true;
  EXPECT_EQ(RosImageToGray(image, "image").at<std::uint16_t>(1, 0), 0x0700);
}

TEST(RosImage, WithImpossibleFieldsIsAnError) {
  const auto error = [](const BagImage& image) {
    return ErrorOf([&] { RosImageToGray(image, "image"); });
  };
  EXPECT_THAT(error(Image("32FC1", "abcdef", 3)),
              StartsWith("image: encoding is '32FC1'; allowed are mono8 8UC1 "));
  EXPECT_THAT(error(Image("mono8", "abcdef", 2)), StartsWith("image: step is 2; allowed is 3 to "));
  EXPECT_THAT(error(Image("mono8", "abcde", 3)),
              HasSubstr("has 5 bytes; 3 x 2 px in mono8 with a step of 3 bytes need 6"));
  EXPECT_THAT(error(Image("", "abcdef", 3)), HasSubstr("image: not a readable image"));
  BagImage huge = Image("mono8", "abcdef", 3);
  huge.width = 0;
  EXPECT_THAT(error(huge), HasSubstr("image: width is 0; allowed is 1 to 100000000"));
  huge.width = 4'000'000'000;
  EXPECT_THAT(error(huge), HasSubstr("image: width is 4000000000"));
  huge.width = huge.height = 50'000;
  EXPECT_THAT(error(huge), HasSubstr("image: number of pixels is 2500000000"));
}

TEST(RosBag, IsReadByThePythonPackage) {
  const TemporaryFolder folder;
  for (const char* file : {"a.bag", "a.mcap", "a.db3", "ros2/metadata.yaml"}) {
    WriteText(folder / file, "rosbag2_bagfile_information:\n  version: 8\n");
  }
  for (const char* input : {"a.bag", "a.mcap", "a.db3", "ros2"}) {
    EXPECT_THAT(ErrorOf([&] { OpenImages((folder / input).string(), {}, {}); }),
                HasSubstr(std::string(input) +
                          ": is a ROS bag, which the Python package reads: pip install "
                          "'corvo[bags]'"));
  }
  InputOptions options;
  options.topic = "/camera";
  EXPECT_THAT(ErrorOf([&] { OpenImages(folder.path().string(), options, {}); }),
              HasSubstr("--topic /camera: is for ROS bags"));
}

}  // namespace
}  // namespace corvo::test
