// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "apps/dataset/image_source.h"
#include "apps/run/image_names.h"
#include "apps/run/run_inputs.h"

namespace corvo {

/// Reads the summary.json of a result. Throws corvo::Error if it is missing or damaged.
nlohmann::json ReadSummary(const std::filesystem::path& result);

/// Returns those arguments of a run that say which images it read and how, as its summary has them;
/// the camera is that of the result. Throws corvo::Error if a member has another type.
RunArguments InputArguments(const std::filesystem::path& result, const nlohmann::json& summary);

/// The images of a finished run, read again from its input and prepared as they were for it.
class ResultImages {
 public:
  /// Throws corvo::Error if the result or its input cannot be read, or was a live camera.
  explicit ResultImages(const std::filesystem::path& result)
      : ResultImages(InputArguments(result, ReadSummary(result))) {}

  /// Returns the next image, or std::nullopt after the last. It may be missing.
  std::optional<TimedImage> Next() { return source_.Next(); }

  /// Returns the name of an image as in frames.csv.
  std::string NameOf(const TimedImage& image) const { return names_.Of(image); }

 private:
  explicit ResultImages(const RunArguments& arguments);

  ImageSource source_;
  ImageNames names_;
};

}  // namespace corvo
