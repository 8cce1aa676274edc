// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

#include "apps/output/temporary_file.h"
#include "vo/map/map.h"

namespace corvo {

/// Stores landmarks that were removed from a map in a temporary file, which is created with the
/// first landmark and deleted with the object.
class LandmarkSpool {
 public:
  /// Appends a landmark. Throws corvo::Error if the file cannot be written.
  void Add(const MarginalizedLandmark& landmark);

  int size() const { return size_; }
  std::size_t num_bytes() const;  ///< Size of the file.

  /// Calls `visit` for every landmark, in the order of their addition. Throws corvo::Error if the
  /// file cannot be read.
  void ForEach(const std::function<void(const MarginalizedLandmark&)>& visit) const;

 private:
  TemporaryFile file_;
  int size_ = 0;
};

}  // namespace corvo
