// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "apps/dataset/dataset_camera.h"
#include "apps/dataset/image_layouts.h"
#include "apps/dataset/image_times.h"
#include "apps/dataset/list_entry.h"
#include "orb/error.h"
#include "vo/io/decimal_time.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kList = "data.csv";
constexpr const char* kImages = "data";
constexpr const char* kSensor = "sensor.yaml";

bool IsCameraFolder(const fs::path& folder) {
  return fs::exists(folder / kList) ||
         (fs::is_directory(folder / kImages) && fs::exists(folder / kSensor));
}

/// Returns the folder of cam0, or else of cam1, or an empty path. `input` is `mav0`, its parent
/// folder or the folder itself.
fs::path CameraFolder(const fs::path& input) {
  for (const fs::path& folder :
       {input / "mav0/cam0", input / "cam0", input / "mav0/cam1", input / "cam1", input}) {
    if (IsCameraFolder(folder)) return folder;
  }
  return {};
}

/// Returns the path of a listed image, relative to the folder of images or, with folders in its
/// name, to that of the cameras.
fs::path ListedImage(const fs::path& folder, const std::string& name, const std::string& where) {
  const bool has_folders = name.find('/') != std::string::npos;
  return EntryPath(has_folders ? folder.parent_path() : folder / kImages, name, where);
}

/// Appends the images in the list.
void AddListedImages(const fs::path& folder, ImageList& list) {
  const fs::path file = folder / kList;
  const std::vector<TextLine> lines = ReadTableLines(file);
  const TimeUnit unit =
      lines.empty() ? TimeUnit::kNanoseconds : GuessEurocTimeUnit(SplitFields(lines[0].text)[0]);
  for (const TextLine& line : lines) {
    const std::string where = LinePrefix(file, line);
    const std::vector<std::string> fields = SplitFields(line.text);
    if (fields.size() != 2 || fields[1].empty()) {
      throw Error(fmt::format("{}'{}' is not 'timestamp [ns],filename'", where, line.text));
    }
    list.images.push_back(
        {ListedImage(folder, fields[1], where), ParseTime(fields[0], unit, where)});
  }
}

/// Appends the images with their names as times, which are in ns.
void AddUnlistedImages(const fs::path& folder, ImageList& list) {
  const std::vector<fs::path> files = ImageFilesIn(folder / kImages);
  const auto times = TimesInNames(files);
  if (!times) {
    throw Error(fmt::format("{}: is missing, and the names of the images in {} are not their times",
                            (folder / kList).string(), (folder / kImages).string()));
  }
  AddTimedImages(files, *times, list);
}

/// Reads the calibration in the camera's folder (EuRoC) or beside `mav0` (TUM-VI). Returns
/// std::nullopt if there is none.
std::optional<CameraParameters> FindEurocCamera(const fs::path& folder,
                                                const fs::path& first_image) {
  const fs::path sensor = folder / kSensor;
  if (fs::exists(sensor)) return ReadDatasetCamera(sensor, "", first_image);
  const fs::path absolute = AbsoluteFolder(folder);
  const fs::path chain = absolute.parent_path().parent_path() / "dso" / "camchain.yaml";
  const char* const name = absolute.filename() == "cam1" ? "cam1" : "cam0";
  if (fs::exists(chain)) return ReadDatasetCamera(chain, name, first_image);
  return std::nullopt;
}

}  // namespace

bool IsEurocSequence(const fs::path& input) { return !CameraFolder(input).empty(); }

ImageList ListEurocImages(const fs::path& input, const InputOptions& options) {
  ImageList list{"euroc", {}, {}};
  const fs::path folder = CameraFolder(input);
  if (fs::exists(folder / kList)) {
    AddListedImages(folder, list);
  } else {
    AddUnlistedImages(folder, list);
  }
  if (options.reads_camera && !list.images.empty()) {
    list.camera = FindEurocCamera(folder, list.images.front().file);
  }
  return list;
}

}  // namespace corvo
