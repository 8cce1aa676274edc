// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "vo/evaluation/evaluation.h"

namespace corvo {

nlohmann::ordered_json ToJson(const Evaluation& evaluation);
nlohmann::ordered_json ToJson(const ErrorStatistics& errors);

/// Returns a table for display with one line per measure.
std::string ToText(const Evaluation& evaluation);

/// Returns the root mean square of the ATE, such as "ATE rmse 0.27 m".
std::string AteText(const Evaluation& evaluation);

/// Returns one line of this table.
std::string ToText(const std::string& name, const ErrorStatistics& errors, const std::string& unit);

}  // namespace corvo
