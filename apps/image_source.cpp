#include "apps/image_source.h"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include "apps/image_layouts.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

ImageList ListByLayout(const fs::path& input, double frame_rate_hz) {
  if (IsKittiSequence(input)) return ListKittiImages(input);
  if (IsEurocSequence(input)) return ListEurocImages(input);
  if (IsTumSequence(input)) return ListTumImages(input);
  return ListFolderImages(input, frame_rate_hz);
}

void CheckFiles(const std::vector<TimedFile>& images) {
  for (const TimedFile& image : images) {
    if (!fs::is_regular_file(image.file)) {
      throw Error(fmt::format("{}: listed in the sequence but not there", image.file.string()));
    }
  }
}

void CheckTimesAscend(const std::vector<TimedFile>& images) {
  for (std::size_t i = 1; i < images.size(); ++i) {
    if (images[i].time_ns > images[i - 1].time_ns) continue;
    throw Error(fmt::format("{}: its time, {} ns, does not lie after {} ns, the time of {}",
                            images[i].file.string(), images[i].time_ns, images[i - 1].time_ns,
                            images[i - 1].file.filename().string()));
  }
}

}  // namespace

ImageList ListImages(const fs::path& input, double frame_rate_hz) {
  if (!fs::exists(input)) throw Error(fmt::format("{}: no such folder", input.string()));
  if (!fs::is_directory(input)) {
    throw Error(
        fmt::format("{}: not a folder; give the folder of an image sequence", input.string()));
  }
  ImageList list = ListByLayout(input, frame_rate_hz);
  if (list.images.empty()) throw Error(fmt::format("{}: holds no pictures", input.string()));
  CheckFiles(list.images);
  CheckTimesAscend(list.images);
  return list;
}

cv::Mat ReadGreyImage(const fs::path& file) {
  cv::Mat image;
  try {
    image = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) throw Error(fmt::format("{}: not a readable picture", file.string()));
  return image;
}

std::optional<TimedImage> ImageSource::Next() {
  if (next_ == list_.images.size()) return std::nullopt;
  const TimedFile& entry = list_.images[next_++];
  return TimedImage{ReadGreyImage(entry.file), entry.time_ns};
}

}  // namespace corvo
