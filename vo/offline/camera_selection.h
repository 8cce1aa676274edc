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

/// What lenses have, and when a model is rejected.
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

/// What is known of a camera of this model before its images are seen, besides a start: of the
/// focal length nothing, of the principal point that it lies near the image's center, of its
/// distortion that it is not beyond what lenses have. Pixels are square: fx and fy keep their
/// ratio.
CameraPrior PriorOf(CalibrationModel model, const Camera& start,
                    const CandidateOptions& options = {});

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
/// BundleAdjuster. Throws corvo::Error on options out of range.
CameraCandidate AdjustCandidate(CalibrationModel model, const Camera& start,
                                const std::vector<Bundle>& bundles,
                                const CandidateOptions& options = {},
                                const AdjustmentProgress& progress = {});

/// The index of the candidate with the fewest parameters of those whose information criterion is
/// within `max_excess` of the lowest. kNoId where no candidate has a usable adjustment.
int SelectCandidate(const std::vector<CameraCandidate>& candidates,
                    const CandidateOptions& options = {});

}  // namespace corvo
