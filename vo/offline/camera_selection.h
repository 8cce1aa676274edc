#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vo/camera/camera.h"
#include "vo/camera/camera_prior.h"
#include "vo/optimization/bundle.h"
#include "vo/optimization/bundle_adjuster.h"

namespace corvo {

/// A way to describe a camera of which nothing is known.
enum class CalibrationModel {
  kPinhole,  ///< Without distortion.
  kRadtan,   ///< Pinhole with k1, k2, p1 and p2.
  kKb4,      ///< As CameraModel::kKb4.
  kFov,      ///< As CameraModel::kFov.
};

/// "pinhole", "radtan", "kb4" or "fov".
std::string_view ToString(CalibrationModel model);

/// All of them, the one with the fewest parameters first.
std::vector<CalibrationModel> AllCalibrationModels();

/// What is known of a camera of this model before its images are seen, besides a start: of the
/// focal length nothing, of the principal point that it lies near the image's center (sigma: 2%
/// of the width), of its distortion that it is not beyond what lenses have (sigma: radial terms
/// 0.3, tangential ones 0.01, omega 1). Pixels are square: fx and fy keep their ratio.
CameraPrior PriorOf(CalibrationModel model, const Camera& start);

/// Bundles adjusted with a camera of this model.
struct CameraCandidate {
  CalibrationModel model = CalibrationModel::kPinhole;
  CameraPrior prior;
  AdjustmentSummary adjustment;
  std::vector<Bundle> bundles;  ///< As they were, unless the adjustment is usable.
  /// Bayesian information criterion (Schwarz 1978), k ln(n) + 2 cost, with k free parameters and n
  /// coordinates; infinite unless the adjustment is usable.
  double information_criterion = 0;
};

/// Adjusts bundles that one camera has seen, from a start on, with a camera of this model. See
/// BundleAdjuster.
CameraCandidate AdjustCandidate(CalibrationModel model, const Camera& start,
                                const std::vector<Bundle>& bundles,
                                const AdjustmentProgress& progress = {});

/// The index of the candidate with the fewest parameters of those whose criterion is within 10 of
/// the lowest: beyond that the evidence is "very strong" (Kass and Raftery 1995). kNoId where no
/// candidate was lowered.
int SelectCandidate(const std::vector<CameraCandidate>& candidates);

}  // namespace corvo
