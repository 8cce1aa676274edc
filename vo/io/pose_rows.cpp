// SPDX-License-Identifier: MIT
#include "vo/io/pose_rows.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "orb/error.h"
#include "vo/io/decimal_time.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxNormError = 1e-2;

/// A line of a file, split into fields, with the start of its error messages.
struct Row {
  std::vector<std::string> fields;
  std::string where;
};

Row SplitRow(const TextLine& line, const fs::path& file) {
  return {SplitFields(line.text), LinePrefix(file, line)};
}

void CheckCount(const Row& row, std::size_t count, std::string_view what) {
  if (row.fields.size() == count) return;
  throw Error(
      fmt::format("{}{} fields; needed are {} ({})", row.where, row.fields.size(), count, what));
}

/// Returns field `first` and the following ones as numbers.
template <int Count>
Eigen::Matrix<double, Count, 1> ParseNumbers(const Row& row, int first) {
  Eigen::Matrix<double, Count, 1> numbers;
  for (int i = 0; i < Count; ++i) numbers(i) = ParseNumber(row.fields[first + i], row.where);
  return numbers;
}

SO3 ParseRotation(const Eigen::Quaterniond& quaternion, const std::string& where) {
  const double norm = quaternion.norm();
  if (std::abs(norm - 1) <= kMaxNormError) return SO3(quaternion);
  throw Error(fmt::format("{}the quaternion's norm is {}; allowed is {} to {}", where, norm,
                          1 - kMaxNormError, 1 + kMaxNormError));
}

/// Appends a pose. Throws corvo::Error if it is out of range or its time is not after that of the
/// last pose.
void Append(const TimedPose& pose, const std::string& where, PoseSequence& poses) {
  CheckPose(where + "the pose", pose.world_from_camera);
  CheckAscends(pose.time_ns, poses.empty() ? nullptr : &poses.back().time_ns, where);
  poses.push_back(pose);
}

TimedPose ParseTum(const Row& row, TimeUnit unit) {
  CheckCount(row, 8, "timestamp tx ty tz qx qy qz qw");
  const Eigen::Vector3d position = ParseNumbers<3>(row, 1);
  const Eigen::Vector4d q = ParseNumbers<4>(row, 4);
  const SO3 rotation = ParseRotation(Eigen::Quaterniond(q(3), q(0), q(1), q(2)), row.where);
  return {ParseTime(row.fields[0], unit, row.where), SE3(rotation, position)};
}

/// Throws corvo::Error unless the last four of 16 fields are 0 0 0 1.
void CheckLastRow(const Row& row) {
  if (ParseNumbers<4>(row, 12) == Eigen::Vector4d(0, 0, 0, 1)) return;
  throw Error(row.where + "the last row of a 4x4 matrix must be 0 0 0 1");
}

SE3 ParseKitti(const Row& row) {
  if (row.fields.size() == 16) {
    CheckLastRow(row);
  } else {
    CheckCount(row, 12, "the rows of [R t]");
  }
  const Eigen::Matrix<double, 12, 1> numbers = ParseNumbers<12>(row, 0);
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> matrix(numbers.data());
  try {
    return SE3(SO3(Eigen::Matrix3d(matrix.leftCols<3>())), matrix.col(3));
  } catch (const Error& error) {
    throw Error(row.where + error.what());
  }
}

TimedPose ParseEuroc(const Row& row) {
  if (row.fields.size() < 8) CheckCount(row, 8, "time, px, py, pz, qw, qx, qy, qz");
  const Eigen::Vector3d position = ParseNumbers<3>(row, 1);
  const Eigen::Vector4d q = ParseNumbers<4>(row, 4);
  const SO3 rotation = ParseRotation(Eigen::Quaterniond(q(0), q(1), q(2), q(3)), row.where);
  return {ParseNanoseconds(row.fields[0], row.where), SE3(rotation, position)};
}

bool IsNan(const std::string& field) { return field == "NaN" || field == "nan"; }

}  // namespace

PoseSequence ParseTumRows(const std::vector<TextLine>& lines, const fs::path& file,
                          bool with_gaps) {
  PoseSequence poses;
  TimeUnit unit = TimeUnit::kSeconds;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Row row = SplitRow(lines[i], file);
    if (i == 0) unit = GuessTimeUnit(row.fields[0]);
    if (with_gaps && std::any_of(row.fields.begin(), row.fields.end(), IsNan)) continue;
    Append(ParseTum(row, unit), row.where, poses);
  }
  return poses;
}

std::vector<SE3> ParseKittiRows(const std::vector<TextLine>& lines, const fs::path& file) {
  std::vector<SE3> poses;
  for (const TextLine& line : lines) {
    const Row row = SplitRow(line, file);
    poses.push_back(ParseKitti(row));
    CheckPose(row.where + "the pose", poses.back());
  }
  return poses;
}

PoseSequence ParseEurocRows(const std::vector<TextLine>& lines, const fs::path& file) {
  PoseSequence poses;
  for (const TextLine& line : lines) {
    const Row row = SplitRow(line, file);
    Append(ParseEuroc(row), row.where, poses);
  }
  return poses;
}

}  // namespace corvo
