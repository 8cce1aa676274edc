// SPDX-License-Identifier: MIT
#include "apps/dataset/tum_mono_sequence.h"

#include <fmt/format.h>

#include "apps/dataset/image_layouts.h"
#include "orb/error.h"
#include "vo/io/decimal_time.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTimes = "times.txt";
constexpr const char* kFolder = "images";
constexpr const char* kCamera = "camera.txt";

/// Parses a line of exactly `count` numbers. `meaning` describes them in the error message.
std::vector<double> ParseNumbers(const TextLine& line, std::size_t count, const char* meaning,
                                 const fs::path& file) {
  const std::string where = LinePrefix(file, line);
  const std::vector<std::string> fields = SplitFields(line.text);
  if (fields.size() != count) {
    throw Error(fmt::format("{}'{}' is not '{}'", where, line.text, meaning));
  }
  std::vector<double> numbers;
  for (const std::string& field : fields) numbers.push_back(ParseNumber(field, where));
  return numbers;
}

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

CameraParameters ReadTumMonoCamera(const fs::path& file) {
  const std::vector<TextLine> lines = ReadTextLines(file);
  if (lines.size() < 2) throw Error(fmt::format("{}: has no second line", file.string()));
  const auto shape = ParseNumbers(lines[0], 5, "fx fy cx cy omega", file);
  const auto size = ParseNumbers(lines[1], 2, "width height", file);
  if (shape[2] > 1 || shape[3] > 1) {
    throw Error(fmt::format("{}'{}': cx and cy must be fractions of the image's width and height",
                            LinePrefix(file, lines[0]), lines[0].text));
  }
  const std::string where = LinePrefix(file, lines[1]);
  CheckRange(where + "width", size[0], 1.0, 1e5);
  CheckRange(where + "height", size[1], 1.0, 1e5);
  CameraParameters camera;
  camera.model = CameraModel::kFov;
  camera.width = static_cast<int>(size[0]);
  camera.height = static_cast<int>(size[1]);
  camera.fx = shape[0] * size[0];
  camera.fy = shape[1] * size[1];
  camera.cx = shape[2] * size[0] - 0.5;
  camera.cy = shape[3] * size[1] - 0.5;
  camera.omega = shape[4];
  try {
    camera.Validate();
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
  return camera;
}

bool IsTumMonoSequence(const fs::path& input) {
  return fs::exists(input / kTimes) &&
         (fs::is_directory(input / kFolder) || fs::exists(input / "images.zip"));
}

ImageList ListTumMonoImages(const fs::path& input) {
  const fs::path folder = input / kFolder;
  if (!fs::is_directory(folder)) {
    throw Error(fmt::format("{0}/images.zip: unpack it into {0}/images", input.string()));
  }
  const std::vector<fs::path> files = ImageFilesIn(folder);
  const fs::path times = input / kTimes;
  const std::vector<TextLine> lines = ReadTableLines(times);
  if (files.size() != lines.size()) {
    throw Error(fmt::format("{}: {} timestamps for the {} images in {}", times.string(),
                            lines.size(), files.size(), folder.string()));
  }
  ImageList list{"tum-mono", {}, {}};
  for (std::size_t i = 0; i < files.size(); ++i) {
    list.images.push_back({files[i], ParseRow(lines[i], files[i], times)});
  }
  if (fs::exists(input / kCamera)) list.camera = ReadTumMonoCamera(input / kCamera);
  return list;
}

}  // namespace corvo
