// SPDX-License-Identifier: MIT
#include "apps/export/run_result.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/output/frame_tables.h"
#include "apps/run/result_images.h"
#include "orb/error.h"
#include "vo/io/config.h"
#include "vo/io/trajectory_io.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Returns a member of summary.json that is a text or null; an empty path for null.
fs::path PathOf(const nlohmann::json& summary, const char* name, const fs::path& file) {
  const auto member = summary.find(name);
  if (member == summary.end() || !(member->is_string() || member->is_null())) {
    throw Error(
        fmt::format("{}: has no \"{}\"; run corvo again: this result is of a version that "
                    "did not write what an export needs",
                    file.string(), name));
  }
  return member->is_null() ? fs::path() : fs::path(member->get<std::string>());
}

/// Returns an integer member of summary.json's gray_levels.
int LevelOf(const nlohmann::json& levels, const char* name, const std::string& where) {
  const auto member = levels.find(name);
  if (member == levels.end() || !member->is_number_integer()) {
    throw Error(fmt::format("{} has no integer \"{}\"", where, name));
  }
  const auto level = member->get<std::int64_t>();
  CheckRange(where + "." + name, level, std::int64_t{0}, std::int64_t{65535});
  return static_cast<int>(level);
}

/// Returns how the run converted 16-bit images; older results do not say so.
GrayLevels ReadGrayLevels(const nlohmann::json& summary, const fs::path& file) {
  const auto levels = summary.find("gray_levels");
  if (levels == summary.end()) return GrayLevels();
  const std::string where = file.string() + ": gray_levels";
  if (!levels->contains("bits")) {
    return {LevelOf(*levels, "low", where), LevelOf(*levels, "high", where)};
  }
  const int bits = LevelOf(*levels, "bits", where);
  CheckRange(where + ".bits", bits, 8, 16);
  return GrayLevels(bits);
}

/// Joins the rows of frames.csv with the poses, which are in the same order.
std::vector<ResultFrame> ReadFrames(const fs::path& folder) {
  const PoseSequence poses = ReadTum(folder / "trajectory.tum");
  std::vector<ResultFrame> frames;
  auto pose = poses.begin();
  for (const FrameRow& row : ReadFrameTable(folder / "frames.csv")) {
    ResultFrame frame{row.index, row.image, row.is_keyframe, row.segment, std::nullopt};
    if (pose != poses.end() && pose->time_ns == row.time_ns) {
      frame.world_from_camera = (pose++)->world_from_camera;
    }
    frames.push_back(frame);
  }
  if (pose != poses.end()) {
    throw Error(fmt::format("{}: its poses are not those of frames.csv",
                            (folder / "trajectory.tum").string()));
  }
  return frames;
}

std::string ImageName(const RunResult& result, const ResultFrame& frame) {
  return result.video.empty() ? frame.image : fmt::format("frame_{:06d}.jpg", frame.index);
}

/// Adds the observations of exported points in exported frames.
void AddObservations(const RunResult& result, Reconstruction& reconstruction) {
  std::unordered_map<LandmarkId, int> points;
  for (const ReconstructedPoint& point : reconstruction.points) {
    points.try_emplace(point.id, static_cast<int>(points.size()));
  }
  std::unordered_map<int, ReconstructedImage*> images;
  for (ReconstructedImage& image : reconstruction.images) images[image.frame] = &image;
  for (const ObservationRow& row : result.observations) {
    const auto point = points.find(row.landmark);
    const auto image = images.find(row.frame);
    if (point == points.end() || image == images.end()) continue;
    image->second->observations.push_back({point->second, {row.x, row.y}, row.sigma_px});
  }
}

}  // namespace

RunResult ReadRunResult(const fs::path& folder) {
  const fs::path file = folder / "summary.json";
  const nlohmann::json summary = ReadSummary(folder);
  RunResult result;
  result.image_folder = PathOf(summary, "image_folder", file);
  result.video = PathOf(summary, "video", file);
  result.stored = InputArguments(folder, summary).stored;
  result.gray_levels = ReadGrayLevels(summary, file);
  result.camera = ReadCameraFile(folder / "camera_estimated.yaml").camera.parameters();
  result.frames = ReadFrames(folder);
  result.points = ReadMapPly(folder / "map.ply");
  result.observations = ReadObservations(folder / "observations.npy");
  return result;
}

std::vector<int> SegmentsBySize(const RunResult& result) {
  std::map<int, int> sizes;
  for (const ResultFrame& frame : result.frames) {
    if (frame.world_from_camera) ++sizes[frame.segment];
  }
  std::vector<int> segments;
  for (const auto& [segment, size] : sizes) segments.push_back(segment);
  std::ranges::stable_sort(segments, [&](int a, int b) { return sizes[a] > sizes[b]; });
  return segments;
}

Reconstruction MakeReconstruction(const RunResult& result, int segment, ExportedFrames frames) {
  Reconstruction reconstruction;
  reconstruction.camera = result.camera;
  for (const ResultFrame& frame : result.frames) {
    const bool is_chosen = frames == ExportedFrames::kAll || frame.is_keyframe;
    if (!is_chosen || frame.segment != segment || !frame.world_from_camera) continue;
    reconstruction.images.push_back(
        {frame.index, ImageName(result, frame), *frame.world_from_camera, {}});
  }
  for (const MapPoint& point : result.points) {
    if (point.segment != segment) continue;
    reconstruction.points.push_back({point.id, point.in_world, point.rgb});
  }
  AddObservations(result, reconstruction);
  return reconstruction;
}

}  // namespace corvo
