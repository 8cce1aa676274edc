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

/// Returns a camera of 640x480 px with f = 500 px and without distortion.
Camera PinholeCamera();

/// Returns a model of PinholeCamera() with a keypoint standard deviation of `sigma_px` and
/// `num_octaves` pyramid levels at a scale factor of 1.2.
MeasurementModel MakeModel(double sigma_px = 1, int num_octaves = 8);

/// Like MakeModel() above, but for another camera.
MeasurementModel MakeModel(const Camera& camera, double sigma_px = 1, int num_octaves = 8);

/// Points in space, each with its own descriptor. Views of them replace an extractor's features, so
/// that no images are needed.
struct PointScene {
  std::vector<Eigen::Vector3d> in_world;
  std::vector<orb::Descriptor> descriptors;
};

orb::Descriptor RandomDescriptor(Random& random);

/// Returns the descriptor with `num_bits` different bits flipped.
orb::Descriptor FlipBits(orb::Descriptor descriptor, int num_bits, Random& random);

/// Returns `num_points` points spread over a box of depth [min_depth, max_depth] that fills the
/// view of PinholeCamera() at the world origin and somewhat more.
PointScene MakeBoxScene(int num_points, double min_depth, double max_depth, Random& random);

/// Like MakeBoxScene(), but on the slanted plane z = depth + 0.3 x.
PointScene MakePlaneScene(int num_points, double depth, Random& random);

/// A frame and, for each of its keypoints, the index of the scene's point that it observes.
struct SceneView {
  Frame frame;  ///< Its world_from_camera is the ground truth.
  std::vector<int> points;
};

/// Returns the observations of a camera: pixels with Gaussian noise of `sigma_px`, descriptors with
/// a few bits flipped, all in octave 0. The order of the keypoints starts at a random point.
SceneView ObserveScene(const PointScene& scene, const Camera& camera, const SE3& world_from_camera,
                       double sigma_px, Random& random);

/// Returns a map of the views as keyframes in one segment. Every point that is visible in at least
/// two views is a landmark at its true position. Landmark ids are in the order of the scene's
/// points.
Map MakeMap(const PointScene& scene, const std::vector<SceneView>& views,
            const MeasurementModel& model = MakeModel());

}  // namespace corvo::test
