// SPDX-License-Identifier: MIT
#include "apps/dataset/camera_formats/camera_formats.h"
#include "apps/dataset/camera_formats/document_fields.h"

namespace corvo {
namespace {

/// The values of the section "Camera", or of the keys "Camera.<key>" in the form of OpenVSLAM.
class CameraSection {
 public:
  explicit CameraSection(const CalibrationContent& content)
      : root_(content.root(), content.where()),
        section_(root_.Section("Camera")),
        is_nested_(section_.Has("model")) {}

  bool exists() const { return is_nested_ || root_.Has("Camera.model"); }
  const DocumentFields& fields() const { return is_nested_ ? section_ : root_; }
  std::string Key(const std::string& key) const { return is_nested_ ? key : "Camera." + key; }
  double Number(const std::string& key) const { return fields().Number(Key(key)); }
  /// Returns the start of messages about a value.
  std::string Field(const std::string& key) const { return fields().where() + Key(key); }

  std::vector<double> Coefficients(std::span<const char* const> keys) const {
    std::vector<double> values;
    for (const char* key : keys) {
      values.push_back(fields().FindNumber(Key(key)).value_or(0));
    }
    return values;
  }

 private:
  DocumentFields root_;
  DocumentFields section_;
  bool is_nested_;
};

void SetStellaDistortion(const CameraSection& section, CameraParameters& camera) {
  const std::string model = section.fields().Text(section.Key("model"));
  if (model == "perspective") {
    const std::span<const char* const> keys(kOpenCvCoefficients, 5);
    SetDistortion(keys, section.Coefficients(keys), section.Field("model"), model, camera);
  } else if (model == "fisheye") {
    camera.model = CameraModel::kKb4;
    SetDistortion(kFisheyeCoefficients, section.Coefficients(kFisheyeCoefficients),
                  section.Field("model"), model, camera);
  } else {
    ThrowUnknownModel(section.Field("model"), model, "perspective and fisheye");
  }
}

}  // namespace

std::vector<std::string> StellaCameras(const CalibrationContent& content) {
  if (!CameraSection(content).exists()) return {};
  return {""};
}

StatedCamera ReadStellaCamera(const CalibrationContent& content, const std::string& /*name*/) {
  const CameraSection section(content);
  StatedCamera stated{{}, {}, content.where()};
  SetStellaDistortion(section, stated.parameters);
  SetIntrinsics(
      {section.Number("fx"), section.Number("fy"), section.Number("cx"), section.Number("cy")},
      stated.parameters);
  if (section.fields().Has(section.Key("cols"))) {
    SetSize({section.Number("cols"), section.Number("rows")}, section.Field("cols, rows"),
            stated.parameters);
  }
  stated.frame_rate_hz = StatedFrameRate(section.fields(), section.Key("fps"));
  return stated;
}

}  // namespace corvo
