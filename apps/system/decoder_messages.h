// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <string>
#include <string_view>

namespace corvo {

/// Catches what the decoders of image libraries print to standard error, without the name of the
/// file, during its lifetime. One thread at a time holds such an object; others wait.
class DecoderMessages {
 public:
  DecoderMessages();
  /// Lets standard error go where it went before.
  ~DecoderMessages();
  DecoderMessages(const DecoderMessages&) = delete;
  DecoderMessages& operator=(const DecoderMessages&) = delete;

  /// Returns the first line that was caught since the last call, or an empty text.
  std::string Take();
};

/// Held while the program prints messages of its own, so that no other thread catches them: the
/// lock of spdlog's sinks, too.
struct MessageLock {
  using mutex_t = std::recursive_mutex;
  static mutex_t& mutex();
};

/// Returns the descriptor of standard error, also while its messages are caught. May be called in a
/// signal handler.
int UncaughtStandardError();

/// Writes a text to standard error, also while its messages are caught. May be called in a signal
/// handler. Errors are ignored.
void WriteUncaught(std::string_view text);

}  // namespace corvo
