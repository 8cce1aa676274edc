// SPDX-License-Identifier: MIT
#include "apps/run/interruption.h"

#include <array>
#include <ctime>

namespace corvo {
namespace {

constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};

bool IsIgnored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

std::string_view SignalName(int signal) {
  if (signal == SIGINT) return "SIGINT";
  return signal == SIGTERM ? "SIGTERM" : "SIGHUP";
}

Interruption::Interruption() {
  sigemptyset(&signals_);
  for (const int signal : kSignals) {
    if (!IsIgnored(signal)) sigaddset(&signals_, signal);
  }
  pthread_sigmask(SIG_BLOCK, &signals_, &previous_);
}

Interruption::~Interruption() {
  const timespec no_wait{};
  while (sigtimedwait(&signals_, nullptr, &no_wait) > 0) {
  }
  pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
}

int Interruption::PendingSignal() const {
  sigset_t pending;
  sigpending(&pending);
  for (const int signal : kSignals) {
    if (sigismember(&pending, signal) == 1 && sigismember(&signals_, signal) == 1) return signal;
  }
  return 0;
}

void Interruption::ThrowIfRequested() const {
  if (IsRequested()) throw Interrupted();
}

}  // namespace corvo
