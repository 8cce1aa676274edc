// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>
#include <string_view>

namespace corvo {

/// The exit code of an interrupted command, which is the shells' convention for SIGINT (128 + 2).
inline constexpr int kInterrupted = 130;

/// Returns the exit code of a command that a signal ended: 130 for SIGINT, 143 for SIGTERM, 129 for
/// SIGHUP.
constexpr int ExitCodeOf(int signal) { return 128 + signal; }

/// Returns "SIGINT", "SIGTERM" or "SIGHUP".
std::string_view SignalName(int signal);

/// An exception that ends a command after a signal, before anything has been written.
struct Interrupted {};

/// Blocks SIGINT (Ctrl-C), SIGTERM and SIGHUP (a closed terminal) during its lifetime, so that they
/// stay pending instead of ending the process while files are half-written. Applies to the calling
/// thread and to threads that it starts. Signals that are ignored, as with nohup, stay so.
class Interruption {
 public:
  Interruption();
  /// Discards pending signals and restores the signal mask.
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Returns the pending signal, or 0 if there is none.
  int PendingSignal() const;
  /// Returns whether one of the signals is pending.
  bool IsRequested() const { return PendingSignal() != 0; }
  /// Throws Interrupted if one of the signals is pending.
  void ThrowIfRequested() const;

 private:
  sigset_t signals_;
  sigset_t previous_;
};

}  // namespace corvo
