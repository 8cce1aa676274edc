// SPDX-License-Identifier: MIT
#include "apps/commands/calibrate.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/commands/former_option.h"
#include "apps/output/candidate_report.h"
#include "apps/output/output_folder.h"
#include "apps/output/residual_plot.h"
#include "apps/run/camera_start.h"
#include "apps/run/interruption.h"
#include "apps/run/run_inputs.h"
#include "apps/run/sequence_stream.h"
#include "orb/error.h"
#include "vo/io/config.h"
#include "vo/offline/self_calibration.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr int kNotCalibrated = 2;

constexpr const char* kFooter =
    R"(All inputs are of one camera with one setting of its zoom and focus. The focal length starts from a
sweep over fields of view; then the odometry runs over each input, all of them are adjusted together,
and both again while the focal length changes by more than 1%. Of the models, the simplest is taken
that the Bayesian information criterion does not clearly reject. The camera file has the standard
deviations; beside it an image shows what is left over.

Examples:
  corvo calibrate drive.mp4 -o camera.yaml
  corvo calibrate drive.mp4 images/ -o camera.yaml --every 2
  corvo calibrate drive.mp4 --model radtan -o camera.yaml

Exit codes: 0 done, 1 wrong usage or input, 2 no input could be tracked or adjusted, 130 interrupted.)";

struct CalibrateArguments {
  std::vector<fs::path> inputs;
  fs::path output;
  std::string model;  ///< Empty: the one that fits.
  std::optional<double> frame_rate_hz;
  Selection selection;
  int threads = 1;
};

/// Opens each input, every image of the size of its first.
std::vector<StreamOpener> OpenersOf(const CalibrateArguments& arguments) {
  constexpr double kDefaultFrameRateHz = 30;
  std::vector<StreamOpener> openers;
  for (const fs::path& input : arguments.inputs) {
    if (IsLiveInput(input.string())) {
      throw Error(fmt::format("{}: is a live camera, whose images come but once; give a recording",
                              input.string()));
    }
    openers.push_back(ToStreamOpener([input, &arguments] {
      ImageSource source = OpenImages(input.string(), arguments.frame_rate_hz, kDefaultFrameRateHz,
                                      arguments.selection);
      const cv::Size size = source.First().image.size();
      source.Prepare({size, size, MaskSource()});
      return source;
    }));
  }
  return openers;
}

/// The models that are tried.
std::vector<CalibrationModel> ModelsOf(const std::string& name) {
  std::vector<CalibrationModel> models;
  for (const CalibrationModel model : AllCalibrationModels()) {
    if (name.empty() || ToString(model) == name) models.push_back(model);
  }
  return models;
}

CameraCalibration CalibrateInputs(const CalibrateArguments& arguments) {
  const Interruption interruption;
  const std::vector<StreamOpener> openers = OpenersOf(arguments);
  SelfCalibrationOptions options;
  options.threads = arguments.threads;
  const CalibrationProgress progress =
      ShowCalibration(static_cast<int>(openers.size()), interruption);
  CameraCalibration calibration =
      CalibrateCamera(openers, ModelsOf(arguments.model), options, progress);
  if (calibration.is_canceled) throw Interrupted();
  return calibration;
}

void WriteCalibration(const CameraCandidate& candidate, const fs::path& file) {
  const Camera camera(candidate.adjustment.camera);
  const std::string name = file.filename().string();
  const std::string image = file.stem().string() + "_residuals.png";
  OutputFolder output(fs::absolute(file).parent_path());
  output.Write(name, WriteCameraFile(
                         {camera, {}, "estimated by corvo calibrate", EstimatedSigmas(candidate)}));
  if (!DrawResiduals(camera, candidate.bundles, output.Stage(image))) {
    spdlog::warn("no {}: gnuplot is missing or failed (Debian: gnuplot-nox)", image);
  }
  output.Commit({image, name});
}

int Calibrate(const CalibrateArguments& arguments) {
  CheckOutputFile(arguments.output, "the camera");
  const CameraCalibration calibration = CalibrateInputs(arguments);
  ReportFocalSearch(calibration.start);
  if (calibration.selected == kNoId) {
    spdlog::error("no input could be {}: nothing is written",
                  calibration.candidates.empty() ? "tracked" : "adjusted");
    return kNotCalibrated;
  }
  const CameraCandidate& candidate = calibration.candidates[calibration.selected];
  fmt::print("{}\n{}", CandidatesText(calibration.candidates, calibration.selected),
             EstimateText(candidate));
  for (const std::string& warning : UndeterminedWarnings(candidate)) spdlog::warn("{}", warning);
  WriteCalibration(candidate, arguments.output);
  return 0;
}

int CalibrateUnlessInterrupted(const CalibrateArguments& arguments) {
  try {
    return Calibrate(arguments);
  } catch (const Interrupted&) {
    spdlog::error("interrupted: nothing is written");
    return kInterrupted;
  }
}

}  // namespace

void AddCalibrateCommand(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("calibrate", "Find a camera from its videos, without a board");
  const auto arguments = std::make_shared<CalibrateArguments>();
  command
      ->add_option("INPUT", arguments->inputs,
                   "folders or quoted patterns of images, sequences as of 'corvo run', videos; a "
                   "dataset's own calibration is not looked at")
      ->required();
  command->add_option("-o,--output", arguments->output, "camera file to write")->required();
  command
      ->add_option("--model", arguments->model,
                   "pinhole, radtan, kb4 or fov (default: the simplest that fits)")
      ->check(CLI::IsMember({"pinhole", "radtan", "kb4", "fov"}));
  AddFormerOption(*command, "--focal", "is not needed: the focal length is always searched");
  command->add_option("--fps", arguments->frame_rate_hz, "frames a second of images without times")
      ->check(CLI::Range(1e-3, 1e6));
  AddSelectionOptions(*command, arguments->selection);
  command->add_option("--threads", arguments->threads, "threads; never changes the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->footer(kFooter);
  command->callback(
      [arguments, &exit_code] { exit_code = CalibrateUnlessInterrupted(*arguments); });
}

}  // namespace corvo
