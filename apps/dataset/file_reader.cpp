// SPDX-License-Identifier: MIT
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "apps/dataset/image_reader.h"
#include "apps/dataset/sequence_levels.h"

namespace corvo {
namespace {

StoredImages ImagesIn(const std::vector<TimedFile>& files) {
  return {files.empty() ? "" : files.front().file.parent_path().string(),
          static_cast<int>(files.size()),
          [&files](int i) { return ReadStoredGray(files[i].file); }};
}

class FileReader : public ImageReader {
 public:
  FileReader(std::vector<TimedFile> files, std::optional<int> bits)
      : files_(std::move(files)), levels_(ImagesIn(files_), bits) {}

  std::optional<TimedImage> Read() override {
    if (next_ == files_.size()) return std::nullopt;
    const TimedFile& entry = files_[next_];
    const int index = static_cast<int>(next_++);
    return TimedImage{
        levels_.ToByte(ReadStoredGray(entry.file)), {}, entry.time_ns, index, entry.file.string()};
  }

  bool Skip() override {
    if (next_ == files_.size()) return false;
    ++next_;
    return true;
  }

  std::optional<GrayLevels> gray_levels() const override { return levels_.levels(); }

 private:
  const std::vector<TimedFile> files_;
  SequenceLevels levels_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<ImageReader> OpenFiles(std::vector<TimedFile> files, std::optional<int> bits) {
  return std::make_unique<FileReader>(std::move(files), bits);
}

}  // namespace corvo
