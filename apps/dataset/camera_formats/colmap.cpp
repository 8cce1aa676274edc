// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

#include "apps/dataset/camera_formats/camera_formats.h"
#include "apps/output/binary_data.h"
#include "orb/error.h"

namespace corvo {
namespace {

/// A camera model of COLMAP, with its number in cameras.bin. Its parameters are `num_focals` focal
/// lengths, cx, cy, and the distortion.
struct ColmapModel {
  int id;
  std::string_view name;
  int num_focals;
  int num_coefficients;
  std::optional<CameraModel> model;  ///< std::nullopt if corvo has no such model.
  std::array<const char*, 8> coefficients;

  std::size_t num_parameters() const { return num_focals + 2 + num_coefficients; }
};

constexpr CameraModel kRadtan = CameraModel::kPinhole;
constexpr CameraModel kFisheye = CameraModel::kKb4;
constexpr std::array<ColmapModel, 12> kColmapModels = {{
    {0, "SIMPLE_PINHOLE", 1, 0, kRadtan, {}},
    {1, "PINHOLE", 2, 0, kRadtan, {}},
    {2, "SIMPLE_RADIAL", 1, 1, kRadtan, {"k1"}},
    {3, "RADIAL", 1, 2, kRadtan, {"k1", "k2"}},
    {4, "OPENCV", 2, 4, kRadtan, {"k1", "k2", "p1", "p2"}},
    {5, "OPENCV_FISHEYE", 2, 4, kFisheye, {"k1", "k2", "k3", "k4"}},
    {6, "FULL_OPENCV", 2, 8, kRadtan, {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"}},
    {7, "FOV", 2, 1, CameraModel::kFov, {"omega"}},
    {8, "SIMPLE_RADIAL_FISHEYE", 1, 1, kFisheye, {"k1"}},
    {9, "RADIAL_FISHEYE", 1, 2, kFisheye, {"k1", "k2"}},
    {10, "THIN_PRISM_FISHEYE", 2, 8, std::nullopt, {}},
    {11, "RAD_TAN_THIN_PRISM_FISHEYE", 2, 12, std::nullopt, {}},
}};
constexpr const char* kReadable =
    "SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV, FULL_OPENCV, OPENCV_FISHEYE, "
    "SIMPLE_RADIAL_FISHEYE, RADIAL_FISHEYE and FOV";

/// Reads the parameters of a camera whose size is set. COLMAP's pixel (0.5, 0.5) is the center of
/// the first one.
void SetParameters(const ColmapModel& model, const std::vector<double>& values,
                   const std::string& where, CameraParameters& camera) {
  if (!model.model) ThrowUnknownModel(where + "MODEL", model.name, kReadable);
  if (values.size() != model.num_parameters()) {
    throw Error(fmt::format("{}{} parameters; the model {} has {}", where, values.size(),
                            model.name, model.num_parameters()));
  }
  camera.model = *model.model;
  const auto* const center = values.data() + model.num_focals;
  SetIntrinsics({values.front(), center[-1], center[0] - 0.5, center[1] - 0.5}, camera);
  const std::span<const char* const> names(model.coefficients.data(), model.num_coefficients);
  SetDistortion(names, std::vector<double>(center + 2, values.data() + values.size()),
                where + "PARAMS", model.name, camera);
}

bool IsInteger(std::string_view text) {
  return !text.empty() && text.size() < 20 && text.find_first_not_of("0123456789") == text.npos;
}

bool IsModelName(std::string_view text) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";
  return !text.empty() && text.front() >= 'A' && text.front() <= 'Z' &&
         text.find_first_not_of(kLetters) == text.npos;
}

bool IsCameraRow(const std::vector<std::string>& fields) {
  return fields.size() >= 4 && IsInteger(fields[0]) && IsModelName(fields[1]);
}

/// A camera of cameras.bin.
struct BinaryCamera {
  std::string id;
  int model_id = 0;
  std::uint64_t width = 0, height = 0;
  std::vector<double> values;
};

const ColmapModel* FindModel(int id) {
  const auto found = std::ranges::find(kColmapModels, id, &ColmapModel::id);
  return found == kColmapModels.end() ? nullptr : &*found;
}

/// Returns the cameras of cameras.bin up to the first one of a model that is not known. Empty if
/// the bytes are anything else.
std::vector<BinaryCamera> ParseBinary(const std::string& bytes) {
  constexpr std::size_t kHeaderSize = 2 * sizeof(std::int32_t) + 2 * sizeof(std::uint64_t);
  std::vector<BinaryCamera> cameras;
  const char* next = bytes.data();
  const char* const end = next + bytes.size();
  const auto is_left = [&](std::size_t size) {
    return size <= static_cast<std::size_t>(end - next);
  };
  if (!is_left(sizeof(std::uint64_t))) return {};
  const auto num_cameras = TakeBytes<std::uint64_t>(next);
  for (std::uint64_t i = 0; i < num_cameras; ++i) {
    if (!is_left(kHeaderSize)) return {};
    BinaryCamera camera;
    camera.id = fmt::format("{}", TakeBytes<std::uint32_t>(next));
    camera.model_id = TakeBytes<std::int32_t>(next);
    camera.width = TakeBytes<std::uint64_t>(next);
    camera.height = TakeBytes<std::uint64_t>(next);
    const ColmapModel* const model = FindModel(camera.model_id);
    if (!model || !is_left(model->num_parameters() * sizeof(double))) return {};
    camera.values.resize(model->num_parameters());
    for (double& value : camera.values) value = TakeBytes<double>(next);
    cameras.push_back(std::move(camera));
  }
  return next == end ? cameras : std::vector<BinaryCamera>();
}

}  // namespace

std::vector<std::string> ColmapTextCameras(const CalibrationContent& content) {
  std::vector<std::string> names;
  for (const TextLine& line : content.lines()) {
    const std::vector<std::string> fields = CalibrationFields(line);
    if (!IsCameraRow(fields)) return {};
    names.push_back(fields[0]);
  }
  return names;
}

StatedCamera ReadColmapTextCamera(const CalibrationContent& content, const std::string& name) {
  for (const TextLine& line : content.lines()) {
    const std::vector<std::string> fields = CalibrationFields(line);
    if (fields[0] != name) continue;
    StatedCamera stated{{}, {}, LinePrefix(content.file(), line)};
    const auto model = std::ranges::find(kColmapModels, fields[1], &ColmapModel::name);
    if (model == kColmapModels.end())
      ThrowUnknownModel(stated.where + "MODEL", fields[1], kReadable);
    std::vector<double> values;
    for (std::size_t i = 2; i < fields.size(); ++i) {
      values.push_back(ParseNumber(fields[i], stated.where));
    }
    SetSize(values, stated.where + "camera " + name, stated.parameters);
    values.erase(values.begin(), values.begin() + 2);
    SetParameters(*model, values, stated.where, stated.parameters);
    return stated;
  }
  throw Error(content.where() + "holds no camera " + name);
}

std::vector<std::string> ColmapBinaryCameras(const CalibrationContent& content) {
  std::vector<std::string> names;
  if (!content.is_binary()) return names;
  for (const BinaryCamera& camera : ParseBinary(content.bytes())) names.push_back(camera.id);
  return names;
}

StatedCamera ReadColmapBinaryCamera(const CalibrationContent& content, const std::string& name) {
  for (const BinaryCamera& camera : ParseBinary(content.bytes())) {
    if (camera.id != name) continue;
    StatedCamera stated{{}, {}, fmt::format("{}camera {}: ", content.where(), name)};
    SetSize({static_cast<double>(camera.width), static_cast<double>(camera.height)},
            fmt::format("{}camera {}", content.where(), name), stated.parameters);
    SetParameters(*FindModel(camera.model_id), camera.values, stated.where, stated.parameters);
    return stated;
  }
  throw Error(content.where() + "holds no camera " + name);
}

}  // namespace corvo
