// SPDX-License-Identifier: MIT
#pragma once

#include <iostream>
#include <vector>

#include "orb/lsh_index.h"
#include "vo/odometry.h"
#include "vo/offline/observation_log.h"
#include "vo/offline/refiner.h"

namespace corvo::test {

/// The variables that pieces of C++ in the documentation take as given.
struct Given {
  Odometry& odometry;
  std::vector<orb::Descriptor> descriptors;
  std::vector<orb::Descriptor> more;
  orb::Descriptor query;
};

}  // namespace corvo::test
