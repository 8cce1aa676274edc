// SPDX-License-Identifier: MIT
#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>

#include "python/src/bindings.h"
#include "python/src/config_text.h"
#include "vo/core/options.h"
#include "vo/io/config.h"

namespace corvo::python {

void BindOptions(nanobind::module_& module) {
  namespace nb = nanobind;

  nb::class_<OdometryOptions>(module, "Options",
                              R"(The options of the odometry: those of a configuration file.

Args:
    sections: The values that differ from the defaults, such as
        {"extractor": {"num_features": 2000}}; `corvo config` prints all sections and keys.

Raises:
    Error: A section or key is unknown, or a value has the wrong type or is out of range.)")
      .def(
          "__init__",
          [](OdometryOptions* self, const nb::dict& sections) {
            new (self) OdometryOptions(ParseOptions(ConfigText(sections), "options"));
          },
          nb::arg("sections") = nb::dict(),
          nb::sig("def __init__(self, sections: dict[str, dict[str, bool | int | float | str]] = "
                  "{}) -> None"))
      .def_static("load", &ReadOptions, nb::arg("file"),
                  R"(Reads a configuration file of the command, in YAML.

Raises:
    Error: The file cannot be read, or as in the constructor; the message names file and line.)")
      .def("__str__", &WriteOptions,
           "The text of a configuration file with every key, its meaning and its range.");
}

}  // namespace corvo::python
