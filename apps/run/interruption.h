// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>

namespace corvo {

/// The exit code of an interrupted command, which is the shells' convention for SIGINT (128 + 2).
inline constexpr int kInterrupted = 130;

/// An exception that ends a command after SIGINT or SIGTERM, before anything has been written.
struct Interrupted {};

/// Blocks SIGINT (Ctrl-C) and SIGTERM during its lifetime, so that they stay pending instead of
/// ending the process while files are half-written. Applies to the calling thread and to threads
/// that it starts.
class Interruption {
 public:
  Interruption();
  /// Discards pending signals and restores the signal mask.
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Returns whether one of the signals is pending.
  bool IsRequested() const;
  /// Throws Interrupted if one of the signals is pending.
  void ThrowIfRequested() const;

 private:
  sigset_t signals_;
  sigset_t previous_;
};

}  // namespace corvo
