#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>

#include "vo/map/observation_recorder.h"

namespace corvo {

/// What frames saw, in a temporary file that goes with the object. There is no file before the
/// first.
class ObservationSpool {
 public:
  /// Throws corvo::Error where nothing can be written.
  void Add(const FrameObservations& frame);

  int size() const { return size_; }                    ///< Frames.
  std::size_t num_bytes() const { return num_bytes_; }  ///< Of the file.

  /// Calls `visit` with every frame, in the order in which they came. Throws corvo::Error where the
  /// file cannot be read.
  void ForEach(const ObservationCallback& visit) const;

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::unique_ptr<std::FILE, CloseFile> file_;
  int size_ = 0;
  std::size_t num_bytes_ = 0;
};

}  // namespace corvo
