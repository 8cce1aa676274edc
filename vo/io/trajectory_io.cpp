// SPDX-License-Identifier: MIT
#include "vo/io/trajectory_io.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <fstream>
#include <string>

#include "orb/error.h"
#include "vo/io/decimal_time.h"
#include "vo/io/pose_rows.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

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

void CheckPoses(const fs::path& file, const PoseSequence& poses) {
  for (const TimedPose& pose : poses) {
    CheckPose(fmt::format("{}: at {} s", file.string(), FormatSeconds(pose.time_ns)),
              pose.world_from_camera);
  }
}

void WriteText(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text << std::flush;
  if (!stream) throw Error(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace

PoseSequence ReadTum(const fs::path& file) { return ParseTumRows(ReadTableLines(file), file); }

PoseSequence ReadTumWithGaps(const fs::path& file) {
  return ParseTumRows(ReadTableLines(file), file, true);
}

void WriteTum(const fs::path& file, const PoseSequence& poses) {
  CheckPoses(file, poses);
  WriteText(file, kTumHeader + TumRows(poses));
}

void WriteTumParts(const fs::path& file, const std::vector<CommentedPoses>& parts) {
  std::string text = kTumHeader;
  for (const CommentedPoses& part : parts) {
    CheckPoses(file, part.poses);
    text += "# " + part.comment + "\n" + TumRows(part.poses);
  }
  WriteText(file, text);
}

std::vector<SE3> ReadKittiPoses(const fs::path& file) {
  return ParseKittiRows(ReadTableLines(file), file);
}

void WriteKittiPoses(const fs::path& file, const std::vector<SE3>& poses) {
  std::string text;
  for (const SE3& pose : poses) {
    CheckPose(file.string(), pose);
    const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> matrix = pose.matrix().topRows<3>();
    text += fmt::format("{}\n", fmt::join(matrix.data(), matrix.data() + matrix.size(), " "));
  }
  WriteText(file, text);
}

std::vector<TimeNs> ReadKittiTimes(const fs::path& file) {
  const std::vector<TextLine> lines = ReadTableLines(file);
  std::vector<TimeNs> times_ns;
  for (const TextLine& line : lines) {
    const std::string where = LinePrefix(file, line);
    const std::vector<std::string> fields = SplitFields(line.text);
    if (fields.size() != 1) {
      throw Error(fmt::format("{}{} fields; needed are 1 (a time)", where, fields.size()));
    }
    const TimeNs time_ns = ParseTime(fields[0], GuessTimeUnit(lines.front().text), where);
    CheckAscends(time_ns, times_ns.empty() ? nullptr : &times_ns.back(), where);
    times_ns.push_back(time_ns);
  }
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
  return ParseEurocRows(ReadTableLines(file), file);
}

void WriteEurocPoses(const fs::path& file, const PoseSequence& poses) {
  CheckPoses(file, poses);
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
