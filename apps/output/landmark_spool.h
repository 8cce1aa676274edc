// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdio>
#include <functional>
#include <memory>

#include "vo/map/map.h"

namespace corvo {

/// Landmarks that have left a map, in a temporary file that goes with the object. There is no file
/// before the first.
class LandmarkSpool {
 public:
  /// Throws corvo::Error where nothing can be written.
  void Add(const MarginalizedLandmark& landmark);

  int size() const { return size_; }
  std::size_t num_bytes() const;  ///< Of the file.

  /// Calls `visit` with every landmark, in the order in which they came. Throws corvo::Error where
  /// the file cannot be read.
  void ForEach(const std::function<void(const MarginalizedLandmark&)>& visit) const;

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::unique_ptr<std::FILE, CloseFile> file_;
  int size_ = 0;
};

}  // namespace corvo
