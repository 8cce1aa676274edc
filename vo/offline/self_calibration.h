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

/// A step of a self-calibration in progress.
struct CalibrationStep {
  enum class Stage { kFocalSearch, kTracking, kAdjustment };

  Stage stage = Stage::kFocalSearch;
  int round = 0;                               ///< Round from 1; set in kTracking.
  int sequence = 0;                            ///< Index of the sequence; set in kTracking.
  CalibrationModel model{};                    ///< Set in kAdjustment.
  std::optional<double> share = std::nullopt;  ///< Share that is done, 0 to 1, if known.
};

/// Called with the current step. Returns whether to continue.
using CalibrationProgress = std::function<bool(const CalibrationStep&)>;

/// Options for estimating a camera from its images alone.
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
  double max_focal_sigma = 0.5;      // Larger values leave the focal length free.
  double stated_focal_sigma = 0.05;  // A data sheet's, in video that may be cropped.
  double stated_k1_sigma = 0.1;      // Less than k1_sigma, because there is only one pass.
  double stated_k2_sigma = 0.05;
  double k1_sigma = 0.2;             // |k1| of phones and action cameras is at most 0.4.
  double k2_sigma = 0.1;             // docs/calibration.md
  double center_sigma_share = 0.01;  // docs/calibration.md
  double max_lens_sigma = 0.03;      // docs/calibration.md
  double max_change_ratio = 0.5;     // docs/calibration.md
  double run_focal_sigma = 0.03;     // docs/calibration.md

  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("threads", self.threads, 1, 4096, "threads of each odometry");
    field("max_first_pass_images", self.max_first_pass_images, 2, 1000000000,
          "images of each of FindCamera's passes");
    field(
        "max_rounds", self.max_rounds, 1, 100,
        "largest number of passes of CalibrateCamera and FindCamera before their camera is taken");
    field("max_focal_change", self.max_focal_change, 0.0, 10.0,
          "change of the focal length with which the passes end, as a share of it");
    field("min_focal_sigma", self.min_focal_sigma, 1e-6, 10.0,
          "least standard deviation of a focal length that was searched, as a share of it");
    field("max_focal_sigma", self.max_focal_sigma, 1e-6, 10.0,
          "largest standard deviation of a focal length that was searched, as a share of it");
    field("stated_focal_sigma", self.stated_focal_sigma, 1e-6, 10.0,
          "standard deviation of a focal length that the user states, as a share of it");
    field("stated_k1_sigma", self.stated_k1_sigma, 1e-6, 10.0,
          "standard deviation of k1 beside a focal length that the user states");
    field("stated_k2_sigma", self.stated_k2_sigma, 1e-6, 10.0,
          "standard deviation of k2 beside a focal length that the user states");
    field("k1_sigma", self.k1_sigma, 1e-6, 10.0, "standard deviation of k1 before the first image");
    field("k2_sigma", self.k2_sigma, 1e-6, 10.0, "standard deviation of k2 before the first image");
    field("center_sigma_share", self.center_sigma_share, 1e-6, 1.0,
          "standard deviation of the principal point, as a share of the width");
    field("max_lens_sigma", self.max_lens_sigma, 1e-6, 10.0,
          "standard deviation of the focal length up to which FindCamera estimates the principal "
          "point and distortion, as a share of it");
    field(
        "max_change_ratio", self.max_change_ratio, 0.0, 10.0,
        "change of the focal length of FindCamera's adjustments relative to the one before; above "
        "it they do not converge");
    field("run_focal_sigma", self.run_focal_sigma, 1e-6, 10.0,
          "standard deviation of the focal length that FindCamera returns, as a share of it");
  }

  /// Throws corvo::Error naming the first field out of range.
  void Validate() const;
};

/// Returns the prior of a camera of which only the focal length is stated: a pinhole with the
/// principal point in the image center. Its standard deviations are `stated_focal_sigma`,
/// `stated_k1_sigma`, `stated_k2_sigma` and, for the principal point, `center_sigma_share`. Throws
/// corvo::Error if the focal length or an option is out of range.
CameraPrior StatedFocalPrior(double focal_px, const cv::Size& size,
                             const SelfCalibrationOptions& options = {});

/// An initial camera, with the search for its focal length.
struct CameraStart {
  FocalSearchResult search;
  CameraPrior prior;
};

/// Searches for the focal length of the one camera that took all these sequences. Each sequence is
/// read once, or twice if its length is unknown. In the prior, the standard deviation of the focal
/// length is that of the search, but at least `min_focal_sigma`, because the principal point and
/// distortion that the search assumes are not the camera's, and at most `max_focal_sigma`; that of
/// the principal point is a share of the width; k1 and k2 are nearly unknown. Returns std::nullopt
/// if `progress` asked to stop. Throws corvo::Error if images differ in size.
std::optional<CameraStart> FindFocalLength(const std::vector<StreamOpener>& sequences,
                                           const SelfCalibrationOptions& options,
                                           const CalibrationProgress& progress = {});

/// Like FindFocalLength() for one sequence, but the prior is that of a run over it. Passes of the
/// odometry over the first images with a fixed camera alternate with adjustments of that camera to
/// their maps. Principal point and distortion are estimated only if the focal length remains
/// determined. If the adjustments do not converge, the camera is their mean if they scatter less
/// than the search is uncertain, and otherwise that of the search. A last pass verifies the prior:
/// if it poses fewer images than the passes with a fixed camera, has more segments or rejects the
/// prior, the camera of those passes is returned without free parameters.
std::optional<CameraStart> FindCamera(const StreamOpener& sequence,
                                      const SelfCalibrationOptions& options,
                                      const CalibrationProgress& progress = {});

/// A camera calibrated from its sequences, without a calibration target.
struct CameraCalibration {
  CameraStart start;
  bool is_canceled = false;                 ///< `progress` asked to stop.
  std::vector<CameraCandidate> candidates;  ///< One for each model; empty if nothing was tracked.
  int selected = kNoId;                     ///< Index of the best candidate, see SelectCandidate.
};

/// Calibrates the camera that took all these sequences with one setting of zoom and focus. Starting
/// with the focal length found by the search, the odometry processes each sequence and all of them
/// are adjusted together; both are repeated while the focal length changes by more than
/// `max_focal_change`. Then each model is adjusted to the same observations, and the simplest model
/// that the Bayesian information criterion does not clearly reject is selected. Throws corvo::Error
/// if images differ in size or `models` is empty.
CameraCalibration CalibrateCamera(const std::vector<StreamOpener>& sequences,
                                  const std::vector<CalibrationModel>& models,
                                  const SelfCalibrationOptions& options,
                                  const CalibrationProgress& progress = {});

/// Returns the free parameters of a candidate with the standard deviations of its estimate.
std::vector<FreeParameter> EstimatedSigmas(const CameraCandidate& candidate);

}  // namespace corvo
