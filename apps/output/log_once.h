// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <spdlog/spdlog.h>

namespace corvo {

/// Logs a message unless this process has logged one with the same key. An input is read several
/// times when its camera is searched, but what is said of it is said once. May be called from any
/// thread.
void LogOnce(spdlog::level::level_enum level, const std::string& message, const std::string& key);

/// The same with the message as its key.
void LogOnce(spdlog::level::level_enum level, const std::string& message);

}  // namespace corvo
