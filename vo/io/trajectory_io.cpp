// SPDX-License-Identifier: MIT
#include "vo/io/trajectory_io.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>

#include "orb/error.h"
#include "vo/io/decimal_time.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxNormError = 1e-2;

/// A line of a file, split into fields, with the start of its error messages.
struct Row {
  std::vector<std::string> fields;
  std::string where;
};

std::vector<Row> ReadRows(const fs::path& file, char separator) {
  std::vector<Row> rows;
  for (const TextLine& line : ReadTextLines(file)) {
    rows.push_back({SplitFields(line.text, separator), LinePrefix(file, line)});
  }
  return rows;
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

/// Appends a pose. Throws corvo::Error if its time is not after that of the last pose.
void Append(const TimedPose& pose, const std::string& where, PoseSequence& poses) {
  if (!poses.empty() && pose.time_ns <= poses.back().time_ns) {
    throw Error(fmt::format("{}time {} s does not lie after that of the pose before, {} s", where,
                            FormatSeconds(pose.time_ns), FormatSeconds(poses.back().time_ns)));
  }
  poses.push_back(pose);
}

TimedPose ParseTum(const Row& row) {
  CheckCount(row, 8, "timestamp tx ty tz qx qy qz qw");
  const Eigen::Vector3d position = ParseNumbers<3>(row, 1);
  const Eigen::Vector4d q = ParseNumbers<4>(row, 4);
  const SO3 rotation = ParseRotation(Eigen::Quaterniond(q(3), q(0), q(1), q(2)), row.where);
  return {ParseSeconds(row.fields[0], row.where), SE3(rotation, position)};
}

SE3 ParseKitti(const Row& row) {
  CheckCount(row, 12, "the rows of [R t]");
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

constexpr const char* kTumHeader = "# timestamp tx ty tz qx qy qz qw\n";

std::string TumRows(const PoseSequence& poses) {
  std::string text;
  for (const TimedPose& pose : poses) {
    const Eigen::Vector3d& t = pose.world_from_camera.translation();
    const Eigen::Quaterniond& q = pose.world_from_camera.rotation().quaternion();
    text += fmt::format("{} {} {} {} {} {} {} {}\n", FormatSeconds(pose.time_ns), t.x(), t.y(),
                        t.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

bool IsNan(const std::string& field) { return field == "NaN" || field == "nan"; }

void WriteText(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text << std::flush;
  if (!stream) throw Error(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace

PoseSequence ReadTum(const fs::path& file) {
  PoseSequence poses;
  for (const Row& row : ReadRows(file, ' ')) Append(ParseTum(row), row.where, poses);
  return poses;
}

PoseSequence ReadTumWithGaps(const fs::path& file) {
  PoseSequence poses;
  for (const Row& row : ReadRows(file, ' ')) {
    if (std::any_of(row.fields.begin(), row.fields.end(), IsNan)) continue;
    Append(ParseTum(row), row.where, poses);
  }
  return poses;
}

void WriteTum(const fs::path& file, const PoseSequence& poses) {
  WriteText(file, kTumHeader + TumRows(poses));
}

void WriteTumParts(const fs::path& file, const std::vector<CommentedPoses>& parts) {
  std::string text = kTumHeader;
  for (const CommentedPoses& part : parts) text += "# " + part.comment + "\n" + TumRows(part.poses);
  WriteText(file, text);
}

std::vector<SE3> ReadKittiPoses(const fs::path& file) {
  std::vector<SE3> poses;
  for (const Row& row : ReadRows(file, ' ')) poses.push_back(ParseKitti(row));
  return poses;
}

void WriteKittiPoses(const fs::path& file, const std::vector<SE3>& poses) {
  std::string text;
  for (const SE3& pose : poses) {
    const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> matrix = pose.matrix().topRows<3>();
    text += fmt::format("{}\n", fmt::join(matrix.data(), matrix.data() + matrix.size(), " "));
  }
  WriteText(file, text);
}

std::vector<TimeNs> ReadKittiTimes(const fs::path& file) {
  PoseSequence stamps;
  for (const Row& row : ReadRows(file, ' ')) {
    CheckCount(row, 1, "a time");
    Append({ParseSeconds(row.fields[0], row.where), SE3()}, row.where, stamps);
  }
  std::vector<TimeNs> times_ns;
  for (const TimedPose& stamp : stamps) times_ns.push_back(stamp.time_ns);
  return times_ns;
}

PoseSequence WithTimes(const std::vector<SE3>& world_from_camera,
                       const std::vector<TimeNs>& times_ns) {
  if (world_from_camera.size() != times_ns.size()) {
    throw Error(fmt::format("{} poses, but {} times", world_from_camera.size(), times_ns.size()));
  }
  PoseSequence poses;
  for (std::size_t i = 0; i < times_ns.size(); ++i) {
    poses.push_back({times_ns[i], world_from_camera[i]});
  }
  return poses;
}

PoseSequence ReadEurocPoses(const fs::path& file) {
  PoseSequence poses;
  for (const Row& row : ReadRows(file, ',')) Append(ParseEuroc(row), row.where, poses);
  return poses;
}

void WriteEurocPoses(const fs::path& file, const PoseSequence& poses) {
  std::string text = "#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w [],q_x [],q_y [],q_z []\n";
  for (const TimedPose& pose : poses) {
    const Eigen::Vector3d& t = pose.world_from_camera.translation();
    const Eigen::Quaterniond& q = pose.world_from_camera.rotation().quaternion();
    text += fmt::format("{},{},{},{},{},{},{},{}\n", pose.time_ns, t.x(), t.y(), t.z(), q.w(),
                        q.x(), q.y(), q.z());
  }
  WriteText(file, text);
}

}  // namespace corvo
