// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <string>

namespace corvo {

/// Returns the first line of an error's message, or "out of memory" if memory cannot be allocated.
std::string ErrorText(const std::exception& error);

}  // namespace corvo
