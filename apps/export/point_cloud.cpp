// SPDX-License-Identifier: MIT
#include "apps/export/point_cloud.h"

#include <fmt/format.h>

namespace corvo {

std::string ToPointCloud(const std::vector<ReconstructedPoint>& points,
                         const SO3& cloud_from_world) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\n"
      "property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nend_header\n",
      points.size());
  for (const ReconstructedPoint& point : points) {
    const Eigen::Vector3f position = (cloud_from_world * point.in_world).cast<float>();
    bytes.append(reinterpret_cast<const char*>(position.data()), 3 * sizeof(float));
    bytes.append(reinterpret_cast<const char*>(point.rgb.data()), point.rgb.size());
  }
  return bytes;
}

}  // namespace corvo
