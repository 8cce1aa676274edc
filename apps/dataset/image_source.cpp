// SPDX-License-Identifier: MIT
#include "apps/dataset/image_source.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "apps/dataset/bag_reader.h"
#include "apps/dataset/image_layouts.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Returns the number in "7" or "camera:7", or std::nullopt for any other text.
std::optional<int> ParseDevice(std::string_view input) {
  constexpr std::string_view kPrefix = "camera:";
  if (input.substr(0, kPrefix.size()) == kPrefix) input.remove_prefix(kPrefix.size());
  constexpr std::size_t kMaxDigits = 4;
  if (input.empty() || input.size() > kMaxDigits) return std::nullopt;
  int device = 0;
  for (const char c : input) {
    if (c < '0' || c > '9') return std::nullopt;
    device = 10 * device + (c - '0');
  }
  return device;
}

/// Returns how many of `num_images` images are selected.
int NumSelected(int num_images, const Selection& selection) {
  const int rest = std::max(0, num_images - selection.start);
  const int size = (rest + selection.every - 1) / selection.every;
  return selection.count ? std::min(size, *selection.count) : size;
}

std::string SizeError(const TimedImage& image, const cv::Size& size) {
  return fmt::format("{}: the image is {} x {} px, the camera {} x {} px", image.name,
                     image.image.cols, image.image.rows, size.width, size.height);
}

/// Throws corvo::Error if a topic is given for an input that has none.
void CheckTopic(const std::string& topic, const std::string& input, bool is_bag) {
  if (topic.empty() || is_bag) return;
  throw Error(fmt::format("--topic {}: is for ROS bags; {} is none", topic, input));
}

cv::Mat ResizeMask(const cv::Mat& mask, const cv::Size& size) {
  if (mask.empty() || mask.size() == size) return mask;
  cv::Mat resized;
  cv::resize(mask, resized, size, 0, 0, cv::INTER_NEAREST);
  return resized;
}

}  // namespace

ImageSource::ImageSource(ImageList list, const Selection& selection, std::optional<int> bits)
    : list_(std::move(list)), reader_(OpenFiles(list_.images, bits)), selection_(selection) {}

ImageSource::ImageSource(ImageList list, std::unique_ptr<ImageReader> reader,
                         const Selection& selection)
    : list_(std::move(list)), reader_(std::move(reader)), selection_(selection) {}

bool ImageSource::ReadAhead() {
  std::optional<TimedImage> next = ReadNext();
  if (next) ahead_.push_back(std::move(*next));
  return next.has_value();
}

const TimedImage& ImageSource::First() {
  const auto is_readable = [](const TimedImage& image) { return image.missing == Reason::kNone; };
  auto first = std::ranges::find_if(ahead_, is_readable);
  while (first == ahead_.end() && ReadAhead()) first = std::ranges::find_if(ahead_, is_readable);
  if (first != ahead_.end()) return *first;
  if (ahead_.empty()) throw Error("there are no images: the sequence ends before --start");
  if (ahead_.size() == 1) throw Error(ahead_.front().error);
  throw Error(
      fmt::format("{} (none of {} images can be read)", ahead_.front().error, ahead_.size()));
}

void ImageSource::Prepare(Preparation preparation) {
  constexpr std::size_t kMaxAhead = 10;  // A camera of another resolution is noticed soon.
  const std::string error = SizeError(First(), preparation.size);
  const auto has_size = [&](const TimedImage& image) {
    return image.image.size() == preparation.size;
  };
  while (std::ranges::none_of(ahead_, has_size)) {
    if (requires_all_ || ahead_.size() >= kMaxAhead || !ReadAhead()) throw Error(error);
  }
  preparation_ = std::move(preparation);
}

std::optional<TimedImage> ImageSource::Next() {
  if (ahead_.empty() && !ReadAhead()) return std::nullopt;
  TimedImage next = std::move(ahead_.front());
  ahead_.pop_front();
  if (!preparation_ || next.missing != Reason::kNone) return next;
  if (next.image.size() != preparation_->size) {
    next.missing = Reason::kWrongSize;
    next.error = SizeError(next, preparation_->size);
    next.image = cv::Mat();
    if (requires_all_) throw Error(next.error);
    return next;
  }
  next.mask = ResizeMask(preparation_->mask_source.MaskOf(next), preparation_->resize_to);
  next.image = ResizeImage(next.image, preparation_->resize_to);
  return next;
}

bool ImageSource::Skip() {
  if (ahead_.empty()) {
    if (!Advance()) return false;
    ++num_passed_;
    return reader_->Skip();
  }
  ahead_.pop_front();
  return true;
}

std::optional<TimedImage> ImageSource::ReadNext() {
  if (!Advance()) return std::nullopt;
  const auto position = static_cast<std::size_t>(num_passed_++);
  std::optional<TimedImage> next;
  try {
    next = reader_->Read();
  } catch (const Error& error) {
    if (position >= list_.images.size()) throw;  // Not a file.
    const TimedFile& file = list_.images[position];
    next = TimedImage{{},
                      {},
                      file.time_ns,
                      static_cast<int>(position),
                      file.file.string(),
                      Reason::kUnreadableImage,
                      error.what()};
  }
  if (next && next->missing != Reason::kNone && requires_all_) throw Error(next->error);
  return next;
}

bool ImageSource::Advance() {
  if (selection_.count && num_read_ == *selection_.count) return false;
  const int num_skipped = num_read_ == 0 ? selection_.start : selection_.every - 1;
  for (int i = 0; i < num_skipped; ++i) {
    if (!reader_->Skip()) return false;
    ++num_passed_;
  }
  ++num_read_;
  return true;
}

std::optional<int> ImageSource::size() const {
  if (list_.images.empty()) return selection_.count;
  return NumSelected(static_cast<int>(list_.images.size()), selection_);
}

std::optional<int> ImageSource::expected_size() const {
  const std::optional<VideoFrames> video = video_frames();
  if (!video || video->num_promised <= 0) return size();
  return NumSelected(video->num_promised, selection_);
}

cv::Mat ResizeImage(const cv::Mat& image, const cv::Size& size) {
  if (image.size() == size) return image;
  const bool shrinks = size.width <= image.cols && size.height <= image.rows;
  cv::Mat resized;
  cv::resize(image, resized, size, 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_LINEAR);
  return resized;
}

bool IsLiveInput(const std::string& input) { return ParseDevice(input) && !fs::exists(input); }

ImageSource OpenImages(const std::string& input, const InputOptions& options,
                       const Selection& selection) {
  const bool is_bag = IsBag(input);
  const bool is_video = !is_bag && fs::is_regular_file(input);
  if (is_video && HasImageExtension(input)) {
    throw Error(fmt::format("{}: is a single image; give its folder or a quoted pattern", input));
  }
  CheckTopic(options.topic, input, is_bag);
  if (!is_bag && !is_video && !IsLiveInput(input)) {
    return ImageSource(ListImages(input, options), selection, options.bits);
  }
  if (!options.times.empty()) {
    throw Error(fmt::format("{}: times are for image files; {} has its own", options.times.string(),
                            input));
  }
  if (is_bag) {
    BagImages bag = OpenBag(input, options);
    return {ImageList{"bag", {}, bag.camera}, std::move(bag.reader), selection};
  }
  if (is_video) {
    return {ImageList{"video", {}, {}}, OpenVideo(input, options.frame_rate_hz), selection};
  }
  return {ImageList{"camera", {}, {}}, OpenCamera(*ParseDevice(input)), selection};
}

}  // namespace corvo
