// SPDX-License-Identifier: MIT
#include "vo/io/config.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <map>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "orb/error.h"
#include "vo/core/option_fields.h"
#include "vo/io/file_bytes.h"
#include "vo/io/nearest_name.h"
#include "vo/io/yaml_document.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Returns "<file>:<line>: ", with lines counted from 1.
std::string Where(const fs::path& file, const YAML::Mark& mark) {
  if (mark.is_null()) return fmt::format("{}: ", file.string());
  return fmt::format("{}:{}: ", file.string(), mark.line + 1);
}

/// Keys of version 0.1 and their replacements.
const std::map<std::string, std::string> kMovedKeys = {
    {"bundle_adjuster.aligned_sigma_px", "measurement.aligned_sigma_px"},
    {"bundle_adjuster.keypoint_sigma_px", "measurement.keypoint_sigma_px"},
    {"keyframes.max_distance", "matching.max_distance"},
    {"keyframes.min_parallax_deg", "landmarks.min_parallax_deg"},
    {"keyframes.num_neighbors", "landmarks.num_neighbors"},
    {"tracker.max_distance", "matching.max_tracking_distance"},
    {"bundle_adjuster.min_shared_landmarks", "BundleAdjusterOptions::min_shared_landmarks in C++"},
    {"bundle_adjuster.points_per_keyframe", "BundleAdjusterOptions::points_per_keyframe in C++"},
    {"calibration.max_iterations", "CalibrationOptions::max_iterations in C++"},
    {"calibration.max_keyframes", "CalibrationOptions::max_keyframes in C++"},
    {"calibration.points_per_keyframe", "CalibrationOptions::points_per_keyframe in C++"},
    {"initializer.max_homography_share", "InitializerOptions::max_homography_share in C++"},
    {"initializer.min_parallax_sigmas", "InitializerOptions::min_parallax_sigmas in C++"},
    {"initializer.min_points", "InitializerOptions::min_points in C++"},
    {"keyframes.max_redundant_share", "CullingOptions::max_redundant_share in C++"},
    {"keyframes.min_found_share", "CullingOptions::min_found_share in C++"},
    {"keyframes.min_seeing_share", "KeyframeOptions::min_seeing_share in C++"},
    {"relocalizer.max_candidates", "RelocalizerOptions::max_candidates in C++"},
    {"relocalizer.min_inliers", "RelocalizerOptions::min_inliers in C++"},
    {"tracker.max_local_keyframes", "TrackerOptions::max_local_keyframes in C++"},
    {"tracker.max_ratio", "TrackerOptions::max_ratio in C++"},
    {"tracker.min_matches", "TrackerOptions::min_matches in C++"},
};

/// A mapping in a file. Errors name keys with their section before them.
class Section {
 public:
  /// `name` is empty for the file's top-level keys. Throws corvo::Error unless `node` is a mapping
  /// or empty.
  Section(const fs::path& file, std::string name, const YAML::Node& node)
      : file_(file), name_(std::move(name)), node_(node) {
    if (node.IsMap() || node.IsNull()) return;
    throw Error(fmt::format("{}{} must hold \"key: value\" lines", Where(file_, node.Mark()),
                            name_.empty() ? "the file" : name_));
  }

  /// Throws corvo::Error if a key is given twice or is not among `known`.
  void CheckKeys(const std::vector<std::string>& known) const {
    std::set<std::string> seen;
    for (const auto& entry : node_) {
      const std::string where = Where(file_, entry.first.Mark());
      if (!entry.first.IsScalar()) throw Error(where + "a key must be a word");
      const std::string& key = entry.first.Scalar();
      if (!seen.insert(key).second) throw Error(where + Named(key) + " is given twice");
      if (std::find(known.begin(), known.end(), key) != known.end()) continue;
      if (const auto moved = kMovedKeys.find(Named(key)); moved != kMovedKeys.end()) {
        throw Error(fmt::format("{}the key {} is now {}", where, Named(key), moved->second));
      }
      throw Error(fmt::format("{}unknown key {}; the nearest known key is {}", where, Named(key),
                              Named(NearestName(key, known))));
    }
  }

  /// Returns the value of a key, or an undefined node if the key is left out.
  YAML::Node Find(const std::string& key) const {
    for (const auto& entry : node_) {
      if (entry.first.Scalar() == key) return entry.second;
    }
    return YAML::Node(YAML::NodeType::Undefined);
  }

  /// Like Find(), but throws corvo::Error if the key is left out.
  YAML::Node Require(const std::string& key) const {
    const YAML::Node value = Find(key);
    if (value.IsDefined()) return value;
    throw Error(fmt::format("{}: {} is missing", file_.string(), Named(key)));
  }

  std::string Named(const std::string& key) const {
    return name_.empty() ? key : name_ + "." + key;
  }

  /// Returns "<file>:<line>: <key>", the start of an error about a key that is in the file.
  std::string Start(const std::string& key) const {
    for (const auto& entry : node_) {
      if (entry.first.Scalar() == key) return Where(file_, entry.first.Mark()) + Named(key);
    }
    return Where(file_, node_.Mark()) + Named(key);
  }

  const fs::path& file() const { return file_; }

 private:
  fs::path file_;
  std::string name_;
  YAML::Node node_;
};

// Each Parse() sets the value of a plain scalar, or returns false if the text is not of the type.

template <typename Number>
requires std::integral<Number> || std::floating_point<Number>
bool Parse(std::string_view text, Number& value) {
  const char* end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && parsed == end;
}

bool Parse(std::string_view text, bool& value) {
  value = text == "true";
  return value || text == "false";
}

bool Parse(std::string_view text, orb::Ranking& value) {
  try {
    value = orb::ParseRanking(text);
    return true;
  } catch (const Error&) {
    return false;
  }
}

bool Parse(std::string_view text, std::string& value) {
  value = text;
  return !text.empty();
}

/// Returns the allowed values, or an empty string if only the field's meaning states them.
template <typename T>
std::string_view TypeName() {
  if constexpr (std::is_same_v<T, bool>) return "true or false";
  if constexpr (std::integral<T>) return "a whole number";
  if constexpr (std::floating_point<T>) return "a number";
  return "";
}

/// Returns a scalar as YAML writes it, quoted if necessary.
std::string Quoted(const std::string& text) {
  YAML::Emitter emitter;
  emitter << text;
  return emitter.c_str();
}

template <typename T>
std::string Print(const T& value) {
  if constexpr (std::is_enum_v<T>) return std::string(ToString(value));
  if constexpr (std::is_same_v<T, std::string>) return Quoted(value);
  if constexpr (std::is_arithmetic_v<T>) return fmt::format("{}", value);
}

/// Returns a value as errors print it.
std::string Describe(const YAML::Node& node) {
  if (node.IsScalar()) return fmt::format("\"{}\"", node.Scalar());
  return node.IsNull() ? "empty" : "a list or mapping";
}

/// Reads the fields that a Visit() names from a section; fields that are left out keep their
/// values.
class FieldReader {
 public:
  explicit FieldReader(const Section& section) : section_(section) {}

  template <typename T>
  void operator()(const char* name, T& value, const std::type_identity_t<T>& min,
                  const std::type_identity_t<T>& max, const char* /*meaning*/) const {
    const YAML::Node node = section_.Find(name);
    if (!node.IsDefined()) return;
    ReadScalar(name, node, value, TypeName<T>());
    CheckRange(section_.Start(name), value, min, max);
  }

  template <typename T>
  void operator()(const char* name, T& value, const char* meaning) const {
    const YAML::Node node = section_.Find(name);
    if (!node.IsDefined()) return;
    ReadScalar(name, node, value, TypeName<T>().empty() ? meaning : TypeName<T>());
  }

 private:
  template <typename T>
  void ReadScalar(const char* name, const YAML::Node& node, T& value,
                  std::string_view allowed) const {
    const bool quoted = node.Tag() == "!" && !std::is_same_v<T, std::string>;
    if (node.IsScalar() && !quoted && Parse(node.Scalar(), value)) return;
    throw Error(
        fmt::format("{} is {}; allowed is {}", section_.Start(name), Describe(node), allowed));
  }

  const Section& section_;
};

/// Collects the names of the fields of a Visit().
struct NameCollector {
  std::vector<std::string>& names;

  template <typename... Rest>
  void operator()(const char* name, const Rest&...) const {
    names.emplace_back(name);
  }
};

template <typename Fields>
std::vector<std::string> FieldNames(const Fields& fields) {
  std::vector<std::string> names;
  VisitFileFields(fields, NameCollector{names});
  return names;
}

/// Writes "# meaning; range" and "name: value" for each field of a Visit().
class FieldWriter {
 public:
  FieldWriter(std::string indent, std::string& text) : indent_(std::move(indent)), text_(text) {}

  template <typename T>
  void operator()(const char* name, const T& value, const std::type_identity_t<T>& min,
                  const std::type_identity_t<T>& max, const char* meaning) const {
    text_ += fmt::format("{0}# {1} [{2} to {3}]\n{0}{4}: {5}\n", indent_, meaning, min, max, name,
                         value);
  }

  template <typename T>
  void operator()(const char* name, const T& value, const char* meaning) const {
    text_ += fmt::format("{0}# {1}\n{0}{2}: {3}\n", indent_, meaning, name, Print(value));
  }

 private:
  std::string indent_;
  std::string& text_;
};

std::vector<std::string> SectionNames(const OdometryOptions& options) {
  std::vector<std::string> names;
  OdometryOptions::VisitSections(options, [&](const char* name, const auto& fields) {
    if (!FieldNames(fields).empty()) names.emplace_back(name);
  });
  return names;
}

std::string ReadText(const Section& section, const std::string& key) {
  const YAML::Node node = section.Find(key);
  if (!node.IsDefined()) return "";
  if (node.IsScalar()) return node.Scalar();
  throw Error(section.Start(key) + " must be text");
}

CameraModel ReadModel(const Section& section) {
  section.Require("model");
  try {
    return ParseCameraModel(ReadText(section, "model"));
  } catch (const Error& error) {
    throw Error(section.Start("model") + ": " + error.what());
  }
}

Camera MakeCamera(const CameraParameters& parameters, const fs::path& file) {
  try {
    return Camera(parameters);
  } catch (const Error& error) {
    throw Error(file.string() + ": " + error.what());
  }
}

std::optional<double> ReadFrameRate(const Section& section) {
  constexpr const char* kKey = "frame_rate_hz";
  if (!section.Find(kKey).IsDefined()) return std::nullopt;
  double frame_rate_hz = 0;
  FieldReader{section}(kKey, frame_rate_hz, kMinFrameRateHz, kMaxFrameRateHz, "");
  return frame_rate_hz;
}

constexpr const char* kSigma = "sigma";
constexpr double kMinSigma = 1e-12;
constexpr double kMaxSigma = 1e6;

std::optional<std::vector<FreeParameter>> ReadSigma(const Section& root,
                                                    const CameraParameters& parameters) {
  const YAML::Node node = root.Find(kSigma);
  if (!node.IsDefined()) return std::nullopt;
  const Section section(root.file(), kSigma, node);
  const std::vector<std::string> names = FreeParameterNames(parameters.model);
  section.CheckKeys(names);
  CameraPrior prior{parameters, {}};
  for (const std::string& name : names) {
    if (!section.Find(name).IsDefined()) continue;
    prior.free.push_back({name, 0});
    FieldReader{section}(name.c_str(), prior.free.back().sigma, kMinSigma, kMaxSigma, "");
  }
  try {
    prior.Validate();
  } catch (const Error& error) {
    throw Error(root.Start(kSigma) + ": " + error.what());
  }
  return prior.free;
}

std::string SigmaText(const std::vector<FreeParameter>& sigma) {
  std::string text =
      "# standard deviations of what is not known exactly; focal: as a share\nsigma:";
  if (sigma.empty()) return text + " {}\n";
  text += "\n";
  for (const FreeParameter& parameter : sigma) {
    text += fmt::format("  {}: {}\n", parameter.name, parameter.sigma);
  }
  return text;
}

/// Returns the options of a configuration file, which error messages name.
OdometryOptions OptionsOf(const YAML::Node& document, const fs::path& file) {
  OdometryOptions options;
  const Section root(file, "", document);
  root.CheckKeys(SectionNames(options));
  OdometryOptions::VisitSections(options, [&root](const char* name, auto& fields) {
    const YAML::Node node = root.Find(name);
    if (!node.IsDefined()) return;
    const Section section(root.file(), name, node);
    section.CheckKeys(FieldNames(fields));
    VisitFileFields(fields, FieldReader(section));
  });
  try {
    options.Validate();
  } catch (const Error& error) {
    throw Error(file.string() + ": " + error.what());
  }
  return options;
}

}  // namespace

CameraPrior CameraFile::Prior(const CalibrationOptions& options) const {
  if (!sigma) return MakePrior(camera.parameters(), options);
  return {camera.parameters(), *sigma};
}

OdometryOptions ReadOptions(const fs::path& file) { return OptionsOf(ReadYaml(file), file); }

OdometryOptions ParseOptions(const std::string& text, const fs::path& file) {
  return OptionsOf(ParseYaml(text, file), file);
}

std::string WriteOptions(const OdometryOptions& options) {
  std::string text = "# Options of corvo. Keys left out keep their defaults.\n";
  OdometryOptions::VisitSections(options, [&text](const char* name, const auto& fields) {
    if (FieldNames(fields).empty()) return;
    text += fmt::format("\n{}:\n", name);
    VisitFileFields(fields, FieldWriter("  ", text));
  });
  return text;
}

CameraFile ReadCameraFile(const fs::path& file) {
  return ParseCameraFile(ReadFileBytes(file, kMaxYamlBytes), file);
}

CameraFile ParseCameraFile(const std::string& text, const fs::path& file) {
  CameraParameters parameters;
  const Section root(file, "", ParseYaml(text, file));
  std::vector<std::string> known = {"model", "frame_rate_hz", "source", kSigma};
  CameraParameters::VisitAll(parameters, NameCollector{known});
  root.CheckKeys(known);
  parameters.model = ReadModel(root);
  for (const char* key : {"width", "height", "fx", "fy", "cx", "cy"}) root.Require(key);
  CameraParameters::VisitAll(parameters, FieldReader(root));
  return {MakeCamera(parameters, file), ReadFrameRate(root), ReadText(root, "source"),
          ReadSigma(root, parameters)};
}

std::string WriteCameraFile(const CameraFile& camera_file) {
  const CameraParameters& parameters = camera_file.camera.parameters();
  std::string text = fmt::format("model: {}\n", ToString(parameters.model));
  if (!camera_file.source.empty()) text += "source: " + Quoted(camera_file.source) + "\n";
  CameraParameters::Visit(parameters, FieldWriter("", text));
  if (camera_file.frame_rate_hz) {
    FieldWriter("", text)("frame_rate_hz", *camera_file.frame_rate_hz, kMinFrameRateHz,
                          kMaxFrameRateHz, "images a second");
  }
  if (camera_file.sigma) text += SigmaText(*camera_file.sigma);
  return text;
}

}  // namespace corvo
