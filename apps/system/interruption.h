// SPDX-License-Identifier: MIT
#pragma once

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

/// Makes SIGINT (Ctrl-C), SIGTERM and SIGHUP (a closed terminal) end the process at once, with a
/// message and ExitCodeOf(). Signals that are ignored, as with nohup, stay so. The classes below
/// change this during their lifetimes.
void EndOnInterruption();

/// Makes writing to a pipe that nobody reads an error instead of the end of the process.
void IgnoreClosedPipes();

/// Lets a loop end by itself after one of the signals: during its lifetime they are noted,
/// for IsRequested(). If nobody has asked for it within kPatienceMs, or if a second signal arrives,
/// the process ends as by EndOnInterruption(). Only one exists at a time.
class Interruption {
 public:
  static constexpr int kPatienceMs = 800;
  /// A second signal counts as one only so much later: timeout(1) sends each signal twice.
  static constexpr int kRepeatMs = 400;

  Interruption();
  /// Discards signals and restores what they did before.
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Returns the signal that has arrived first, or 0 if none has.
  int PendingSignal() const;
  /// Returns whether one of the signals has arrived.
  bool IsRequested() const { return PendingSignal() != 0; }
  /// Throws Interrupted if one of the signals has arrived.
  void ThrowIfRequested() const;
};

/// Keeps the signals from ending the process during its lifetime, so that files are moved
/// into place all or not at all. An Interruption notes the signals nevertheless. May be nested.
class InterruptionDeferral {
 public:
  InterruptionDeferral();
  ~InterruptionDeferral();
  InterruptionDeferral(const InterruptionDeferral&) = delete;
  InterruptionDeferral& operator=(const InterruptionDeferral&) = delete;
};

}  // namespace corvo
