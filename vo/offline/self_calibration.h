#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "vo/camera/camera_prior.h"
#include "vo/core/options.h"
#include "vo/offline/camera_selection.h"
#include "vo/offline/focal_search.h"
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
  int threads = 1;
  int max_pairs = 16;               ///< Pairs of images of all sequences in the focal search.
  int max_first_pass_images = 500;  ///< See FindCamera.
  int max_rounds = 4;               ///< See CalibrateCamera.
  double max_focal_change = 0.01;   ///< See CalibrateCamera; a share of the focal length.
  double min_focal_sigma = 0.1;     ///< What the search assumes costs that much, a share.
  double max_focal_sigma = 0.5;     ///< A share.
  double k1_sigma = 0.1;            ///< Before the first image; the same of k2.
  double k2_sigma = 0.05;
  double center_sigma_share = 0.01;  ///< Of the principal point, as a share of the width.
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
  bool is_cancelled = false;                ///< `progress` asked to stop.
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
