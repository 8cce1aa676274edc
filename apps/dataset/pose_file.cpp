// SPDX-License-Identifier: MIT
#include "apps/dataset/pose_file.h"

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/io/decimal_time.h"
#include "vo/io/pose_rows.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

constexpr TimeNs kSecond = 1'000'000'000;
constexpr std::size_t kTumColumns = 8;
constexpr std::size_t kKittiColumns = 12;
constexpr std::size_t kMatrixColumns = 16;  // KITTI's, with the row 0 0 0 1.

/// Returns whether a pose is in EuRoC's format. One with a time in seconds is in TUM's, with
/// commas.
bool IsEuroc(const TextLine& line) {
  const bool has_commas = line.text.find(',') != std::string::npos;
  const std::string time = SplitFields(line.text)[0];
  return has_commas && GuessEurocTimeUnit(time) == TimeUnit::kNanoseconds;
}

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

PoseFile ReadPoseFile(const std::filesystem::path& file) {
  const std::vector<TextLine> lines = ReadTableLines(file);
  if (lines.empty()) throw Error(fmt::format("{}: contains no poses", file.string()));
  if (IsEuroc(lines[0])) return PoseFile(ParseEurocRows(lines, file), true);
  const std::size_t columns = SplitFields(lines[0].text).size();
  if (columns == kTumColumns) return PoseFile(ParseTumRows(lines, file));
  if (columns == kKittiColumns || columns == kMatrixColumns) {
    return PoseFile(ParseKittiRows(lines, file));
  }
  throw Error(fmt::format("{}{} columns; TUM format has {}, KITTI format {} or {}",
                          LinePrefix(file, lines[0]), columns, kTumColumns, kKittiColumns,
                          kMatrixColumns));
}

}  // namespace corvo
