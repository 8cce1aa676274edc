// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "orb/types.h"
#include "tests/support/random.h"
#include "vo/camera/camera.h"
#include "vo/map/frame.h"
#include "vo/map/map.h"
#include "vo/map/measurement_model.h"

namespace corvo::test {

/// 640x480, f = 500 px, without distortion.
Camera PinholeCamera();

/// The PinholeCamera with keypoints of `sigma_px` in every octave of `num_octaves` levels at 1.2.
MeasurementModel MakeModel(double sigma_px = 1, int num_octaves = 8);

/// The same for another camera.
MeasurementModel MakeModel(const Camera& camera, double sigma_px = 1, int num_octaves = 8);

/// Points in space, each with a descriptor of its own: views of them as an extractor would see
/// them, without images.
struct PointScene {
  std::vector<Eigen::Vector3d> in_world;
  std::vector<orb::Descriptor> descriptors;
};

orb::Descriptor RandomDescriptor(Random& random);

/// The same descriptor with `num_bits` different bits flipped.
orb::Descriptor FlipBits(orb::Descriptor descriptor, int num_bits, Random& random);

/// `num_points` points spread over a box of depth [min_depth, max_depth] that fills the view of
/// PinholeCamera at the world's origin and somewhat more.
PointScene MakeBoxScene(int num_points, double min_depth, double max_depth, Random& random);

/// As MakeBoxScene on the slanted plane z = depth + 0.3 x.
PointScene MakePlaneScene(int num_points, double depth, Random& random);

/// A frame and the scene's point behind each of its keypoints.
struct SceneView {
  Frame frame;  ///< Its world_from_camera is the truth.
  std::vector<int> points;
};

/// What the camera sees, each pixel with Gaussian noise of `sigma_px`, each descriptor with a few
/// bits flipped, all in octave 0. Keypoints come in an order of their own.
SceneView ObserveScene(const PointScene& scene, const Camera& camera, const SE3& world_from_camera,
                       double sigma_px, Random& random);

/// A map of the views as keyframes in one segment, with every point that at least two see as a
/// landmark at its true place. Landmark ids follow the scene's points.
Map MakeMap(const PointScene& scene, const std::vector<SceneView>& views,
            const MeasurementModel& model = MakeModel());

}  // namespace corvo::test
