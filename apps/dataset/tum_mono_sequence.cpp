// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "apps/dataset/dataset_camera.h"
#include "apps/dataset/image_layouts.h"
#include "orb/error.h"
#include "vo/io/decimal_time.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMonoTimes = "times.txt";
constexpr const char* kFolder = "images";
constexpr const char* kCamera = "camera.txt";

/// Parses the timestamp of an image, which is the second column. The first column is the image's
/// name, the third, optional one its exposure.
TimeNs ParseRow(const TextLine& line, const fs::path& image, const fs::path& file) {
  const std::string where = LinePrefix(file, line);
  const std::vector<std::string> fields = SplitFields(line.text);
  if (fields.size() < 2 || fields.size() > 3) {
    throw Error(fmt::format("{}'{}' is not 'name time exposure'", where, line.text));
  }
  if (fields[0] != image.stem().string()) {
    throw Error(
        fmt::format("{}'{}' is not the image {}", where, fields[0], image.filename().string()));
  }
  return ParseTime(fields[1], GuessTimeUnit(fields[1]), where);
}

}  // namespace

bool IsTumMonoSequence(const fs::path& input) {
  return fs::exists(input / kMonoTimes) &&
         (fs::is_directory(input / kFolder) || fs::exists(input / "images.zip"));
}

ImageList ListTumMonoImages(const fs::path& input, const InputOptions& options) {
  const fs::path folder = input / kFolder;
  if (!fs::is_directory(folder)) {
    throw Error(fmt::format("{0}/images.zip: unpack it into {0}/images", input.string()));
  }
  const std::vector<fs::path> files = ImageFilesIn(folder);
  const fs::path times = input / kMonoTimes;
  const std::vector<TextLine> lines = ReadTableLines(times);
  CheckNumTimes(times, lines.size(), folder, files.size());
  ImageList list{"tum-mono", {}, {}};
  for (std::size_t i = 0; i < files.size(); ++i) {
    list.images.push_back({files[i], ParseRow(lines[i], files[i], times)});
  }
  const bool has_camera = !files.empty() && fs::exists(input / kCamera);
  if (options.reads_camera && has_camera)
    list.camera = ReadDatasetCamera(input / kCamera, "", files.front());
  return list;
}

}  // namespace corvo
