// SPDX-License-Identifier: MIT
#include "vo/camera/camera_prior.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <type_traits>

#include "orb/error.h"
#include "vo/camera/camera.h"
#include "vo/math/chi_square.h"

namespace corvo {
namespace {

constexpr const char* kFocal = "focal";

/// Returns the field of that name, or null if there is none or it must not vary in an adjustment.
template <typename Parameters>
auto FindField(Parameters& camera, const std::string& name) -> decltype(&camera.fx) {
  decltype(&camera.fx) found = nullptr;
  CameraParameters::Visit(camera, [&](const char* field, auto& value, auto&&...) {
    if constexpr (std::is_floating_point_v<std::remove_cvref_t<decltype(value)>>) {
      if (name == field) found = &value;
    }
  });
  return found;
}

std::vector<std::string> FieldsOf(const std::string& name) {
  if (name == kFocal) return {"fx", "fy"};
  return {name};
}

/// Returns the standard deviation of the fov model's omega that acts like `k1_sigma`. Relative to
/// the focal length on the axis, the model's radial distortion begins with k1 = -(2 tan(omega /
/// 2))² / 3.
double OmegaSigma(double omega, double k1_sigma) {
  const double stretch = 2 * std::tan(0.5 * omega);
  return 2 * std::atan(0.5 * std::sqrt(stretch * stretch + 3 * k1_sigma)) - omega;
}

}  // namespace

std::vector<std::string> FreeParameterNames(CameraModel model) {
  std::vector<std::string> names = {kFocal};
  CameraParameters parameters;
  parameters.model = model;
  CameraParameters::Visit(parameters, [&](const char* name, auto& value, auto&&...) {
    if constexpr (std::is_floating_point_v<std::remove_cvref_t<decltype(value)>>) {
      names.emplace_back(name);
    }
  });
  return names;
}

void CameraPrior::Validate() const {
  given.Validate();
  std::set<std::string> seen;
  for (const FreeParameter& parameter : free) {
    if (!(parameter.sigma > 0)) {
      throw Error("camera prior: sigma of " + parameter.name + " is " +
                  std::to_string(parameter.sigma) + "; allowed is more than 0");
    }
    for (const std::string& field : FieldsOf(parameter.name)) {
      if (FindField(given, field) == nullptr) {
        throw Error("camera prior: the model " + std::string(ToString(given.model)) +
                    " has no parameter \"" + field + "\"");
      }
      if (!seen.insert(field).second) {
        throw Error("camera prior: " + field + " is free twice; allowed is once");
      }
    }
  }
}

std::vector<int> CameraPrior::IndicesWithoutEvidence() const {
  std::vector<int> indices;
  for (int i = 0; i < num_free(); ++i) {
    if (!free[i].needs_evidence) indices.push_back(i);
  }
  return indices;
}

CameraParameters CameraPrior::Apply(const Eigen::VectorXd& difference) const {
  CameraParameters camera = given;
  for (int i = 0; i < num_free(); ++i) {
    if (free[i].name == kFocal) {
      camera.fx *= std::exp(difference[i]);
      camera.fy *= std::exp(difference[i]);
    } else {
      *FindField(camera, free[i].name) += difference[i];
    }
  }
  return camera;
}

Eigen::VectorXd CameraPrior::Difference(const CameraParameters& camera) const {
  Eigen::VectorXd difference(num_free());
  for (int i = 0; i < num_free(); ++i) {
    difference[i] = free[i].name == kFocal
                        ? std::log(camera.fx / given.fx)
                        : ValueOf(camera, free[i].name) - ValueOf(given, free[i].name);
  }
  return difference;
}

double CameraPrior::SquaredError(const Eigen::VectorXd& difference) const {
  double sum = 0;
  for (int i = 0; i < num_free(); ++i) sum += std::pow(difference[i] / free[i].sigma, 2);
  return sum;
}

bool CameraPrior::PassesChiSquareTest(const Eigen::VectorXd& difference) const {
  int num_known = 0;
  for (int i = 0; i < num_free(); ++i) {
    const bool is_kept = free[i].needs_evidence && difference[i] == 0;
    if (std::isfinite(free[i].sigma) && !is_kept) ++num_known;
  }
  return SquaredError(difference) <= kChiSquare999[num_known];
}

CameraPrior CameraPrior::Inflated(double information) const {
  CameraPrior loosened = *this;
  for (FreeParameter& parameter : loosened.free) parameter.sigma *= std::sqrt(information);
  return loosened;
}

CameraPrior CameraPrior::Resized(int width, int height) const {
  CameraPrior resized{Camera(given).Resized(width, height).parameters(), free};
  for (FreeParameter& parameter : resized.free) {
    const std::string& name = parameter.name;
    if (name == "fx" || name == "cx") parameter.sigma *= resized.given.fx / given.fx;
    if (name == "fy" || name == "cy") parameter.sigma *= resized.given.fy / given.fy;
  }
  return resized;
}

CameraPrior MakePrior(const CameraParameters& given, const CalibrationOptions& options) {
  const double center_sigma = options.center_sigma_share * given.width;
  CameraPrior prior{given,
                    {{kFocal, options.focal_sigma},
                     {"k1", options.k1_sigma},
                     {"k2", options.k2_sigma},
                     {"omega", OmegaSigma(given.omega, options.k1_sigma)},
                     {"cx", center_sigma, true},
                     {"cy", center_sigma, true},
                     {"p1", options.tangential_sigma, true},
                     {"p2", options.tangential_sigma, true}}};
  std::erase_if(prior.free, [&given](const FreeParameter& parameter) {
    return parameter.sigma == 0 || !HasParameter(given.model, parameter.name);
  });
  return prior;
}

Eigen::MatrixXd PriorInformation(const CameraPrior& prior) {
  Eigen::VectorXd information(prior.num_free());
  for (int i = 0; i < prior.num_free(); ++i) information[i] = std::pow(prior.free[i].sigma, -2);
  return information.asDiagonal();
}

CameraEstimate PriorEstimate(const CameraPrior& prior) {
  Eigen::VectorXd variances(prior.num_free());
  for (int i = 0; i < prior.num_free(); ++i) variances[i] = std::pow(prior.free[i].sigma, 2);
  return {Eigen::VectorXd::Zero(prior.num_free()), variances.asDiagonal(), true};
}

std::vector<FreeParameter> Posterior(std::vector<FreeParameter> free,
                                     const Eigen::MatrixXd& covariance) {
  for (int i = 0; i < static_cast<int>(free.size()); ++i) {
    free[i].sigma = std::sqrt(covariance(i, i));
  }
  return free;
}

double InformationGain(const FreeParameter& parameter, double sigma) {
  return std::max(0.0, 1 - std::pow(sigma / parameter.sigma, 2));
}

double ValueOf(const CameraParameters& camera, const std::string& name) {
  return *FindField(camera, FieldsOf(name).front());
}

}  // namespace corvo
