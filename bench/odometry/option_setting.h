// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vo/core/options.h"

namespace corvo::bench {

/// Sets one field of the options; fields that configuration files do not have are allowed.
/// `setting` is "<section>.<field>=<value>". Throws corvo::Error if the field is unknown or the
/// value is not a number or out of range.
void SetOption(const std::string& setting, OdometryOptions& options);

}  // namespace corvo::bench
