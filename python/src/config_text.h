// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <nanobind/nanobind.h>

namespace corvo::python {

/// Returns a dictionary, which may hold others, as the YAML that the readers of configuration and
/// camera files check and name errors of.
std::string ConfigText(const nanobind::dict& values);

}  // namespace corvo::python
