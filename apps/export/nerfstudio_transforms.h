// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "apps/export/reconstruction.h"

namespace corvo {

/// Returns transforms.json as nerfstudio and other trainers of radiance fields read it
/// (https://docs.nerf.studio/quickstart/data_conventions.html): the intrinsics, and for each image
/// its path and its world_from_camera with OpenGL's axes (x right, y up, z backward). The world is
/// turned so that the first camera's up is +z. `ply_file` names the point cloud, in the same world.
/// Throws corvo::Error if nerfstudio has no equivalent of the camera model (fov).
nlohmann::ordered_json ToTransforms(const Reconstruction& reconstruction,
                                    const std::string& image_folder, const std::string& ply_file);

/// Returns the rotation of the world in ToTransforms(), to be applied to the points.
SO3 TransformsFromWorld(const Reconstruction& reconstruction);

}  // namespace corvo
