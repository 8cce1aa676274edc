// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "apps/dataset/image_list.h"
#include "apps/dataset/image_reader.h"
#include "vo/camera/camera_parameters.h"

namespace corvo {

/// The images of one topic of a ROS bag, and their calibration.
struct BagImages {
  std::unique_ptr<ImageReader> reader;
  std::optional<CameraParameters> camera;  ///< Of camera_info beside the topic, if any; valid.
};

/// Returns whether a path is a ROS bag: a .bag file of ROS 1, an .mcap or .db3 file of ROS 2, or
/// its folder with metadata.yaml.
bool IsBag(const std::filesystem::path& input);

/// Opens the topic of `options`. Timestamps are those of the messages' headers, or index / frame
/// rate if that is given. An image that cannot be converted to gray is missing. Throws corvo::Error
/// if this program reads no bags, if the bag is damaged, for an unknown topic, and if none is given
/// and the bag has not exactly one topic of images.
BagImages OpenBag(const std::filesystem::path& bag, const InputOptions& options);

}  // namespace corvo
