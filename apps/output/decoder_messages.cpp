// SPDX-License-Identifier: MIT
#include "apps/output/decoder_messages.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>

namespace corvo {
namespace {

std::atomic<int> standard_error{STDERR_FILENO};

/// The temporary file of the messages and a copy of the descriptor of standard error, or -1 where
/// the system has none.
struct Catch {
  int file = -1;
  int copy = -1;
};

const Catch& TheCatch() {
  static const Catch opened = [] {
    std::FILE* const file = std::tmpfile();
    return Catch{file == nullptr ? -1 : fileno(file), dup(STDERR_FILENO)};
  }();
  return opened;
}

/// Removes the address in FFmpeg's "[h264 @ 0x55cd1914a580]", which differs from run to run.
std::string WithoutAddress(std::string text) {
  const std::size_t begin = text.find(" @ 0x");
  if (begin == std::string::npos) return text;
  const std::size_t end =
      std::min(text.find_first_not_of("0123456789abcdef", begin + 5), text.size());
  return text.erase(begin, end - begin);
}

/// Returns false if the system cannot.
bool Clear() {
  const int file = TheCatch().file;
  return ftruncate(file, 0) == 0 && lseek(file, 0, SEEK_SET) == 0;
}

bool CanCatch() { return TheCatch().file >= 0 && TheCatch().copy >= 0; }

}  // namespace

MessageLock::mutex_t& MessageLock::mutex() {
  static mutex_t mutex;
  return mutex;
}

DecoderMessages::DecoderMessages() {
  MessageLock::mutex().lock();
  if (!CanCatch()) return;
  standard_error = TheCatch().copy;
  dup2(TheCatch().file, STDERR_FILENO);
}

DecoderMessages::~DecoderMessages() {
  if (CanCatch()) {
    Clear();
    dup2(TheCatch().copy, STDERR_FILENO);
    standard_error = STDERR_FILENO;
  }
  MessageLock::mutex().unlock();
}

std::string DecoderMessages::Take() {
  const int file = TheCatch().file;
  if (!CanCatch() || lseek(file, 0, SEEK_CUR) == 0) return "";
  char buffer[256];
  const ssize_t size = pread(file, buffer, sizeof buffer, 0);
  if (!Clear() || size <= 0) return "";
  const std::string text(buffer, static_cast<std::size_t>(size));
  return WithoutAddress(text.substr(0, text.find('\n')));
}

int UncaughtStandardError() { return standard_error; }

}  // namespace corvo
