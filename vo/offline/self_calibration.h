// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "vo/camera/camera_prior.h"
#include "vo/core/options.h"
#include "vo/offline/camera_selection.h"
#include "vo/offline/focal_search.h"
#include "vo/offline/image_pairs.h"
#include "vo/offline/image_stream.h"

namespace corvo {

/// What a self-calibration is doing.
struct CalibrationStep {
  enum class Stage { kFocalSearch, kTracking, kAdjustment };

  Stage stage = Stage::kFocalSearch;
  int round = 0;                               ///< From 1; kTracking.
  int sequence = 0;                            ///< From 0; kTracking.
  CalibrationModel model{};                    ///< kAdjustment.
  std::optional<double> share = std::nullopt;  ///< Done of this step, 0 to 1, if known.
};

/// Is told what is being done; returns whether to go on.
using CalibrationProgress = std::function<bool(const CalibrationStep&)>;

/// How a camera is found from its images alone.
struct SelfCalibrationOptions {
  OdometryOptions odometry;
  ImagePairOptions image_pairs;
  FocalSearchOptions focal_search;
  CandidateOptions candidates;
  int threads = 1;
  int max_first_pass_images = 500;   // ablation
  int max_rounds = 4;                // ablation
  double max_focal_change = 0.01;    // ablation
  double min_focal_sigma = 0.1;      // docs/calibration.md
  double max_focal_sigma = 0.5;      // Beyond it any focal length is as good.
  double k1_sigma = 0.1;             // docs/calibration.md
  double k2_sigma = 0.05;            // docs/calibration.md
  double center_sigma_share = 0.01;  // docs/calibration.md

  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("threads", self.threads, 1, 4096, "threads of each odometry");
    field("max_first_pass_images", self.max_first_pass_images, 2, 1000000000,
          "images after which FindCamera takes the odometry's camera");
    field("max_rounds", self.max_rounds, 1, 100,
          "largest number of passes of CalibrateCamera through all sequences");
    field("max_focal_change", self.max_focal_change, 0.0, 10.0,
          "change of the focal length with which CalibrateCamera's passes end, as a share of it");
    field("min_focal_sigma", self.min_focal_sigma, 1e-6, 10.0,
          "least standard deviation of a focal length that was searched, as a share of it");
    field("max_focal_sigma", self.max_focal_sigma, 1e-6, 10.0,
          "largest standard deviation of a focal length that was searched, as a share of it");
    field("k1_sigma", self.k1_sigma, 1e-6, 10.0, "standard deviation of k1 before the first image");
    field("k2_sigma", self.k2_sigma, 1e-6, 10.0, "standard deviation of k2 before the first image");
    field("center_sigma_share", self.center_sigma_share, 1e-6, 1.0,
          "standard deviation of the principal point, as a share of the width");
  }

  /// Throws corvo::Error naming the first field out of range.
  void Validate() const;
};

/// A camera to start from.
struct CameraStart {
  FocalSearchResult search;
  CameraPrior prior;
};

/// Searches the focal length of the one camera that took all these sequences. Each is opened and
/// read once, those of unknown length twice. The focal length is then known to within the search's
/// sigma, at least `min_focal_sigma`, as the principal point and distortion that the search assumes
/// are not the camera's; the principal point to within a share of the width; k1 and k2 are all but
/// unknown. None where `progress` asked to stop. Throws corvo::Error where images differ in size.
std::optional<CameraStart> FindFocalLength(const std::vector<StreamOpener>& sequences,
                                           const SelfCalibrationOptions& options,
                                           const CalibrationProgress& progress = {});

/// The same of one sequence, but the camera is the one that the odometry has found when it has
/// passed through the first images: what is tracked before a camera is known stays worse. It is
/// known no better than the search knows it, so that a run over the same images counts them once.
std::optional<CameraStart> FindCamera(const StreamOpener& sequence,
                                      const SelfCalibrationOptions& options,
                                      const CalibrationProgress& progress = {});

/// A camera from its sequences, without a calibration target.
struct CameraCalibration {
  CameraStart start;
  bool is_canceled = false;                 ///< `progress` asked to stop.
  std::vector<CameraCandidate> candidates;  ///< One for each model; none if nothing was tracked.
  int selected = kNoId;                     ///< Index of the best candidate, see SelectCandidate.
};

/// Calibrates the camera that took all these sequences with one setting of zoom and focus: from the
/// focal length found by the search, the odometry runs over each sequence and all are adjusted
/// together, both again while the focal length changes by more than `max_focal_change`. Then each
/// model is adjusted to the same observations, and the simplest is selected that the Bayesian
/// information criterion does not clearly reject. Throws corvo::Error on images of different sizes
/// and without models.
CameraCalibration CalibrateCamera(const std::vector<StreamOpener>& sequences,
                                  const std::vector<CalibrationModel>& models,
                                  const SelfCalibrationOptions& options,
                                  const CalibrationProgress& progress = {});

/// The free parameters of a candidate with the standard deviations of its estimate.
std::vector<FreeParameter> EstimatedSigmas(const CameraCandidate& candidate);

}  // namespace corvo
