// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vo/camera/camera.h"
#include "vo/camera/camera_prior.h"
#include "vo/optimization/bundle.h"
#include "vo/optimization/bundle_adjuster.h"

namespace corvo {

/// A camera model for a camera of unknown calibration.
enum class CalibrationModel {
  kPinhole,  ///< Without distortion.
  kRadtan,   ///< Pinhole with k1, k2, p1 and p2.
  kKb4,      ///< CameraModel::kKb4.
  kFov,      ///< CameraModel::kFov.
};

/// Returns "pinhole", "radtan", "kb4" or "fov".
std::string_view ToString(CalibrationModel model);

/// Returns all models, in ascending order of their number of parameters.
std::vector<CalibrationModel> AllCalibrationModels();

/// Options of PriorOf(), AdjustCandidate() and SelectCandidate().
struct CandidateOptions {
  double center_sigma_share = 0.02;  // ablation
  double radial_sigma = 0.3;         // |k1| of the benchmark cameras is at most 0.28.
  double tangential_sigma = 0.01;    // |p1| of the benchmark cameras is at most 0.0054.
  double omega_sigma = 1;            // Omega of TUM monoVO's camera is 0.90.
  double max_excess = 10;            // "Very strong" evidence: Kass and Raftery, 1995.
  int num_rounds = 2;                // ablation

  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("center_sigma_share", self.center_sigma_share, 1e-6, 1.0,
          "standard deviation of the principal point around the image's center, as a share of the "
          "width");
    field("radial_sigma", self.radial_sigma, 1e-6, 10.0,
          "standard deviation of k1, k2, k3 and k4 around 0");
    field("tangential_sigma", self.tangential_sigma, 1e-6, 10.0,
          "standard deviation of p1 and p2 around 0");
    field("omega_sigma", self.omega_sigma, 1e-6, 10.0, "standard deviation of omega");
    field("max_excess", self.max_excess, 0.0, 1e6,
          "information criterion above the lowest up to which a simpler model is preferred");
    field("num_rounds", self.num_rounds, 1, 100,
          "rounds of the adjustment; outliers are removed after each but the last");
  }

  /// Throws corvo::Error naming the first field out of range.
  void Validate() const;
};

/// Returns the prior of a camera of this model, given a start: the focal length is unknown, the
/// principal point lies near the image center, and the distortion is within that of common lenses.
/// fx and fy keep their ratio.
CameraPrior PriorOf(CalibrationModel model, const Camera& start,
                    const CandidateOptions& options = {});

/// A camera model and the bundles adjusted with it.
struct CameraCandidate {
  CalibrationModel model = CalibrationModel::kPinhole;
  CameraPrior prior;
  AdjustmentSummary adjustment;
  std::vector<Bundle> bundles;  ///< Unchanged unless the adjustment is usable.
  /// Bayesian information criterion (Schwarz 1978), k ln(n) + 2 cost, with k free parameters and n
  /// coordinates; infinity unless the adjustment is usable.
  double information_criterion = 0;
};

/// Adjusts bundles that were observed by one camera, from a start, with a camera of this model. See
/// BundleAdjuster. Throws corvo::Error if an option is out of range.
CameraCandidate AdjustCandidate(CalibrationModel model, const Camera& start,
                                const std::vector<Bundle>& bundles,
                                const CandidateOptions& options = {},
                                const AdjustmentProgress& progress = {});

/// Returns the index of the candidate with the fewest parameters among those whose information
/// criterion is within `max_excess` of the lowest, or kNoId if no candidate has a usable
/// adjustment.
int SelectCandidate(const std::vector<CameraCandidate>& candidates,
                    const CandidateOptions& options = {});

}  // namespace corvo
