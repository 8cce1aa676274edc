// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/odometry/perturbation.h"
#include "bench/odometry/recording.h"

namespace corvo::bench {

/// A recording and what is done to it.
struct Scenario {
  std::string title;
  std::function<Recording()> make;
  std::vector<Perturbation> perturbations;
};

/// The sequences of the test data, each under every perturbation.
std::vector<Scenario> RecordedScenarios();

/// In small images: a street of a kilometer, driven again and again with a cut in between, and a
/// room, walked round and round.
std::vector<Scenario> EnduranceScenarios(int frames);

/// Two kilometers of a street with a fifth of the image moving, and a room with three seconds of
/// dark and two of blur.
std::vector<Scenario> RenderedScenarios();

}  // namespace corvo::bench
