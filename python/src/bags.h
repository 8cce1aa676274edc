// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "apps/codecs/codecs.h"

namespace corvo::python {

/// Opens a topic of a ROS bag by corvo.bags, as Codecs::OpenBag() does.
std::unique_ptr<BagInput> OpenPythonBag(const std::string& bag, const std::string& topic);

}  // namespace corvo::python
