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

#include "apps/commands/force_flag.h"
#include "apps/commands/former_option.h"
#include "apps/output/candidate_report.h"
#include "apps/output/output_folder.h"
#include "apps/output/residual_plot.h"
#include "apps/run/camera_start.h"
#include "apps/run/run_inputs.h"
#include "apps/run/sequence_stream.h"
#include "apps/system/interruption.h"
#include "orb/error.h"
#include "vo/io/config.h"
#include "vo/offline/self_calibration.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr int kNotCalibrated = 2;

constexpr const char* kCalibrateFooter =
    R"(All inputs must come from one camera with one zoom and focus setting. The focal length is initialized
by a sweep over fields of view. Then the odometry runs over each input and all inputs are adjusted
jointly; both steps repeat while the focal length changes by more than 1%. The command selects the
simplest camera model that the Bayesian information criterion does not clearly reject. The camera
file includes the standard deviations; an image beside it shows the mean residuals.

Examples:
  corvo calibrate drive.mp4 -o camera.yaml
  corvo calibrate drive.mp4 images/ -o camera.yaml --every 2
  corvo calibrate drive.mp4 --model radtan -o camera.yaml

Exit codes: 0 done, 1 invalid usage or input, 2 no input could be tracked or adjusted, 130 interrupted.)";

struct CalibrateArguments {
  std::vector<fs::path> inputs;
  fs::path output;
  std::string model;  ///< If empty, the simplest model that fits is selected.
  InputOptions stored;
  Selection selection;
  int threads = 1;
  bool force = false;
};

/// Returns an opener for each input. All images of an input must have the size of its first image.
std::vector<StreamOpener> OpenersOf(const CalibrateArguments& arguments) {
  std::vector<StreamOpener> openers;
  for (const fs::path& input : arguments.inputs) {
    if (IsLiveInput(input.string())) {
      throw Error(fmt::format("{}: is a live camera, which cannot be read twice; give a recording",
                              input.string()));
    }
    openers.push_back(ToStreamOpener([input, &arguments] {
      InputOptions stored = arguments.stored;
      stored.reads_camera = false;
      ImageSource source = OpenImages(input.string(), stored, arguments.selection);
      const cv::Size size = source.First().image.size();
      source.Prepare({size, size, MaskSource()});
      return source;
    }));
  }
  return openers;
}

/// Returns the model of that name, or all models if `name` is empty.
std::vector<CalibrationModel> ModelsOf(const std::string& name) {
  std::vector<CalibrationModel> models;
  for (const CalibrationModel model : AllCalibrationModels()) {
    if (name.empty() || ToString(model) == name) models.push_back(model);
  }
  return models;
}

CameraCalibration CalibrateInputs(const CalibrateArguments& arguments,
                                  const Interruption& interruption) {
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

std::string ResidualImage(const fs::path& file) { return file.stem().string() + "_residuals.png"; }

void WriteCalibration(const CameraCandidate& candidate, const fs::path& file,
                      OutputFolder& output) {
  const Camera camera(candidate.adjustment.camera);
  const std::string name = file.filename().string();
  const std::string image = ResidualImage(file);
  output.Write(name, WriteCameraFile(
                         {camera, {}, "estimated by corvo calibrate", EstimatedSigmas(candidate)}));
  if (!DrawResiduals(camera, candidate.bundles, output.Stage(image))) {
    spdlog::warn("{} was not written: gnuplot is missing or failed (Debian: gnuplot-nox)", image);
  }
  output.Commit();
}

int Calibrate(const CalibrateArguments& arguments, const Interruption& interruption) {
  OutputFolder output(
      fs::absolute(arguments.output).parent_path(),
      PlanOfFile(arguments.output, {ResidualImage(arguments.output)}, arguments.force));
  const CameraCalibration calibration = CalibrateInputs(arguments, interruption);
  ReportFocalSearch(calibration.start);
  if (calibration.selected == kNoId) {
    spdlog::error("no input could be {}; nothing was written",
                  calibration.candidates.empty() ? "tracked" : "adjusted");
    return kNotCalibrated;
  }
  const CameraCandidate& candidate = calibration.candidates[calibration.selected];
  if (spdlog::should_log(spdlog::level::info)) {
    fmt::print("{}\n{}", CandidatesText(calibration.candidates, calibration.selected),
               EstimateText(candidate));
  }
  for (const std::string& warning : UndeterminedWarnings(candidate)) spdlog::warn("{}", warning);
  WriteCalibration(candidate, arguments.output, output);
  return 0;
}

int CalibrateUnlessInterrupted(const CalibrateArguments& arguments) {
  const Interruption interruption;
  try {
    return Calibrate(arguments, interruption);
  } catch (const Interrupted&) {
    spdlog::error("interrupted; nothing was written");
    return ExitCodeOf(interruption.PendingSignal());
  }
}

}  // namespace

void AddCalibrateCommand(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("calibrate", "Calibrate a camera from its videos, without a board");
  const auto arguments = std::make_shared<CalibrateArguments>();
  command
      ->add_option(
          "INPUT", arguments->inputs,
          "image folders, quoted file patterns, sequences as for 'corvo run', or videos; the "
          "calibration of a dataset is ignored")
      ->required();
  command->add_option("-o,--output", arguments->output, "camera file to write")->required();
  command
      ->add_option("--model", arguments->model,
                   "pinhole, radtan, kb4 or fov (default: the simplest that fits)")
      ->check(CLI::IsMember({"pinhole", "radtan", "kb4", "fov"}));
  AddFormerOption(*command, "--focal", "is not needed: the focal length is always estimated");
  AddStoredImageOptions(*command, arguments->stored);
  AddSelectionOptions(*command, arguments->selection);
  command
      ->add_option("--threads", arguments->threads, "number of threads; does not affect the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  AddForceFlag(*command, arguments->force);
  command->footer(kCalibrateFooter);
  command->callback(
      [arguments, &exit_code] { exit_code = CalibrateUnlessInterrupted(*arguments); });
}

}  // namespace corvo
