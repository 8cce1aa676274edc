// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace corvo {

/// Returns the first of the known names, of which there is at least one, at the least Levenshtein
/// distance from `name`: the least number of inserted, dropped or changed characters.
std::string NearestName(const std::string& name, const std::vector<std::string>& known);

}  // namespace corvo
