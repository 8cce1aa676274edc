// SPDX-License-Identifier: MIT
#include "apps/export/colmap_model.h"

#include <cstdint>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "apps/export/colmap_camera.h"
#include "apps/output/binary_data.h"
#include "vo/camera/camera.h"

namespace corvo {
namespace {

/// An observation from the point's side.
struct TrackEntry {
  int image_id = 0;
  int observation = 0;  ///< Index into the image's observations.
};

/// The tracks and mean reprojection errors of all points.
struct Tracks {
  std::vector<std::vector<TrackEntry>> entries;
  std::vector<double> mean_errors_px;
};

/// Returns the distance between an observation and the projection of its point; 0 where the point
/// has no projection.
double ReprojectionError(const Camera& camera, const SE3& camera_from_world,
                         const PointObservation& observation, const ReconstructedPoint& point) {
  const auto pixel = camera.Project(camera_from_world * point.in_world);
  return pixel ? (*pixel - observation.pixel).norm() : 0;
}

Tracks CollectTracks(const Reconstruction& reconstruction) {
  const Camera camera(reconstruction.camera);
  Tracks tracks;
  tracks.entries.resize(reconstruction.points.size());
  tracks.mean_errors_px.resize(reconstruction.points.size());
  for (int i = 0; i < static_cast<int>(reconstruction.images.size()); ++i) {
    const ReconstructedImage& image = reconstruction.images[i];
    const SE3 camera_from_world = image.world_from_camera.Inverse();
    for (int k = 0; k < static_cast<int>(image.observations.size()); ++k) {
      const PointObservation& observation = image.observations[k];
      tracks.entries[observation.point].push_back({i + 1, k});
      tracks.mean_errors_px[observation.point] += ReprojectionError(
          camera, camera_from_world, observation, reconstruction.points[observation.point]);
    }
  }
  for (std::size_t i = 0; i < tracks.entries.size(); ++i) {
    if (!tracks.entries[i].empty()) {
      tracks.mean_errors_px[i] /= static_cast<double>(tracks.entries[i].size());
    }
  }
  return tracks;
}

std::int64_t PointId(const Reconstruction& reconstruction, int point) {
  return std::int64_t{reconstruction.points[point].id} + 1;
}

std::string CamerasText(const CameraParameters& camera) {
  const ColmapCamera colmap = ToColmap(camera);
  return fmt::format("# CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]\n1 {} {} {} {}\n", colmap.model,
                     camera.width, camera.height, fmt::join(colmap.parameters, " "));
}

std::string ImagesText(const Reconstruction& reconstruction) {
  std::string text =
      "# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME\n# POINTS2D[] as (X, Y, POINT3D_ID)\n";
  int id = 0;
  for (const ReconstructedImage& image : reconstruction.images) {
    const SE3 pose = image.world_from_camera.Inverse();
    // Adding zero makes a negative zero positive.
    const Eigen::Vector4d q = pose.rotation().quaternion().coeffs().array() + 0.0;
    const Eigen::Vector3d t = pose.translation().array() + 0.0;
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {} {} {} {} 1 {}\n", ++id, q.w(), q.x(),
                   q.y(), q.z(), t.x(), t.y(), t.z(), image.name);
    const char* separator = "";
    for (const PointObservation& o : image.observations) {
      fmt::format_to(std::back_inserter(text), "{}{} {} {}", separator, o.pixel.x() + 0.5,
                     o.pixel.y() + 0.5, PointId(reconstruction, o.point));
      separator = " ";
    }
    text += '\n';
  }
  return text;
}

std::string PointsText(const Reconstruction& reconstruction) {
  const Tracks tracks = CollectTracks(reconstruction);
  std::string text =
      "# POINT3D_ID X Y Z R G B ERROR TRACK[] as (IMAGE_ID, POINT2D_IDX), indices from 0\n";
  for (std::size_t i = 0; i < reconstruction.points.size(); ++i) {
    const ReconstructedPoint& point = reconstruction.points[i];
    const Eigen::Vector3d& x = point.in_world;
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {} {} {} {}",
                   PointId(reconstruction, static_cast<int>(i)), x.x(), x.y(), x.z(), point.rgb[0],
                   point.rgb[1], point.rgb[2], tracks.mean_errors_px[i]);
    for (const TrackEntry& entry : tracks.entries[i]) {
      fmt::format_to(std::back_inserter(text), " {} {}", entry.image_id, entry.observation);
    }
    text += '\n';
  }
  return text;
}

/// Appends the bytes of numbers.
class Bytes {
 public:
  template <typename T>
  void Add(T value) {
    AppendBytes(value, bytes_);
  }
  void Add(const Eigen::Vector3d& v) {
    for (int i = 0; i < 3; ++i) Add(v[i]);
  }
  /// Appends a string and its terminating zero.
  void AddString(const std::string& text) { bytes_.append(text.c_str(), text.size() + 1); }

  std::string Take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

std::string CamerasBinary(const CameraParameters& camera) {
  const ColmapCamera colmap = ToColmap(camera);
  Bytes bytes;
  bytes.Add(std::uint64_t{1});
  bytes.Add(std::int32_t{1});
  bytes.Add(std::int32_t{colmap.model_id});
  bytes.Add(static_cast<std::uint64_t>(camera.width));
  bytes.Add(static_cast<std::uint64_t>(camera.height));
  for (const double parameter : colmap.parameters) bytes.Add(parameter);
  return bytes.Take();
}

std::string ImagesBinary(const Reconstruction& reconstruction) {
  Bytes bytes;
  bytes.Add(std::uint64_t{reconstruction.images.size()});
  std::int32_t id = 0;
  for (const ReconstructedImage& image : reconstruction.images) {
    const SE3 pose = image.world_from_camera.Inverse();
    const Eigen::Quaterniond& q = pose.rotation().quaternion();
    bytes.Add(++id);
    for (const double value : {q.w(), q.x(), q.y(), q.z()}) bytes.Add(value);
    bytes.Add(pose.translation());
    bytes.Add(std::int32_t{1});
    bytes.AddString(image.name);
    bytes.Add(std::uint64_t{image.observations.size()});
    for (const PointObservation& o : image.observations) {
      bytes.Add(o.pixel.x() + 0.5);
      bytes.Add(o.pixel.y() + 0.5);
      bytes.Add(PointId(reconstruction, o.point));
    }
  }
  return bytes.Take();
}

std::string PointsBinary(const Reconstruction& reconstruction) {
  const Tracks tracks = CollectTracks(reconstruction);
  Bytes bytes;
  bytes.Add(std::uint64_t{reconstruction.points.size()});
  for (std::size_t i = 0; i < reconstruction.points.size(); ++i) {
    const ReconstructedPoint& point = reconstruction.points[i];
    bytes.Add(PointId(reconstruction, static_cast<int>(i)));
    bytes.Add(point.in_world);
    for (const std::uint8_t channel : point.rgb) bytes.Add(channel);
    bytes.Add(tracks.mean_errors_px[i]);
    bytes.Add(std::uint64_t{tracks.entries[i].size()});
    for (const TrackEntry& entry : tracks.entries[i]) {
      bytes.Add(std::int32_t{entry.image_id});
      bytes.Add(std::int32_t{entry.observation});
    }
  }
  return bytes.Take();
}

}  // namespace

ColmapModel ToColmapText(const Reconstruction& reconstruction) {
  return {CamerasText(reconstruction.camera), ImagesText(reconstruction),
          PointsText(reconstruction)};
}

ColmapModel ToColmapBinary(const Reconstruction& reconstruction) {
  return {CamerasBinary(reconstruction.camera), ImagesBinary(reconstruction),
          PointsBinary(reconstruction)};
}

}  // namespace corvo
