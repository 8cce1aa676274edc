// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "vo/evaluation/evaluation.h"

namespace corvo {

nlohmann::ordered_json ToJson(const Evaluation& evaluation);
nlohmann::ordered_json ToJson(const ErrorStatistics& errors);

/// One line a measure, for people.
std::string ToText(const Evaluation& evaluation);

/// One line of it.
std::string ToText(const std::string& name, const ErrorStatistics& errors, const std::string& unit);

}  // namespace corvo
