// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "tests/fuzz/input.h"

namespace corvo::fuzz {

// A target takes any bytes. It returns if the code that it calls returns finite results or throws
// corvo::Error; anything else ends the process.

void FuzzBundle(Bytes bytes);
void FuzzCamera(Bytes bytes);
void FuzzCameraFile(Bytes bytes);
void FuzzCommandLine(Bytes bytes);
void FuzzConfig(Bytes bytes);
void FuzzDataset(Bytes bytes);
void FuzzEvaluation(Bytes bytes);
void FuzzFeatures(Bytes bytes);
void FuzzIndexFile(Bytes bytes);
void FuzzOdometry(Bytes bytes);
void FuzzPattern(Bytes bytes);
void FuzzTrajectory(Bytes bytes);
void FuzzTwoView(Bytes bytes);

struct Target {
  const char* name;  ///< Name of its program (fuzz_NAME) and of its folder in tests/fuzz/corpus.
  void (*run)(Bytes);
};

inline constexpr std::array kTargets = {
    Target{"bundle", FuzzBundle},          Target{"camera", FuzzCamera},
    Target{"camera_file", FuzzCameraFile}, Target{"command_line", FuzzCommandLine},
    Target{"config", FuzzConfig},          Target{"dataset", FuzzDataset},
    Target{"evaluation", FuzzEvaluation},  Target{"features", FuzzFeatures},
    Target{"index_file", FuzzIndexFile},   Target{"odometry", FuzzOdometry},
    Target{"pattern", FuzzPattern},        Target{"trajectory", FuzzTrajectory},
    Target{"two_view", FuzzTwoView},
};

}  // namespace corvo::fuzz
