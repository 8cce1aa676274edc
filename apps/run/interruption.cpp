// SPDX-License-Identifier: MIT
#include "apps/run/interruption.h"

#include <ctime>

namespace corvo {

Interruption::Interruption() {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals_, &previous_);
}

Interruption::~Interruption() {
  const timespec no_wait{};
  while (sigtimedwait(&signals_, nullptr, &no_wait) > 0) {
  }
  pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
}

bool Interruption::IsRequested() const {
  sigset_t pending;
  sigpending(&pending);
  return sigismember(&pending, SIGINT) == 1 || sigismember(&pending, SIGTERM) == 1;
}

void Interruption::ThrowIfRequested() const {
  if (IsRequested()) throw Interrupted();
}

}  // namespace corvo
