#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "vo/evaluation.h"

namespace corvo {

nlohmann::ordered_json ToJson(const Evaluation& evaluation);

/// One line a measure, for people.
std::string ToText(const Evaluation& evaluation);

}  // namespace corvo
