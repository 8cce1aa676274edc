// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>

namespace corvo {

/// Exit code of a command that was interrupted, as shells have it for SIGINT.
inline constexpr int kInterrupted = 130;

/// One of the signals, as an error that ends a command: nothing has been written yet.
struct Interrupted {};

/// While it lives, Ctrl-C (SIGINT) and SIGTERM no longer end the process but wait to be asked for,
/// so that files are never left half-written. Of this thread and those that it starts.
class Interruption {
 public:
  Interruption();
  /// A signal that came meanwhile is forgotten.
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Whether one of the signals has come.
  bool IsRequested() const;
  /// Throws Interrupted if so.
  void ThrowIfRequested() const;

 private:
  sigset_t signals_;
  sigset_t previous_;
};

}  // namespace corvo
