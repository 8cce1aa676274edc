// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>

#include "apps/output/temporary_file.h"
#include "vo/map/map.h"
#include "vo/map/pose_graph.h"

namespace corvo {

/// Stores the features of keyframes in a temporary file, which is created with the first keyframe
/// and deleted with the object.
class KeyframeFeatureSpool {
 public:
  /// Stores the keyframes that were inserted into the map since the last call. To be called after
  /// each frame. Throws corvo::Error if the file cannot be written.
  void Update(const Map& map);

  /// Writes the features of the keyframes of a graph as a structured array with the fields
  /// keyframe, frame (<u4), x, y (<f4: the detected pixel, integers are pixel centers), octave
  /// (u1), angle (<f4, degrees), landmark (<i4, that the feature observed when the keyframe was
  /// inserted, or -1), descriptor (32 u1), in ascending order of keyframes. See NpyWriter. Throws
  /// corvo::Error if a file cannot be read or written.
  void Write(const PoseGraph& graph, const std::filesystem::path& file) const;

 private:
  /// The place of a keyframe's features in the file.
  struct Rows {
    long first_byte = 0;
    std::size_t count = 0;
  };

  void Add(const Frame& keyframe);

  TemporaryFile file_;
  std::map<int, Rows> rows_;  // By the index of the frame.
  int num_keyframes_ = 0;     // Of the map, at the last call.
};

}  // namespace corvo
