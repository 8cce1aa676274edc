// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vo/core/options.h"

namespace corvo::bench {

/// Sets one field of the options, among them those that configuration files do not have.
/// `setting` is "<section>.<field>=<value>". Throws corvo::Error on an unknown field and on a value
/// that is no number or out of range.
void SetOption(const std::string& setting, OdometryOptions& options);

}  // namespace corvo::bench
