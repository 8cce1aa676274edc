// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include <spdlog/formatter.h>

namespace corvo {

/// Returns the format of all messages on standard error: "corvo: error: ...", one line each, with
/// the text as Printable() returns it.
std::unique_ptr<spdlog::formatter> MakeLogFormatter();

}  // namespace corvo
