// SPDX-License-Identifier: MIT
#include "orb/error.h"
#include "python/src/bindings.h"

NB_MODULE(_corvo, module) {
  namespace nb = nanobind;
  using namespace corvo::python;

  module.doc() = "The C++ part of the package corvo.";
  nb::exception<corvo::Error>(module, "Error", PyExc_ValueError).attr("__doc__") =
      "Misuse or bad input. The message names the file or argument, its value, and what is "
      "allowed.";
  BindBags(module);
  BindOptions(module);
  BindCamera(module);
  BindResults(module);
  BindOdometry(module);
  BindOrb(module);
  BindGeometry(module);
  BindOffline(module);
  BindInputs(module);
  BindCommand(module);
}
