// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "tests/support/point_scene.h"
#include "vo/optimization/bundle.h"

namespace corvo::test {

/// Makes a bundle of all observations of a scene of points by a camera on a winding path, with
/// Gaussian noise on the pixels; poses and points are the true ones.
inline Bundle MakeObservedBundle(const Camera& camera, int num_views, double noise_px,
                                 Random& random) {
  const PointScene scene = MakeBoxScene(600, 6, 30, random);
  std::vector<SceneView> views;
  for (int i = 0; i < num_views; ++i) {
    const SE3 pose(SO3::Exp({0.02 * std::sin(i), 0.06 * i - 0.3, 0.03 * std::cos(i)}),
                   {0.4 * i, 0.1 * std::sin(i), 0.3 * i});
    views.push_back(ObserveScene(scene, camera, pose, noise_px, random));
  }
  const Map map = MakeMap(scene, views, MakeModel(camera, std::max(noise_px, 0.1)));
  AdjustmentWindow window;
  for (KeyframeId id = 0; id < num_views; ++id) window.free.push_back(id);
  window.landmarks = map.FindObserved(window.free);
  return CopyBundle(map, window);
}

}  // namespace corvo::test
