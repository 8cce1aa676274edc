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
    CheckSize(*next, {odometry.camera().width(), odometry.camera().height()});
    odometry.Process(next->image, next->time_ns, next->mask);
  }
  odometry.Finish();
}

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
  return MakeFocalPrior(camera, options.stated_focal_sigma, options);
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
  Odometry odometry(start.prior, options.odometry, options.threads);
  ProcessStream(*sequence(), options.max_first_pass_images, {Stage::kTracking, 1, 0, {}, {}},
                progress, odometry);
  if (progress.is_canceled()) return std::nullopt;
  start.prior.given = odometry.camera().parameters();
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
