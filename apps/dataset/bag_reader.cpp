// SPDX-License-Identifier: MIT
#include "apps/dataset/bag_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "apps/codecs/codecs.h"
#include "apps/dataset/camera_formats/calibration_file.h"
#include "apps/dataset/ros_image.h"
#include "apps/dataset/sequence_levels.h"
#include "orb/error.h"
#include "vo/io/file_bytes.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kExtensions = {".bag", ".mcap", ".db3"};

bool IsBagFolder(const fs::path& folder) {
  const fs::path metadata = folder / "metadata.yaml";
  if (!fs::is_regular_file(metadata)) return false;
  const std::string text = ReadFileBytes(metadata, kMaxTextBytes);
  return text.find("rosbag2_bagfile_information") != std::string::npos;
}

/// Reads a bag once more, image by image.
class SecondReading {
 public:
  SecondReading(const fs::path& bag, const std::string& topic)
      : name_(bag.string()), input_(GetCodecs().OpenBag(name_, topic)) {}

  /// Returns the image with an index, which is at least the one before.
  cv::Mat Image(int wanted) {
    while (index_ < wanted && input_->Grab()) ++index_;
    return RosImageToGray(input_->Retrieve(), name_);
  }

 private:
  std::string name_;
  std::unique_ptr<BagInput> input_;
  int index_ = -1;
};

class BagReader : public ImageReader {
 public:
  BagReader(std::unique_ptr<BagInput> input, const fs::path& bag, const InputOptions& options)
      : input_(std::move(input)),
        name_(bag.string()),
        frame_rate_hz_(options.frame_rate_hz),
        levels_({name_, input_->num_images(),
                 [this, bag, topic = options.topic](int index) {
                   if (!again_) again_.emplace(bag, topic);
                   return again_->Image(index);
                 }},
                options.bits) {
    frames_.num_promised = input_->num_images();
  }

  std::optional<TimedImage> Read() override {
    if (!Skip()) return std::nullopt;
    const BagImage message = input_->Retrieve();
    const int index = frames_.num_read - 1;
    TimedImage read{{}, {}, message.time_ns, index, fmt::format("{}, image {}", name_, index)};
    if (frame_rate_hz_) read.time_ns = std::llround(1e9 * index / *frame_rate_hz_);
    try {
      read.image = levels_.ToByte(RosImageToGray(message, read.name));
    } catch (const Error& error) {
      read.missing = Reason::kUnreadableImage;
      read.error = error.what();
    }
    return read;
  }

  bool Skip() override {
    if (!input_->Grab()) return false;
    ++frames_.num_read;
    return true;
  }

  std::optional<VideoFrames> video_frames() const override { return frames_; }
  std::optional<GrayLevels> gray_levels() const override { return levels_.levels(); }

 private:
  std::unique_ptr<BagInput> input_;
  std::string name_;
  std::optional<double> frame_rate_hz_;
  std::optional<SecondReading> again_;  ///< Opened for the levels of 16-bit images.
  SequenceLevels levels_;
  VideoFrames frames_;
};

std::optional<CameraParameters> CameraOf(const BagInput& input, const fs::path& bag) {
  const std::string calibration = input.calibration();
  if (calibration.empty()) return std::nullopt;
  return ParseCalibration(calibration, bag).camera.parameters;
}

}  // namespace

bool IsBag(const fs::path& input) {
  if (fs::is_directory(input)) return IsBagFolder(input);
  return fs::is_regular_file(input) &&
         std::ranges::count(kExtensions, input.extension().string()) > 0;
}

BagImages OpenBag(const fs::path& bag, const InputOptions& options) {
  std::unique_ptr<BagInput> input = GetCodecs().OpenBag(bag.string(), options.topic);
  BagImages images;
  if (options.reads_camera) images.camera = CameraOf(*input, bag);
  images.reader = std::make_unique<BagReader>(std::move(input), bag, options);
  return images;
}

}  // namespace corvo
