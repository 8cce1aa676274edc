// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "vo/map/observation_callback.h"

namespace corvo {

/// Stores the observations of a sequence's frames in a temporary file, which exists as long as the
/// object or a callback does, for adjustments of the whole sequence:
///
///     ObservationLog log;
///     odometry.SetObservationCallback(log.Callback());
///     ... // Process all images, and Finish.
///     const Refinement refinement = Refine(odometry, log);
class ObservationLog {
 public:
  ObservationLog();
  ~ObservationLog();
  ObservationLog(ObservationLog&&) noexcept;
  ObservationLog& operator=(ObservationLog&&) noexcept;

  /// Returns a callback that adds to the log. The first report of a new map clears the log of those
  /// of the map before. The callback may outlive the log. It throws corvo::Error if the
  /// file cannot be written.
  ObservationCallback Callback();

  int size() const;               ///< Number of frames and keyframes reported.
  std::size_t num_bytes() const;  ///< Size of the file.

  /// Calls `visit` with every report of the last map, in order. Throws corvo::Error if the
  /// file cannot be read.
  void Visit(const ObservationCallback& visit) const;

 private:
  class File;
  std::shared_ptr<File> file_;
};

}  // namespace corvo
