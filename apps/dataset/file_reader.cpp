// SPDX-License-Identifier: MIT
#include "apps/dataset/image_reader.h"

namespace corvo {
namespace {

class FileReader : public ImageReader {
 public:
  explicit FileReader(std::vector<TimedFile> files) : files_(std::move(files)) {}

  std::optional<TimedImage> Read() override {
    if (next_ == files_.size()) return std::nullopt;
    const TimedFile& entry = files_[next_];
    const int index = static_cast<int>(next_++);
    return TimedImage{ReadGrayImage(entry.file), {}, entry.time_ns, index, entry.file.string()};
  }

  bool Skip() override {
    if (next_ == files_.size()) return false;
    ++next_;
    return true;
  }

 private:
  std::vector<TimedFile> files_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<ImageReader> OpenFiles(std::vector<TimedFile> files) {
  return std::make_unique<FileReader>(std::move(files));
}

}  // namespace corvo
