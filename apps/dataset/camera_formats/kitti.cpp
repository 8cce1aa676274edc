// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "apps/dataset/camera_formats/camera_formats.h"
#include "orb/error.h"

namespace corvo {
namespace {

constexpr std::string_view kRectified = "P_rect_";
constexpr std::string_view kRaw = "K_";

bool IsNumbered(std::string_view text, std::string_view prefix) {
  return text.size() > prefix.size() && text.starts_with(prefix) &&
         text.find_first_not_of("0123456789", prefix.size()) == text.npos;
}

/// Returns the name of a row, which is before a colon.
std::string RowName(const TextLine& line) {
  const std::size_t colon = line.text.find(':');
  return colon == std::string::npos ? "" : line.text.substr(0, colon);
}

/// Returns the numbers of a row, of which it must have `count`.
std::vector<double> RowNumbers(const CalibrationContent& content, const TextLine& line,
                               std::size_t count) {
  const std::string where = LinePrefix(content.file(), line);
  const std::vector<std::string> fields = CalibrationFields(line);
  if (fields.size() != count + 1) {
    throw Error(fmt::format("{}{} values after {}; needed are {}", where,
                            fields.empty() ? 0 : fields.size() - 1, RowName(line) + ":", count));
  }
  std::vector<double> numbers;
  for (std::size_t i = 1; i < fields.size(); ++i) numbers.push_back(ParseNumber(fields[i], where));
  return numbers;
}

/// Returns the row of a name. Throws corvo::Error if there is none.
const TextLine& FindRow(const CalibrationContent& content, const std::string& name) {
  for (const TextLine& line : content.lines()) {
    if (RowName(line) == name) return line;
  }
  throw Error(fmt::format("{}has no row {}:", content.where(), name));
}

}  // namespace

std::vector<std::string> KittiCameras(const CalibrationContent& content) {
  std::vector<std::string> rectified;
  std::vector<std::string> raw;
  for (const TextLine& line : content.lines()) {
    const std::string name = RowName(line);
    if (IsNumbered(name, "P") || IsNumbered(name, kRectified)) rectified.push_back(name);
    if (IsNumbered(name, kRaw)) raw.push_back(name);
  }
  rectified.insert(rectified.end(), raw.begin(), raw.end());
  return rectified;
}

StatedCamera ReadKittiCamera(const CalibrationContent& content, const std::string& name) {
  const TextLine& row = FindRow(content, name);
  StatedCamera stated{{}, {}, LinePrefix(content.file(), row)};
  const bool is_raw = IsNumbered(name, kRaw);
  SetCameraMatrix(RowNumbers(content, row, is_raw ? 9 : 12), stated.where + name,
                  stated.parameters);
  if (is_raw || IsNumbered(name, kRectified)) {
    const std::string number = name.substr(name.rfind('_') + 1);
    const TextLine size = FindRow(content, (is_raw ? "S_" : "S_rect_") + number);
    SetSize(RowNumbers(content, size, 2), LinePrefix(content.file(), size) + RowName(size),
            stated.parameters);
    if (is_raw) {
      const TextLine distortion = FindRow(content, "D_" + number);
      SetDistortion(kOpenCvCoefficients, RowNumbers(content, distortion, 5),
                    LinePrefix(content.file(), distortion) + RowName(distortion), "plumb_bob",
                    stated.parameters);
    }
  }
  return stated;
}

}  // namespace corvo
