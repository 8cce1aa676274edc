// SPDX-License-Identifier: MIT
#include "apps/system/interruption.h"

#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <string_view>

#include "apps/system/decoder_messages.h"
#include "apps/system/terminal.h"

namespace corvo {
namespace {

// A handler may only use lock-free atomics and functions that are async-signal-safe.
static_assert(std::atomic<int>::is_always_lock_free);
std::atomic<int> num_polls{0};        ///< Number of living Interruption objects.
std::atomic<int> num_deferrals{0};    ///< Number of living InterruptionDeferral objects.
std::atomic<int> requested{0};        ///< The signal that has arrived first, or 0.
std::atomic<bool> is_noticed{false};  ///< Whether PendingSignal() has returned it.

std::atomic<std::int64_t> requested_ms{0};  ///< When it has arrived.
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};

/// What these signals, and SIGALRM after them, did before the Interruption.
std::array<struct sigaction, kSignals.size() + 1> actions_before;

/// Ends the process. Destructors do not run: what is staged is removed by the next run.
[[noreturn]] void EndProcess(int signal) {
  const std::string_view message = num_polls > 0
                                       ? "corvo: error: interrupted\n"
                                       : "corvo: error: interrupted; nothing was written\n";
  if (isatty(UncaughtStandardError()) != 0) WriteUncaught(kEraseLine);
  WriteUncaught(message);
  _exit(ExitCodeOf(signal));
}

void StartTimer() {
  itimerval patience{};
  patience.it_value.tv_usec = 1000 * Interruption::kPatienceMs;
  setitimer(ITIMER_REAL, &patience, nullptr);
}

void StopTimer() {
  const itimerval none{};
  setitimer(ITIMER_REAL, &none, nullptr);
}

std::int64_t NowMs() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return 1000 * std::int64_t{now.tv_sec} + now.tv_nsec / 1'000'000;
}

void OnSignal(int signal) {
  int none = 0;
  const bool is_first = requested.compare_exchange_strong(none, signal);
  if (is_first) requested_ms = NowMs();
  if (num_deferrals > 0) return;
  if (num_polls == 0) EndProcess(signal);
  if (is_first) {
    StartTimer();
  } else if (NowMs() - requested_ms > Interruption::kRepeatMs) {
    EndProcess(signal);
  }
}

void OnAlarm(int /*signal*/) {
  if (num_deferrals == 0 && !is_noticed) EndProcess(requested);
}

bool IsIgnored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/// Sets the handler of a signal, unless the signal is ignored.
void Handle(int signal, void (*handler)(int), struct sigaction* before) {
  if (IsIgnored(signal)) {
    sigaction(signal, nullptr, before);
    return;
  }
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int other : kSignals) sigaddset(&action.sa_mask, other);
  sigaddset(&action.sa_mask, SIGALRM);
  sigaction(signal, &action, before);
}

}  // namespace

std::string_view SignalName(int signal) {
  if (signal == SIGINT) return "SIGINT";
  return signal == SIGTERM ? "SIGTERM" : "SIGHUP";
}

void EndOnInterruption() {
  for (const int signal : kSignals) {
    struct sigaction ignored {};
    Handle(signal, OnSignal, &ignored);
  }
}

void IgnoreClosedPipes() { std::signal(SIGPIPE, SIG_IGN); }

Interruption::Interruption() {
  requested = 0;
  is_noticed = false;
  ++num_polls;
  Handle(SIGALRM, OnAlarm, &actions_before.back());
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    Handle(kSignals[i], OnSignal, &actions_before[i]);
  }
}

Interruption::~Interruption() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], &actions_before[i], nullptr);
  }
  StopTimer();
  sigaction(SIGALRM, &actions_before.back(), nullptr);
  --num_polls;
  requested = 0;
}

int Interruption::PendingSignal() const {
  const int signal = requested;
  if (signal != 0) is_noticed = true;
  return signal;
}

void Interruption::ThrowIfRequested() const {
  if (IsRequested()) throw Interrupted();
}

InterruptionDeferral::InterruptionDeferral() { ++num_deferrals; }

InterruptionDeferral::~InterruptionDeferral() { --num_deferrals; }

}  // namespace corvo
