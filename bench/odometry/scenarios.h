// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/odometry/recording.h"

namespace corvo::bench {

/// A recording and the images that runs of it begin with.
struct Scenario {
  std::string title;
  std::function<Recording()> make;
  std::vector<int> starts = {0};
};

/// Returns the sequences of the test data, each from five images on.
std::vector<Scenario> RecordedScenarios();

/// Returns endurance scenarios in small images: a drive along a street of a kilometer, repeated
/// with a cut in between, and a walk around a room without end.
std::vector<Scenario> EnduranceScenarios(int frames);

/// Returns two scenarios: two kilometers of a street with a fifth of the image moving, and a room
/// with three seconds of darkness and two of blur.
std::vector<Scenario> RenderedScenarios();

}  // namespace corvo::bench
