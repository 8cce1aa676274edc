// SPDX-License-Identifier: MIT
#include "apps/dataset/pose_file.h"

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/io/text_lines.h"
#include "vo/io/trajectory_io.h"

namespace corvo {
namespace {

constexpr TimeNs kSecond = 1'000'000'000;
constexpr std::size_t kTumColumns = 8;
constexpr std::size_t kKittiColumns = 12;

TextLine FirstLine(const std::filesystem::path& file) {
  const std::vector<TextLine> lines = ReadTextLines(file);
  if (lines.empty()) throw Error(fmt::format("{}: contains no poses", file.string()));
  return lines.front();
}

bool HasCommas(const TextLine& line) { return line.text.find(',') != std::string::npos; }

}  // namespace

PoseFile::PoseFile(const std::vector<SE3>& numbered) {
  for (std::size_t i = 0; i < numbered.size(); ++i) {
    poses_.push_back({static_cast<TimeNs>(i) * kSecond, numbered[i]});
  }
}

PoseSequence PoseFile::WithTimes(const std::vector<TimeNs>& times) const {
  if (has_times_) return poses_;
  if (poses_.size() != times.size()) {
    throw Error(fmt::format("{} poses, but {} timestamps", poses_.size(), times.size()));
  }
  PoseSequence poses = poses_;
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i].time_ns = times[i];
  return poses;
}

bool IsEurocPoseFile(const std::filesystem::path& file) { return HasCommas(FirstLine(file)); }

PoseFile ReadPoseFile(const std::filesystem::path& file) {
  const TextLine line = FirstLine(file);
  if (HasCommas(line)) return PoseFile(ReadEurocPoses(file));
  const std::size_t columns = SplitFields(line.text, ' ').size();
  if (columns == kTumColumns) return PoseFile(ReadTum(file));
  if (columns == kKittiColumns) return PoseFile(ReadKittiPoses(file));
  throw Error(fmt::format("{}{} columns; TUM format has {}, KITTI format {}",
                          LinePrefix(file, line), columns, kTumColumns, kKittiColumns));
}

}  // namespace corvo
