// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "apps/output/npy_file.h"
#include "vo/core/conventions.h"

namespace corvo {

/// One row of observations.npy: a landmark observed in a frame, 18 bytes.
struct ObservationRow {
  int frame = 0;                ///< Index of the input frame.
  LandmarkId landmark = kNoId;  ///< As in map.ply.
  float x = 0, y = 0;           ///< Pixel in the processed image; integers are pixel centers.
  float sigma_px = 1;           ///< Standard deviation along each axis, in half precision.
};

/// Writes rows with the fields frame (<u4), landmark (<u4), x, y (<f4), sigma (<f2), in ascending
/// order of frames. See NpyWriter.
class ObservationWriter {
 public:
  /// Throws corvo::Error if the file cannot be created.
  explicit ObservationWriter(const std::filesystem::path& file);

  void Add(const ObservationRow& row);
  /// Completes the file. Throws corvo::Error if it could not be written as a whole.
  void Finish();

 private:
  NpyWriter file_;
};

/// Reads the rows of a file of ObservationWriter. Throws corvo::Error if `file` cannot be read or
/// is not such a file.
std::vector<ObservationRow> ReadObservations(const std::filesystem::path& file);

}  // namespace corvo
