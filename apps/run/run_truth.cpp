// SPDX-License-Identifier: MIT
#include "apps/run/run_truth.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/dataset/ground_truth.h"
#include "orb/error.h"
#include "vo/evaluation/evaluation.h"
#include "vo/io/decimal_time.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNoTruth = "none";

/// Throws corvo::Error if no image has a ground truth pose near its time, in which case the file
/// belongs to another sequence.
void CheckOverlap(const PoseSequence& truth, const std::vector<TimeNs>& frame_times,
                  const fs::path& file) {
  PoseSequence frames;
  for (const TimeNs time_ns : frame_times) frames.push_back({time_ns, SE3()});
  const TimeNs max_dt_ns = HalfFrame(frames);
  if (!Associate(frames, truth, max_dt_ns).empty()) return;
  throw Error(fmt::format("{}: no pose within {} s of any image; the images span {} to {} s",
                          file.string(), ToSeconds(max_dt_ns), FormatSeconds(frame_times.front()),
                          FormatSeconds(frame_times.back())));
}

RunTruth ReadChecked(const fs::path& file, const std::vector<TimeNs>& frame_times) {
  RunTruth truth{file, ReadGroundTruth(file, frame_times)};
  CheckOverlap(truth.poses, frame_times, file);
  return truth;
}

}  // namespace

RunTruth ReadRunTruth(const fs::path& named, const fs::path& input,
                      const std::vector<TimeNs>& frame_times) {
  if (named == kNoTruth) return {};
  if (!named.empty()) return ReadChecked(named, frame_times);
  const fs::path found = FindGroundTruth(input);
  if (found.empty()) return {};
  try {
    return ReadChecked(found, frame_times);
  } catch (const Error& error) {
    spdlog::warn("ground truth ignored: {}", error.what());
    return {};
  }
}

}  // namespace corvo
