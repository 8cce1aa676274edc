// SPDX-License-Identifier: MIT
#include "apps/commands/export.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/commands/force_flag.h"
#include "apps/export/colmap_model.h"
#include "apps/export/export_folder.h"
#include "apps/export/exported_images.h"
#include "apps/export/nerfstudio_transforms.h"
#include "apps/export/point_cloud.h"
#include "apps/export/point_colors.h"
#include "apps/export/point_fit.h"
#include "apps/export/point_selection.h"
#include "apps/export/run_result.h"
#include "apps/output/json_text.h"
#include "apps/output/printable.h"
#include "apps/run/number_option.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExportFooter = R"(Examples:
  corvo export result --to colmap --images -o model       # model/sparse/0, model/images
  corvo export result --to nerfstudio --images -o scene   # scene/transforms.json, scene/images
  corvo export result --to colmap --undistort --images --frames all -o model

COLMAP: one model for each segment, the largest in sparse/0. nerfstudio: the largest segment, with its
points in sparse_pc.ply. The length unit is that of the trajectory.)";

struct ExportArguments {
  fs::path result;
  fs::path output;
  std::string format;
  std::string frames = "keyframes";
  bool writes_images = false;
  bool undistorts = false;
  bool is_text = false;
  bool force = false;
  PointSelectionOptions points;
};

/// A segment's reconstruction and the images that belong to it.
struct Exported {
  Reconstruction reconstruction;
  std::optional<Undistortion> undistortion;
};

Exported ExportSegment(const ExportArguments& arguments, const RunResult& result, int segment) {
  const auto frames = arguments.frames == "all" ? ExportedFrames::kAll : ExportedFrames::kKeyframes;
  Exported exported{MakeReconstruction(result, segment, frames), std::nullopt};
  SelectPoints(arguments.points, exported.reconstruction);
  // The points of a video were given their colors during the run.
  if (!result.image_folder.empty()) {
    ColorPoints(result.image_folder, result.gray_levels, exported.reconstruction);
  }
  if (arguments.undistorts) {
    exported.undistortion.emplace(Camera(result.camera));
    exported.undistortion->Apply(exported.reconstruction);
  }
  return exported;
}

void WriteColmap(const ExportArguments& arguments, const Reconstruction& reconstruction,
                 const fs::path& name, const ExportFolder& folder) {
  const std::string extension = arguments.is_text ? ".txt" : ".bin";
  const ColmapModel model =
      arguments.is_text ? ToColmapText(reconstruction) : ToColmapBinary(reconstruction);
  folder.Write(name / ("cameras" + extension), model.cameras);
  folder.Write(name / ("images" + extension), model.images);
  folder.Write(name / ("points3D" + extension), model.points);
}

void WriteNerfstudio(const Reconstruction& reconstruction, const ExportFolder& folder) {
  constexpr const char* kCloud = "sparse_pc.ply";
  folder.Write("transforms.json", JsonText(ToTransforms(reconstruction, "images", kCloud)));
  folder.Write(kCloud, ToPointCloud(reconstruction.points, TransformsFromWorld(reconstruction)));
}

std::size_t CountObservations(const Reconstruction& reconstruction) {
  std::size_t count = 0;
  for (const ReconstructedImage& image : reconstruction.images) count += image.observations.size();
  return count;
}

/// Returns the exported segments, the largest first. Throws corvo::Error if there are none.
std::vector<int> SelectSegments(const ExportArguments& arguments, const RunResult& result) {
  const std::vector<int> segments = SegmentsBySize(result);
  if (segments.empty()) {
    throw Error(fmt::format("{}: no frame has a pose", arguments.result.string()));
  }
  if (arguments.format == "nerfstudio") return {segments.front()};
  return segments;
}

/// Writes a segment, the n-th of the export from 0, and returns a line that describes it.
std::string WriteSegment(const ExportArguments& arguments, const RunResult& result, int segment,
                         int n, const ExportFolder& folder) {
  auto [reconstruction, undistortion] = ExportSegment(arguments, result, segment);
  if (arguments.format == "colmap") {
    FitPointsToPixels(reconstruction);
    WriteColmap(arguments, reconstruction, fs::path("sparse") / std::to_string(n), folder);
  } else {
    WriteNerfstudio(reconstruction, folder);
  }
  if (arguments.writes_images) {
    ExportImages(result, reconstruction, undistortion, folder.staging() / "images");
  }
  return fmt::format("segment {}: {} images, {} points, {} observations\n", segment,
                     reconstruction.images.size(), reconstruction.points.size(),
                     CountObservations(reconstruction));
}

void Export(const ExportArguments& arguments) {
  const RunResult result = ReadRunResult(arguments.result);
  const std::vector<int> segments = SelectSegments(arguments, result);
  ExportFolder folder(arguments.output, arguments.force);
  std::string text;
  int num_written = 0;
  for (const int segment : segments) {
    text += WriteSegment(arguments, result, segment, num_written++, folder);
  }
  folder.Commit(JsonText({{"result", fs::absolute(arguments.result).string()},
                          {"format", arguments.format},
                          {"undistorted", arguments.undistorts}}));
  if (!spdlog::should_log(spdlog::level::info)) return;
  fmt::print("{}{}\n", text, Printable(arguments.output.string()));
}

}  // namespace

void AddExportCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("export", "Write the result of a run for other programs");
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("RESULT", arguments->result, "output folder of 'corvo run'")->required();
  command->add_option("--to", arguments->format, "format: colmap or nerfstudio")
      ->required()
      ->check(CLI::IsMember({"colmap", "nerfstudio"}));
  command->add_option("-o,--output", arguments->output, "folder for the export")->required();
  command->add_option("--frames", arguments->frames, "which frames: keyframes or all")
      ->check(CLI::IsMember({"keyframes", "all"}))
      ->capture_default_str();
  command->add_flag("--images", arguments->writes_images, "write the images, too");
  command->add_flag("--undistort", arguments->undistorts,
                    "remove the distortion of the images and observations");
  command->add_flag("--text", arguments->is_text, "COLMAP's text format instead of the binary one");
  command
      ->add_option("--min-images", arguments->points.min_keyframes,
                   "least number of exported images that observe a point")
      ->check(CLI::Range(2, 1000000))
      ->capture_default_str();
  command
      ->add_option("--max-depth-sigma", arguments->points.max_relative_depth_sigma,
                   "largest standard deviation of a point's depth, as a share of the depth")
      ->check(NumberRange(1e-6, 1e6))
      ->capture_default_str();
  AddForceFlag(*command, arguments->force);
  command->footer(kExportFooter);
  command->callback([arguments] { Export(*arguments); });
}

}  // namespace corvo
