#include "apps/commands/calibrate.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/output/candidate_report.h"
#include "apps/output/observation_spool.h"
#include "apps/output/output_folder.h"
#include "apps/output/residual_plot.h"
#include "apps/run/focal_start.h"
#include "apps/run/interruption.h"
#include "apps/run/odometry_pass.h"
#include "apps/run/progress_line.h"
#include "apps/run/run_inputs.h"
#include "orb/error.h"
#include "vo/io/config.h"
#include "vo/offline/camera_selection.h"
#include "vo/offline/sequence_record.h"

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
  std::string focal = "auto";
  std::optional<double> frame_rate_hz;
  Selection selection;
  int threads = 1;
};

std::vector<ImageOpener> Openers(const CalibrateArguments& arguments) {
  constexpr double kDefaultFrameRateHz = 30;
  std::vector<ImageOpener> openers;
  for (const fs::path& input : arguments.inputs) {
    if (IsLiveInput(input.string())) {
      throw Error(fmt::format("{}: is a live camera, whose images come but once; give a recording",
                              input.string()));
    }
    openers.emplace_back([input, &arguments] {
      return OpenImages(input.string(), arguments.frame_rate_hz, kDefaultFrameRateHz,
                        arguments.selection);
    });
  }
  return openers;
}

/// The models that are tried.
std::vector<CalibrationModel> Descriptions(const std::string& model) {
  std::vector<CalibrationModel> descriptions;
  for (const CalibrationModel description : AllCalibrationModels()) {
    if (model.empty() || ToString(description) == model) descriptions.push_back(description);
  }
  return descriptions;
}

class Calibration {
 public:
  explicit Calibration(const CalibrateArguments& arguments)
      : openers_(Openers(arguments)),
        threads_(arguments.threads),
        descriptions_(Descriptions(arguments.model)) {}

  /// Of all models; none where no input could be tracked.
  std::vector<CameraCandidate> Run() {
    constexpr int kMaxRounds = 4;
    constexpr double kSameFocal = 0.01;
    // While the tracks change, one model is enough.
    const CalibrationModel first =
        descriptions_.size() == 1 ? descriptions_.front() : CalibrationModel::kRadtan;
    CameraPrior prior = FindFocalLength(openers_, interruption_);
    for (int round = 1;; ++round) {
      const std::vector<Bundle> bundles = TrackAll(prior, round);
      if (bundles.empty()) return {};
      const CameraCandidate candidate = Adjust(first, Camera(prior.given), bundles);
      const bool is_improved = candidate.adjustment.outcome == AdjustmentOutcome::kImproved;
      const double change = std::log(candidate.adjustment.camera.fx / prior.given.fx);
      if (!is_improved || round == kMaxRounds || std::abs(change) < kSameFocal) {
        return AdjustAll(candidate, bundles);
      }
      prior = {candidate.adjustment.camera, EstimatedSigma(candidate)};
    }
  }

 private:
  std::vector<Bundle> TrackAll(const CameraPrior& prior, int round) {
    std::vector<Bundle> bundles;
    for (std::size_t i = 0; i < openers_.size(); ++i) {
      const std::string text =
          fmt::format("round {}, input {} of {}", round, i + 1, openers_.size());
      for (Bundle& bundle : Track(openers_[i](), prior, text)) bundles.push_back(std::move(bundle));
    }
    return bundles;
  }

  std::vector<Bundle> Track(ImageSource source, const CameraPrior& prior,
                            const std::string& text) const {
    const cv::Size size(prior.given.width, prior.given.height);
    source.Prepare({size, size, MaskSource()});
    Odometry odometry(prior, {}, threads_);
    ObservationSpool spool;
    odometry.SetObservationCallback([&](const FrameObservations& frame) { spool.Add(frame); });
    PassThrough(std::move(source), text, interruption_, odometry);
    const auto replay = [&](const ObservationCallback& visit) { spool.ForEach(visit); };
    return SequenceRecord(odometry, replay, {}).MakeBundles();
  }

  CameraCandidate Adjust(CalibrationModel description, const Camera& start,
                         const std::vector<Bundle>& bundles) const {
    ProgressLine line;
    CameraCandidate candidate = AdjustCandidate(description, start, bundles, [&](double share) {
      line.Show(share, fmt::format("adjusting, {}", ToString(description)));
      return !interruption_.IsRequested();
    });
    interruption_.ThrowIfRequested();
    return candidate;
  }

  std::vector<CameraCandidate> AdjustAll(const CameraCandidate& first,
                                         const std::vector<Bundle>& bundles) const {
    std::vector<CameraCandidate> candidates;
    for (const CalibrationModel description : descriptions_) {
      candidates.push_back(description == first.description
                               ? first
                               : Adjust(description, Camera(first.prior.given), bundles));
    }
    return candidates;
  }

  Interruption interruption_;
  std::vector<ImageOpener> openers_;
  int threads_;
  std::vector<CalibrationModel> descriptions_;
};

void WriteCalibration(const CameraCandidate& candidate, const fs::path& file) {
  const Camera camera(candidate.adjustment.camera);
  const std::string name = file.filename().string();
  const std::string image = file.stem().string() + "_residuals.png";
  OutputFolder output(fs::absolute(file).parent_path());
  output.Write(name, WriteCameraFile(
                         {camera, {}, "estimated by corvo calibrate", EstimatedSigma(candidate)}));
  if (!DrawResiduals(camera, candidate.bundles, output.Stage(image))) {
    spdlog::warn("no {}: gnuplot is missing or failed (Debian: gnuplot-nox)", image);
  }
  output.Commit({image, name});
}

int Calibrate(const CalibrateArguments& arguments) {
  CheckOutputFile(arguments.output, "the camera");
  const std::vector<CameraCandidate> candidates = Calibration(arguments).Run();
  const int selected = SelectCandidate(candidates);
  if (selected == kNoId) {
    spdlog::error("no input could be {}: nothing is written",
                  candidates.empty() ? "tracked" : "adjusted");
    return kNotCalibrated;
  }
  const CameraCandidate& candidate = candidates[selected];
  fmt::print("{}\n{}", CandidatesText(candidates, selected), EstimateText(candidate));
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
  command->add_option("--focal", arguments->focal, "auto: start from a sweep over fields of view")
      ->check(CLI::IsMember({"auto"}))
      ->capture_default_str();
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
