#include "vo/differentiable_camera.h"

#include "orb/error.h"

namespace corvo {
namespace {

/// Small against what a parameter may be, large against rounding.
double StepOf(const std::string& name) {
  const bool is_in_px = name == "fx" || name == "fy" || name == "cx" || name == "cy";
  return is_in_px ? 1e-3 : 1e-6;
}

std::optional<Camera> TryCamera(const CameraParameters& parameters) {
  try {
    return Camera(parameters);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

DifferentiableCamera::DifferentiableCamera(const CameraPrior& prior,
                                           const Eigen::VectorXd& difference)
    : camera_(prior.Apply(difference)) {
  for (int i = 0; i < prior.num_free(); ++i) {
    const double step = StepOf(prior.free[i].name);
    const Eigen::VectorXd change = step * Eigen::VectorXd::Unit(prior.num_free(), i);
    neighbors_.push_back({TryCamera(prior.Apply(difference - change)),
                          TryCamera(prior.Apply(difference + change)), step});
  }
}

DifferentiableCamera::Jacobian DifferentiableCamera::PixelByDifference(
    const Eigen::Vector3d& in_camera, const Eigen::Vector2d& pixel) const {
  Jacobian jacobian(2, neighbors_.size());
  for (std::size_t i = 0; i < neighbors_.size(); ++i) {
    const auto& [below, above, step] = neighbors_[i];
    const auto low = below ? below->Project(in_camera) : std::nullopt;
    const auto high = above ? above->Project(in_camera) : std::nullopt;
    const int num_steps = (low ? 1 : 0) + (high ? 1 : 0);
    jacobian.col(i) =
        (high.value_or(pixel) - low.value_or(pixel)) / (step * std::max(1, num_steps));
  }
  return jacobian;
}

}  // namespace corvo
