// SPDX-License-Identifier: MIT
#include "apps/output/log_once.h"

#include <mutex>
#include <set>

namespace corvo {

void LogOnce(spdlog::level::level_enum level, const std::string& message, const std::string& key) {
  static std::mutex mutex;
  static std::set<std::string> keys;
  const std::lock_guard lock(mutex);
  if (keys.insert(key).second) spdlog::log(level, message);
}

void LogOnce(spdlog::level::level_enum level, const std::string& message) {
  LogOnce(level, message, message);
}

}  // namespace corvo
