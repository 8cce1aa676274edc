// SPDX-License-Identifier: MIT
#include "vo/offline/self_calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/camera/centered_pinhole.h"
#include "vo/core/option_fields.h"
#include "vo/odometry.h"
#include "vo/offline/map_camera.h"
#include "vo/offline/observation_log.h"
#include "vo/offline/sequence_record.h"

namespace corvo {
namespace {

using Stage = CalibrationStep::Stage;

/// Reports steps to a callback until it returns false.
class Progress {
 public:
  explicit Progress(const CalibrationProgress& callback) : callback_(callback) {}

  bool Report(const CalibrationStep& step) {
    if (!is_canceled_ && callback_ && !callback_(step)) is_canceled_ = true;
    return !is_canceled_;
  }
  bool is_canceled() const { return is_canceled_; }

 private:
  const CalibrationProgress& callback_;
  bool is_canceled_ = false;
};

/// Throws corvo::Error if an image differs in size from the previous ones: all sequences are of one
/// camera.
void CheckSize(const StreamImage& image, const cv::Size& size) {
  if (image.image.size() == size) return;
  throw Error(fmt::format("{}: the image is {} x {} px, others {} x {} px", image.name,
                          image.image.cols, image.image.rows, size.width, size.height));
}

/// Returns the number of images in a sequence, by counting them if the stream does not have a size.
int CountImages(const StreamOpener& open, Progress& progress) {
  const std::unique_ptr<ImageStream> stream = open();
  if (const std::optional<int> size = stream->size()) return *size;
  int count = 0;
  while (stream->Skip() && progress.Report({Stage::kFocalSearch})) ++count;
  return count;
}

/// Matches pairs of images of all sequences.
class PairCollector {
 public:
  PairCollector(const ImagePairOptions& options_of_one, Progress& progress)
      : options_of_one_(options_of_one), progress_(progress) {}

  void Add(const StreamOpener& open) {
    const int num_images = CountImages(open, progress_);
    ImagePairs sequence(num_images, options_of_one_);
    const std::unique_ptr<ImageStream> stream = open();
    for (int i = 0; progress_.Report(StepAt(i, num_images)); ++i) {
      if (!sequence.Needs(i)) {
        if (!stream->Skip()) break;
        continue;
      }
      const std::optional<StreamImage> next = stream->Next();
      if (!next) break;
      if (next->missing != Reason::kNone) continue;
      if (size_.empty()) size_ = next->image.size();
      CheckSize(*next, size_);
      sequence.Add(i, next->image, next->mask);
    }
    for (PixelMatches& matches : sequence.Get()) pairs_.push_back(std::move(matches));
  }

  const cv::Size& size() const { return size_; }
  const std::vector<PixelMatches>& pairs() const { return pairs_; }

 private:
  static CalibrationStep StepAt(int i, int num_images) {
    CalibrationStep step;
    step.share = std::min(1.0, static_cast<double>(i) / std::max(1, num_images));
    return step;
  }

  ImagePairOptions options_of_one_;
  Progress& progress_;
  cv::Size size_;
  std::vector<PixelMatches> pairs_;
};

CameraPrior MakeFocalPrior(const CameraParameters& camera, double focal_sigma,
                           const SelfCalibrationOptions& options) {
  const double center_sigma_px = options.center_sigma_share * camera.width;
  return {camera,
          {{"focal", focal_sigma},
           {"cx", center_sigma_px},
           {"cy", center_sigma_px},
           {"k1", options.k1_sigma},
           {"k2", options.k2_sigma}}};
}

CameraStart SearchStart(const std::vector<StreamOpener>& sequences,
                        const SelfCalibrationOptions& options, Progress& progress) {
  ImagePairOptions options_of_one = options.image_pairs;
  const int num_sequences = std::max(1, static_cast<int>(sequences.size()));
  options_of_one.max_pairs = std::max(1, options_of_one.max_pairs / num_sequences);
  PairCollector collector(options_of_one, progress);
  for (const StreamOpener& open : sequences) collector.Add(open);
  if (progress.is_canceled()) return {};
  CameraStart start;
  const cv::Size size = collector.size();
  start.search = SearchFocal(collector.pairs(), size.width, size.height, options.focal_search);
  const double focal_sigma =
      std::clamp(start.search.focal_sigma, options.min_focal_sigma, options.max_focal_sigma);
  start.prior = MakeFocalPrior(start.search.camera, focal_sigma, options);
  return start;
}

/// Processes the images of a stream with an odometry, at most `max_images`, and finishes it.
void ProcessStream(ImageStream& stream, int max_images, CalibrationStep step, Progress& progress,
                   Odometry& odometry) {
  for (int num_read = 0; num_read < max_images; ++num_read) {
    if (stream.size()) {
      step.share = static_cast<double>(num_read) / std::min(max_images, *stream.size());
    }
    if (!progress.Report(step)) return;
    const std::optional<StreamImage> next = stream.Next();
    if (!next) break;
    if (next->missing != Reason::kNone) {
      odometry.ProcessMissing(next->time_ns, next->missing);
      continue;
    }
    CheckSize(*next, {odometry.camera().width(), odometry.camera().height()});
    odometry.Process(next->image, next->time_ns, next->mask);
  }
  odometry.Finish();
}

/// A pass of the odometry over the first images of a sequence.
struct Pass {
  CameraParameters camera;  // At the end of the pass.
  int num_posed = 0;
  int num_segments = 0;
  bool is_complete = false;  // Nearly all frames are posed.
  bool prior_rejected = false;

  bool IsWorseThan(const Pass& other) const {
    return num_posed < other.num_posed || num_segments > other.num_segments || prior_rejected;
  }
};

Pass MakePass(const Odometry& odometry) {
  constexpr double kNearlyAll = 0.95;
  const Trajectory trajectory = odometry.GetTrajectory();
  Pass pass{odometry.camera().parameters()};
  pass.is_complete = trajectory.PosedShare() >= kNearlyAll;
  pass.prior_rejected = odometry.prior_rejected();
  for (const Segment& segment : trajectory.Segments()) {
    pass.num_posed += segment.num_poses;
    ++pass.num_segments;
  }
  return pass;
}

std::vector<FreeParameter> WithoutCenter(std::vector<FreeParameter> free) {
  std::erase_if(free, [](const FreeParameter& parameter) {
    return parameter.name == "cx" || parameter.name == "cy";
  });
  return free;
}

/// Finds the camera of one sequence, starting with the result of the search. Passes with a fixed
/// camera alternate with adjustments of their maps: a camera that changes while it tracks deforms
/// the map, and a deformed map seems to determine parameters that the motion does not.
class CameraFinder {
 public:
  CameraFinder(const StreamOpener& sequence, const CameraStart& start,
               const SelfCalibrationOptions& options, Progress& progress)
      : sequence_(sequence), start_(start), options_(options), progress_(progress) {}

  /// Returns the prior for a run, or that of the search if nothing was tracked. It is unspecified
  /// if the progress was canceled.
  CameraPrior Run() {
    CameraPrior found = start_.prior;
    double last_change = std::numeric_limits<double>::infinity();
    int num_diverging = 0;  // Rounds in succession.
    for (int round = 1; round <= options_.max_rounds; ++round) {
      const CameraPrior fixed{found.given, {}};
      Odometry odometry(fixed, options_.odometry, options_.threads);
      const Pass pass = Track(odometry);
      if (progress_.is_canceled() || pass.num_posed == 0) return Verified(start_.prior);
      if (best_ && pass.IsWorseThan(*best_)) return Verified(Fallback());
      const CameraPrior adjusted = Adjust(odometry.map());
      if (round > 1 && !adjusted.free.empty()) lenses_.push_back(adjusted.given);
      const double change = std::abs(std::log(adjusted.given.fx / fixed.given.fx));
      const bool converges =
          change <= options_.max_lens_sigma || change <= options_.max_change_ratio * last_change;
      num_diverging = converges ? 0 : num_diverging + 1;
      const bool is_last = round == options_.max_rounds || !pass.is_complete;
      if (num_diverging == 2 || (num_diverging > 0 && is_last)) return Verified(Fallback());
      best_ = pass;
      if (!first_) first_ = pass;
      found = adjusted;
      last_change = change;
      if (change < options_.max_focal_change) break;
    }
    return Verified(found);
  }

 private:
  Pass Track(Odometry& odometry) {
    ProcessStream(*sequence_(), options_.max_first_pass_images,
                  {Stage::kTracking, ++num_passes_, 0, {}, {}}, progress_, odometry);
    return MakePass(odometry);
  }

  /// Returns the camera that fits a map best, as the prior of a run: with as many free parameters
  /// as leave the focal length determined, or else an ideal lens.
  CameraPrior Adjust(const Map& map) const {
    const std::vector<KeyframeGroup> groups =
        SplitKeyframes(map, 1, options_.odometry.calibration.min_keyframes);
    if (groups.empty()) return {map.camera().parameters(), {}};
    const CameraPrior& searched = start_.prior;
    for (const auto& free : {searched.free, WithoutCenter(searched.free)}) {
      const AdjustmentSummary lens = AdjustMapCamera(map, groups, {searched.given, free});
      if (lens.is_usable() && std::sqrt(lens.estimate.covariance(0, 0)) < options_.max_lens_sigma) {
        return {lens.camera, RunParameters()};
      }
    }
    return {AdjustMapCamera(map, groups, {searched.given, {searched.free.front()}}).camera, {}};
  }

  /// Returns the free parameters of a run with a camera that was estimated.
  std::vector<FreeParameter> RunParameters() const {
    const CalibrationOptions& given = options_.odometry.calibration;
    return {{"focal", options_.run_focal_sigma}, {"k1", given.k1_sigma}, {"k2", given.k2_sigma}};
  }

  /// Returns the prior for a run if the adjustments do not converge: their mean, if they scatter
  /// less than the search is uncertain, or else the camera of the search, or the last camera that
  /// was tracked if the search does not determine it.
  CameraPrior Fallback() const {
    const std::optional<CameraPrior> mean = MeanLens();
    if (mean && mean->free.front().sigma < start_.prior.free.front().sigma) return *mean;
    if (!start_.search.is_determined) return {best_->camera, {}};
    return {start_.prior.given, WithoutCenter(start_.prior.free)};
  }

  /// Returns the mean of the adjusted cameras as a prior whose focal length is as uncertain as they
  /// scatter, or std::nullopt if there are fewer than two.
  std::optional<CameraPrior> MeanLens() const {
    const auto num = static_cast<Eigen::Index>(lenses_.size());
    if (num < 2) return std::nullopt;
    Eigen::MatrixXd differences(start_.prior.num_free(), num);
    for (Eigen::Index i = 0; i < num; ++i) {
      differences.col(i) = start_.prior.Difference(lenses_[i]);
    }
    const Eigen::VectorXd mean = differences.rowwise().mean();
    const double squares = (differences.row(0).array() - mean[0]).square().sum();
    CameraPrior prior{start_.prior.Apply(mean), RunParameters()};
    double& focal_sigma = prior.free.front().sigma;
    focal_sigma = std::max(focal_sigma, std::sqrt(squares / static_cast<double>(num - 1)));
    return prior;
  }

  /// Returns a prior if a pass with it is not worse than the passes with a fixed camera, and
  /// otherwise the camera of those passes.
  CameraPrior Verified(const CameraPrior& found) {
    if (progress_.is_canceled() || !best_) return found;
    Odometry odometry(found, options_.odometry, options_.threads);
    const bool is_start = found.given == first_->camera;
    const Pass& best = is_start ? *first_ : *best_;
    const Pass pass = Track(odometry);
    return pass.IsWorseThan(best) ? CameraPrior{best.camera, {}} : found;
  }

  const StreamOpener& sequence_;
  const CameraStart& start_;
  const SelfCalibrationOptions& options_;
  Progress& progress_;
  std::optional<Pass> first_;
  std::optional<Pass> best_;
  int num_passes_ = 0;
  std::vector<CameraParameters> lenses_;  // Adjusted with their distortion, not to the first map.
};

/// A calibration of one camera in progress.
class Calibrator {
 public:
  Calibrator(const std::vector<StreamOpener>& sequences,
             const std::vector<CalibrationModel>& models, const SelfCalibrationOptions& options,
             Progress& progress)
      : sequences_(sequences), models_(models), options_(options), progress_(progress) {}

  /// Returns candidates for all models, starting with `prior`, or none if nothing was tracked.
  std::vector<CameraCandidate> Run(CameraPrior prior) {
    // One model is sufficient while the tracks change.
    const CalibrationModel first =
        models_.size() == 1 ? models_.front() : CalibrationModel::kRadtan;
    for (int round = 1;; ++round) {
      const std::vector<Bundle> bundles = TrackAll(prior, round);
      if (bundles.empty()) return {};
      const CameraCandidate candidate = Adjust(first, Camera(prior.given), bundles);
      const AdjustmentSummary& adjustment = candidate.adjustment;
      const double change = std::abs(std::log(adjustment.camera.fx / prior.given.fx));
      const bool is_last = round == options_.max_rounds || change < options_.max_focal_change;
      if (!adjustment.is_usable() || is_last) return AdjustAll(candidate, bundles);
      prior = {adjustment.camera, EstimatedSigmas(candidate)};
    }
  }

 private:
  std::vector<Bundle> TrackAll(const CameraPrior& prior, int round) {
    std::vector<Bundle> bundles;
    for (int i = 0; i < static_cast<int>(sequences_.size()); ++i) {
      Odometry odometry(prior, options_.odometry, options_.threads);
      ObservationLog log;
      odometry.SetObservationCallback(log.Callback());
      ProcessStream(*sequences_[i](), std::numeric_limits<int>::max(),
                    {Stage::kTracking, round, i, {}, {}}, progress_, odometry);
      if (progress_.is_canceled()) return {};
      for (Bundle& bundle : SequenceRecord(odometry, log, {}).MakeBundles()) {
        bundles.push_back(std::move(bundle));
      }
    }
    return bundles;
  }

  CameraCandidate Adjust(CalibrationModel model, const Camera& start,
                         const std::vector<Bundle>& bundles) {
    const auto report = [&](double share) {
      return progress_.Report({Stage::kAdjustment, 0, 0, model, share});
    };
    return AdjustCandidate(model, start, bundles, options_.candidates, report);
  }

  std::vector<CameraCandidate> AdjustAll(const CameraCandidate& first,
                                         const std::vector<Bundle>& bundles) {
    std::vector<CameraCandidate> candidates;
    for (const CalibrationModel model : models_) {
      candidates.push_back(
          model == first.model ? first : Adjust(model, Camera(first.prior.given), bundles));
    }
    return candidates;
  }

  const std::vector<StreamOpener>& sequences_;
  const std::vector<CalibrationModel>& models_;
  const SelfCalibrationOptions& options_;
  Progress& progress_;
};

}  // namespace

void SelfCalibrationOptions::Validate() const {
  odometry.Validate();
  image_pairs.Validate();
  focal_search.Validate();
  candidates.Validate();
  CheckFields("self_calibration", *this);
  CheckRange("self_calibration.max_focal_sigma", max_focal_sigma, min_focal_sigma, 10.0);
}

CameraPrior StatedFocalPrior(double focal_px, const cv::Size& size,
                             const SelfCalibrationOptions& options) {
  options.Validate();
  const CameraParameters camera = CenteredPinhole(focal_px, size.width, size.height);
  camera.Validate();
  SelfCalibrationOptions stated = options;
  stated.k1_sigma = options.stated_k1_sigma;
  stated.k2_sigma = options.stated_k2_sigma;
  return MakeFocalPrior(camera, options.stated_focal_sigma, stated);
}

std::optional<CameraStart> FindFocalLength(const std::vector<StreamOpener>& sequences,
                                           const SelfCalibrationOptions& options,
                                           const CalibrationProgress& callback) {
  options.Validate();
  Progress progress(callback);
  CameraStart start = SearchStart(sequences, options, progress);
  if (progress.is_canceled()) return std::nullopt;
  return start;
}

std::optional<CameraStart> FindCamera(const StreamOpener& sequence,
                                      const SelfCalibrationOptions& options,
                                      const CalibrationProgress& callback) {
  options.Validate();
  Progress progress(callback);
  CameraStart start = SearchStart({sequence}, options, progress);
  if (progress.is_canceled()) return std::nullopt;
  CameraPrior prior = CameraFinder(sequence, start, options, progress).Run();
  if (progress.is_canceled()) return std::nullopt;
  start.prior = std::move(prior);
  return start;
}

CameraCalibration CalibrateCamera(const std::vector<StreamOpener>& sequences,
                                  const std::vector<CalibrationModel>& models,
                                  const SelfCalibrationOptions& options,
                                  const CalibrationProgress& callback) {
  if (models.empty()) throw Error("calibration: no model is given; allowed is one or more");
  options.Validate();
  Progress progress(callback);
  CameraCalibration calibration;
  calibration.start = SearchStart(sequences, options, progress);
  if (!progress.is_canceled()) {
    calibration.candidates =
        Calibrator(sequences, models, options, progress).Run(calibration.start.prior);
  }
  calibration.is_canceled = progress.is_canceled();
  calibration.selected = SelectCandidate(calibration.candidates, options.candidates);
  return calibration;
}

std::vector<FreeParameter> EstimatedSigmas(const CameraCandidate& candidate) {
  return Posterior(candidate.prior.free, candidate.adjustment.estimate.covariance);
}

}  // namespace corvo
