// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace corvo {

/// The places between which the files of a result move. A result that is staged in full has a
/// manifest in `staged`.
struct ResultPlaces {
  std::filesystem::path folder;  ///< The result folder.
  std::filesystem::path staged;  ///< The new files.
  std::filesystem::path aside;   ///< The earlier files, while the new ones move in.
  std::string manifest;          ///< Name of the manifest.
};

/// Returns the names of the staged files without the manifest.
std::vector<std::string> StagedNames(const ResultPlaces& places);

/// Moves the staged result into the folder; the manifest leaves the folder first and enters it
/// last. Files of an earlier result that the new manifest does not list are removed. If it cannot,
/// undoes what it has moved and throws corvo::Error; `is_torn` is then set if undoing failed, too.
void MoveIn(const ResultPlaces& places, bool& is_torn);

}  // namespace corvo
