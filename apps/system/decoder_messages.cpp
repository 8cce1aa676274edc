// SPDX-License-Identifier: MIT
#include "apps/system/decoder_messages.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>

namespace corvo {
namespace {

std::atomic<int> standard_error{STDERR_FILENO};

/// Returns the descriptor of a temporary file for the messages, or -1 where the system has none.
int MessageFile() {
  static const int descriptor = [] {
    std::FILE* const file = std::tmpfile();
    return file == nullptr ? -1 : fileno(file);
  }();
  return descriptor;
}

bool IsCatching() { return standard_error != STDERR_FILENO; }

/// Removes the address in FFmpeg's "[h264 @ 0x55cd1914a580]", which differs from run to run.
std::string WithoutAddress(std::string text) {
  const std::size_t begin = text.find(" @ 0x");
  if (begin == std::string::npos) return text;
  const std::size_t end =
      std::min(text.find_first_not_of("0123456789abcdef", begin + 5), text.size());
  return text.erase(begin, end - begin);
}

/// Returns false if the system cannot.
bool Clear() { return ftruncate(MessageFile(), 0) == 0 && lseek(MessageFile(), 0, SEEK_SET) == 0; }

}  // namespace

MessageLock::mutex_t& MessageLock::mutex() {
  static mutex_t mutex;
  return mutex;
}

DecoderMessages::DecoderMessages() {
  MessageLock::mutex().lock();
  const int copy = MessageFile() < 0 ? -1 : fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
  if (copy < 0) return;
  standard_error = copy;
  dup2(MessageFile(), STDERR_FILENO);
}

DecoderMessages::~DecoderMessages() {
  if (IsCatching()) {
    Clear();
    const int copy = standard_error;
    dup2(copy, STDERR_FILENO);
    standard_error = STDERR_FILENO;
    close(copy);
  }
  MessageLock::mutex().unlock();
}

std::string DecoderMessages::Take() {
  if (!IsCatching() || lseek(MessageFile(), 0, SEEK_CUR) == 0) return "";
  char buffer[256];
  const ssize_t size = pread(MessageFile(), buffer, sizeof buffer, 0);
  if (!Clear() || size <= 0) return "";
  const std::string text(buffer, static_cast<std::size_t>(size));
  return WithoutAddress(text.substr(0, text.find('\n')));
}

int UncaughtStandardError() { return standard_error; }

void WriteUncaught(std::string_view text) {
  static_cast<void>(!write(standard_error, text.data(), text.size()));
}

}  // namespace corvo
