// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "apps/dataset/image_layouts.h"
#include "apps/dataset/image_times.h"
#include "apps/dataset/list_entry.h"
#include "apps/dataset/sensor_yaml.h"
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
  for (std::size_t i = 0; i < files.size(); ++i) list.images.push_back({files[i], (*times)[i]});
}

/// Returns the list of numbers under `key`, which must have `count` to `max_count` entries.
std::vector<double> ReadNumbers(const YAML::Node& root, const char* key, std::size_t count,
                                std::size_t max_count) {
  const YAML::Node node = root[key];
  if (!node) throw Error(fmt::format("{} is missing", key));
  if (!node.IsSequence() || node.size() < count || node.size() > max_count) {
    throw Error(fmt::format("{} is not a list of {} numbers", key, count));
  }
  std::vector<double> numbers;
  for (const YAML::Node& number : node) numbers.push_back(number.as<double>());
  return numbers;
}

/// Returns the model for EuRoC's radial-tangential (Kalibr's radtan) distortion, or kb4 for
/// Kalibr's equidistant distortion. Throws corvo::Error for any other model.
CameraModel ParseModel(const YAML::Node& root) {
  const auto model = root["camera_model"].as<std::string>("");
  if (model != "pinhole") {
    throw Error(fmt::format("camera_model is '{}'; only pinhole is supported", model));
  }
  const auto distortion = root["distortion_model"].as<std::string>("");
  if (distortion == "radial-tangential" || distortion == "radtan") return CameraModel::kPinhole;
  if (distortion == "equidistant") return CameraModel::kKb4;
  throw Error(
      fmt::format("distortion_model is '{}'; only radial-tangential and equidistant are supported",
                  distortion));
}

void SetDistortion(std::vector<double> numbers, CameraParameters& camera) {
  numbers.resize(5, 0.0);
  const bool is_kb4 = camera.model == CameraModel::kKb4;
  camera.k1 = numbers[0];
  camera.k2 = numbers[1];
  (is_kb4 ? camera.k3 : camera.p1) = numbers[2];
  (is_kb4 ? camera.k4 : camera.p2) = numbers[3];
  if (!is_kb4) camera.k3 = numbers[4];
}

CameraParameters ParseCamera(const YAML::Node& root, const char* distortion_key) {
  CameraParameters camera;
  camera.model = ParseModel(root);
  const std::vector<double> size = ReadNumbers(root, "resolution", 2, 2);
  const std::vector<double> intrinsics = ReadNumbers(root, "intrinsics", 4, 4);
  const std::size_t max_distortion = camera.model == CameraModel::kKb4 ? 4 : 5;
  SetDistortion(ReadNumbers(root, distortion_key, 4, max_distortion), camera);
  CheckRange("resolution: width", size[0], 1.0, 1e5);
  CheckRange("resolution: height", size[1], 1.0, 1e5);
  camera.width = static_cast<int>(size[0]);
  camera.height = static_cast<int>(size[1]);
  camera.fx = intrinsics[0];
  camera.fy = intrinsics[1];
  camera.cx = intrinsics[2];
  camera.cy = intrinsics[3];
  camera.Validate();
  return camera;
}

CameraParameters ParseSensor(const YAML::Node& root) {
  return ParseCamera(root, "distortion_coefficients");
}

/// Parses cam0 of a camchain.yaml as written by Kalibr.
CameraParameters ParseCameraChain(const YAML::Node& root) {
  if (!root["cam0"]) throw Error("cam0 is missing");
  return ParseCamera(root["cam0"], "distortion_coeffs");
}

CameraParameters ReadCamera(const fs::path& file, CameraParameters (*parse)(const YAML::Node&)) {
  const YAML::Node root = LoadSensorYaml(file);
  try {
    return parse(root);
  } catch (const YAML::Exception& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

/// Reads the calibration in the camera's folder (EuRoC) or beside `mav0` (TUM-VI). Returns
/// std::nullopt if there is none.
std::optional<CameraParameters> FindCamera(const fs::path& folder) {
  const fs::path sensor = folder / kSensor;
  if (fs::exists(sensor)) return ReadCamera(sensor, ParseSensor);
  const fs::path root = fs::absolute(folder).lexically_normal().parent_path().parent_path();
  const fs::path chain = root / "dso" / "camchain.yaml";
  if (fs::exists(chain)) return ReadCamera(chain, ParseCameraChain);
  return std::nullopt;
}

}  // namespace

bool IsEurocSequence(const fs::path& input) { return !CameraFolder(input).empty(); }

ImageList ListEurocImages(const fs::path& input) {
  ImageList list{"euroc", {}, {}};
  const fs::path folder = CameraFolder(input);
  if (fs::exists(folder / kList)) {
    AddListedImages(folder, list);
  } else {
    AddUnlistedImages(folder, list);
  }
  list.camera = FindCamera(folder);
  return list;
}

}  // namespace corvo
