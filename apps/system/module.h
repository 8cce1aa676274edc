// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace corvo {

/// Loads a shared library, which stays loaded, and returns the address of one of its functions.
/// Throws corvo::Error if the library or the function cannot be found.
void* LoadFunction(const std::filesystem::path& library, const char* name);

}  // namespace corvo
