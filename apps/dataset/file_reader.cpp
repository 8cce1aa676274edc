// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/dataset/image_reader.h"
#include "orb/error.h"

namespace corvo {
namespace {

/// Returns the map of the gray levels of a sequence: of eight images all over it, so that it is the
/// same for every selection.
GrayLevels FindGrayLevels(const std::vector<TimedFile>& files) {
  constexpr std::size_t kMaxImages = 8;
  GrayHistogram histogram;
  const std::size_t step = (files.size() + kMaxImages - 1) / kMaxImages;
  for (std::size_t i = 0; i < files.size(); i += step) {
    try {
      const cv::Mat image = ReadStoredGray(files[i].file);
      if (image.depth() == CV_16U) histogram.Add(image);
    } catch (const Error&) {  // It is named when the sequence gets there.
    }
  }
  const GrayLevels levels = histogram.Levels();
  spdlog::info("{}: 16-bit images; used are {} (--bits changes that)",
               files.front().file.parent_path().string(), levels.text());
  return levels;
}

class FileReader : public ImageReader {
 public:
  FileReader(std::vector<TimedFile> files, std::optional<int> bits) : files_(std::move(files)) {
    if (bits) stated_ = GrayLevels(*bits);
  }

  std::optional<TimedImage> Read() override {
    if (next_ == files_.size()) return std::nullopt;
    const TimedFile& entry = files_[next_];
    const int index = static_cast<int>(next_++);
    return TimedImage{ReadByteGray(entry.file), {}, entry.time_ns, index, entry.file.string()};
  }

  bool Skip() override {
    if (next_ == files_.size()) return false;
    ++next_;
    return true;
  }

  std::optional<GrayLevels> gray_levels() const override { return levels_; }

 private:
  cv::Mat ReadByteGray(const std::filesystem::path& file) {
    const cv::Mat image = ReadStoredGray(file);
    if (image.depth() != CV_16U) return image;
    if (!levels_) levels_ = stated_ ? *stated_ : FindGrayLevels(files_);
    return levels_->ToByte(image);
  }

  std::vector<TimedFile> files_;
  std::optional<GrayLevels> stated_;  ///< By --bits.
  std::optional<GrayLevels> levels_;  ///< Set with the first 16-bit image.
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<ImageReader> OpenFiles(std::vector<TimedFile> files, std::optional<int> bits) {
  return std::make_unique<FileReader>(std::move(files), bits);
}

}  // namespace corvo
