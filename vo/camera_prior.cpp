#include "vo/camera_prior.h"

#include <cmath>
#include <set>

#include "orb/error.h"

namespace corvo {
namespace {

constexpr const char* kFocal = "focal";

/// The field of that name; null if there is none that an adjustment may move.
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

}  // namespace

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
                        : *FindField(camera, free[i].name) - *FindField(given, free[i].name);
  }
  return difference;
}

double CameraPrior::SquaredError(const Eigen::VectorXd& difference) const {
  double sum = 0;
  for (int i = 0; i < num_free(); ++i) sum += std::pow(difference[i] / free[i].sigma, 2);
  return sum;
}

}  // namespace corvo
