// SPDX-License-Identifier: MIT
#pragma once

#include <nanobind/nanobind.h>

namespace corvo::python {

// Each function adds the classes and functions of one subject to the module.

void BindBags(nanobind::module_& module);
void BindCamera(nanobind::module_& module);
void BindCommand(nanobind::module_& module);
void BindGeometry(nanobind::module_& module);
void BindInputs(nanobind::module_& module);
void BindOdometry(nanobind::module_& module);
void BindOffline(nanobind::module_& module);
void BindOptions(nanobind::module_& module);
void BindOrb(nanobind::module_& module);
void BindResults(nanobind::module_& module);

}  // namespace corvo::python
