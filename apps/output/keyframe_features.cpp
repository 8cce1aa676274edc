// SPDX-License-Identifier: MIT
#include "apps/output/keyframe_features.h"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>

#include <fmt/format.h>

#include "apps/output/binary_data.h"
#include "apps/output/npy_file.h"
#include "orb/error.h"

namespace corvo {
namespace {

constexpr const char* kFeatureFields =
    "('keyframe', '<u4'), ('frame', '<u4'), ('x', '<f4'), ('y', '<f4'), ('octave', 'u1'), "
    "('angle', '<f4'), ('landmark', '<i4'), ('descriptor', 'u1', (32,))";
/// A row without the keyframe and its frame.
constexpr std::size_t kFeatureSize = 4 + 4 + 1 + 4 + 4 + 32;

[[noreturn]] void ThrowFeatureFileError() {
  throw Error(fmt::format("temporary file of features: {}", std::strerror(errno)));
}

std::string FeatureBytes(const Frame& frame, int i) {
  const orb::Keypoint& keypoint = frame.keypoint(i);
  std::string bytes;
  AppendBytes(keypoint.x, bytes);
  AppendBytes(keypoint.y, bytes);
  AppendBytes(static_cast<std::uint8_t>(keypoint.octave), bytes);
  AppendBytes(keypoint.angle_deg, bytes);
  AppendBytes(static_cast<std::int32_t>(frame.landmarks[i]), bytes);
  for (const std::uint8_t byte : frame.descriptor(i).bytes) AppendBytes(byte, bytes);
  return bytes;
}

}  // namespace

void KeyframeFeatureSpool::Update(const Map& map) {
  const bool was_discarded = map.num_keyframes() < num_keyframes_;
  if (was_discarded) num_keyframes_ = 0;
  for (; num_keyframes_ < map.num_keyframes(); ++num_keyframes_) {
    if (map.IsActive(num_keyframes_)) Add(map.keyframe(num_keyframes_).frame);
  }
}

void KeyframeFeatureSpool::Add(const Frame& keyframe) {
  if (!file_) file_.reset(std::tmpfile());
  if (!file_ || std::fseek(file_.get(), 0, SEEK_END) != 0) ThrowFeatureFileError();
  Rows& rows = rows_[keyframe.index];
  rows = {std::ftell(file_.get()), static_cast<std::size_t>(keyframe.num_keypoints())};
  for (int i = 0; i < keyframe.num_keypoints(); ++i) {
    const std::string bytes = FeatureBytes(keyframe, i);
    if (std::fwrite(bytes.data(), bytes.size(), 1, file_.get()) != 1) ThrowFeatureFileError();
  }
}

void KeyframeFeatureSpool::Write(const PoseGraph& graph, const std::filesystem::path& file) const {
  NpyWriter writer(file, kFeatureFields);
  for (const PoseGraphVertex& vertex : graph.vertices) {
    const auto rows = rows_.find(vertex.frame);
    if (rows == rows_.end()) continue;
    if (std::fseek(file_.get(), rows->second.first_byte, SEEK_SET) != 0) ThrowFeatureFileError();
    for (std::size_t i = 0; i < rows->second.count; ++i) {
      std::string row;
      AppendBytes(static_cast<std::uint32_t>(vertex.keyframe), row);
      AppendBytes(static_cast<std::uint32_t>(vertex.frame), row);
      const std::size_t head = row.size();
      row.resize(head + kFeatureSize);
      if (std::fread(row.data() + head, kFeatureSize, 1, file_.get()) != 1) ThrowFeatureFileError();
      writer.Add(row);
    }
  }
  writer.Finish();
}

}  // namespace corvo
