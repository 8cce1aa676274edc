// SPDX-License-Identifier: MIT
#include "apps/export/exported_images.h"

#include <map>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "apps/dataset/image_reader.h"
#include "apps/dataset/image_source.h"
#include "apps/output/file_extension.h"
#include "apps/output/image_file.h"
#include "apps/system/durable_file.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// The conversion of input images to exported ones.
class Exporter {
 public:
  Exporter(const CameraParameters& camera, const GrayLevels& levels,
           const std::optional<Undistortion>& undistortion, fs::path folder)
      : size_(camera.width, camera.height),
        levels_(levels),
        undistortion_(undistortion),
        folder_(std::move(folder)) {}

  void ExportFile(const fs::path& file, const std::string& name) const {
    const cv::Mat image = ReadStoredColor(file);
    if (!undistortion_ && image.size() == size_ && image.depth() == CV_8U) {
      const fs::path target = Prepare(name);
      std::error_code error;
      fs::copy_file(file, target, fs::copy_options::overwrite_existing, error);
      if (error) throw Error(fmt::format("{}: {}", target.string(), error.message()));
    } else {
      Write(levels_.ToByte(image), name);
    }
  }

  void Write(const cv::Mat& image, const std::string& name) const {
    cv::Mat exported = ResizeImage(image, size_);
    if (undistortion_) exported = undistortion_->Apply(exported);
    const fs::path target = Prepare(name);
    const bool is_gray = LowerExtension(target) == ".pgm";  // That form holds no color.
    if (is_gray) cv::cvtColor(exported, exported, cv::COLOR_BGR2GRAY);
    WriteFile(target, EncodeImage(exported, target.extension().string()));
  }

 private:
  /// Returns the path of an image and makes its folder.
  fs::path Prepare(const std::string& name) const {
    const fs::path target = folder_ / name;
    fs::create_directories(target.parent_path());
    return target;
  }

  cv::Size size_;
  const GrayLevels& levels_;
  const std::optional<Undistortion>& undistortion_;
  fs::path folder_;
};

/// Writes frames of a video or bag, which is decoded once; those of a bag in gray.
void ExportVideo(const RunResult& result, const Reconstruction& reconstruction,
                 const Exporter& exporter) {
  std::map<int, std::string> names;  // By position in the video.
  for (const ReconstructedImage& image : reconstruction.images) {
    names[std::stoi(result.frames[image.frame].image)] = image.name;
  }
  ImageSource source = OpenImages(result.video.string(), result.stored, {});
  int position = 0;
  for (const auto& [wanted, name] : names) {
    for (; position < wanted; ++position) source.Skip();
    const std::optional<TimedImage> image = source.Next();
    ++position;
    if (!image || image->missing != Reason::kNone) {
      throw Error(fmt::format("{}: frame {} cannot be read", result.video.string(), wanted));
    }
    exporter.Write(image->color.empty() ? image->image : image->color, name);
  }
}

}  // namespace

void ExportImages(const RunResult& result, const Reconstruction& reconstruction,
                  const std::optional<Undistortion>& undistortion, const fs::path& folder) {
  const Exporter exporter(reconstruction.camera, result.gray_levels, undistortion, folder);
  if (!result.video.empty()) {
    ExportVideo(result, reconstruction, exporter);
    return;
  }
  if (result.image_folder.empty()) {
    throw Error("the images of a live camera cannot be exported: they were not stored");
  }
  for (const ReconstructedImage& image : reconstruction.images) {
    exporter.ExportFile(result.image_folder / result.frames[image.frame].image, image.name);
  }
}

}  // namespace corvo
