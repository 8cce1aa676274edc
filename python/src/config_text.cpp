// SPDX-License-Identifier: MIT
#include "python/src/config_text.h"

#include <yaml-cpp/yaml.h>

namespace corvo::python {
namespace {

namespace nb = nanobind;

void Emit(nb::handle value, YAML::Emitter& emitter) {
  if (nb::isinstance<nb::dict>(value)) {
    emitter << YAML::BeginMap;
    for (const auto& [key, entry] : nb::borrow<nb::dict>(value)) {
      emitter << YAML::Key << nb::str(key).c_str() << YAML::Value;
      Emit(entry, emitter);
    }
    emitter << YAML::EndMap;
  } else if (nb::isinstance<nb::bool_>(value)) {
    emitter << nb::cast<bool>(value);
  } else {
    emitter << nb::str(value).c_str();
  }
}

}  // namespace

std::string ConfigText(const nb::dict& values) {
  YAML::Emitter emitter;
  Emit(values, emitter);
  return emitter.c_str();
}

}  // namespace corvo::python
