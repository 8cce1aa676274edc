// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace corvo {

/// Returns indented JSON with a final line break. Bytes that are not UTF-8, as in names of files,
/// become U+FFFD.
inline std::string JsonText(const nlohmann::ordered_json& json) {
  using Handler = nlohmann::ordered_json::error_handler_t;
  return json.dump(2, ' ', false, Handler::replace) + "\n";
}

}  // namespace corvo
