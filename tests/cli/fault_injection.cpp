// SPDX-License-Identifier: MIT
// A library for LD_PRELOAD that makes one system call of `corvo` fail, chosen by the environment:
//
//   CORVO_FAULT_FOLDER  only calls for files below this folder count; memory counts from the first
//   CORVO_FAULT_CALL    open, read, write, fsync, rename, malloc
//   CORVO_FAULT_N       the first failing call, from 1; without it, none fails
//   CORVO_FAULT_LAST    the last failing call; without it, only the first
//   CORVO_FAULT_ERROR   its errno
//   CORVO_FAULT_BYTES   writes fail with ENOSPC after this number of bytes
//   CORVO_FAULT_LOG     file to which calls for files are logged, and at the end their numbers

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

enum Call { kOpen, kRead, kWrite, kFsync, kRename, kMalloc, kNumCalls };
constexpr std::array<const char*, kNumCalls> kNames = {"open",  "read",   "write",
                                                       "fsync", "rename", "malloc"};
constexpr std::size_t kMaxPath = 1024;

/// All of it is set once, before main().
struct Faults {
  bool is_on = false;
  const char* folder = "";
  int call = kNumCalls;
  long first = 0;
  long last = 0;
  int error = 0;
  int log = -1;
};

Faults faults;
std::array<std::atomic<long>, kNumCalls> counts{};
std::atomic<long> bytes_left{-1};  // Negative: no limit.
std::atomic<bool> is_counting_memory{false};

long Number(const char* name, long otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::atol(text);
}

__attribute__((constructor)) void Start() {
  const char* const folder = std::getenv("CORVO_FAULT_FOLDER");
  if (folder == nullptr || std::strcmp(program_invocation_short_name, "corvo") != 0) return;
  faults.folder = folder;
  const char* const call = std::getenv("CORVO_FAULT_CALL");
  for (int i = 0; call != nullptr && i < kNumCalls; ++i) {
    if (std::strcmp(call, kNames[i]) == 0) faults.call = i;
  }
  faults.first = Number("CORVO_FAULT_N", 0);
  faults.last = Number("CORVO_FAULT_LAST", faults.first);
  faults.error = static_cast<int>(Number("CORVO_FAULT_ERROR", EIO));
  bytes_left = Number("CORVO_FAULT_BYTES", -1);
  const char* const log = std::getenv("CORVO_FAULT_LOG");
  if (log != nullptr) faults.log = creat(log, 0600);
  faults.is_on = true;
}

/// Returns the function that this library replaces.
template <typename Function>
Function* Real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

ssize_t RealWrite(int file, const void* buffer, std::size_t size) {
  static const auto real = Real<ssize_t(int, const void*, std::size_t)>("write");
  return real(file, buffer, size);
}

void Log(const char* a, const char* b, const char* c) {
  if (faults.log < 0) return;
  char line[3 * kMaxPath];
  const int size = std::snprintf(line, sizeof line, "%s\t%s\t%s\n", a, b, c);
  if (RealWrite(faults.log, line, static_cast<std::size_t>(size)) != size) std::abort();
}

__attribute__((destructor)) void End() {
  faults.is_on = false;
  for (int i = 0; i < kNumCalls; ++i) {
    char count[32];
    std::snprintf(count, sizeof count, "%ld", counts[i].load());
    Log("count", kNames[i], count);
  }
}

/// Counts a call. Returns true and sets errno if it shall fail.
bool Fails(Call call) {
  const long count = ++counts[call];
  if (call != faults.call || count < faults.first || count > faults.last) return false;
  errno = faults.error;
  return true;
}

bool IsBelow(const char* path) {
  const std::size_t size = std::strlen(faults.folder);
  return faults.is_on && size > 0 && std::strncmp(path, faults.folder, size) == 0 &&
         (path[size] == '/' || path[size] == '\0');
}

bool FailsFor(Call call, const char* path, const char* other = "") {
  if (!IsBelow(path)) return false;
  is_counting_memory = true;
  Log(kNames[call], path, other);
  return Fails(call);
}

/// Like FailsFor(), for an open file.
bool FailsFor(Call call, int file, bool& is_below) {
  if (!faults.is_on || file == faults.log) return false;
  const int error = errno;
  char link[64];
  char path[kMaxPath];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t size = readlink(link, path, sizeof path - 1);
  errno = error;
  if (size < 0) return false;
  path[size] = '\0';
  is_below = IsBelow(path);
  return FailsFor(call, path);
}

bool FailsForMemory() { return faults.is_on && is_counting_memory && Fails(kMalloc); }

/// Writes as many bytes as the limit leaves.
ssize_t WriteWithinLimit(int file, const void* buffer, std::size_t size) {
  if (bytes_left < 0) return RealWrite(file, buffer, size);
  const auto left = static_cast<std::size_t>(bytes_left.load());
  const std::size_t taken = size < left ? size : left;
  bytes_left -= static_cast<long>(taken);
  if (taken > 0 || size == 0) return RealWrite(file, buffer, taken);
  errno = ENOSPC;
  return -1;
}

}  // namespace

#define CORVO_OPEN(name)                                                            \
  int name(const char* path, int flags, ...) {                                      \
    static const auto real = Real<int(const char*, int, ...)>(#name);               \
    va_list arguments;                                                              \
    va_start(arguments, flags);                                                     \
    const unsigned mode = (flags & O_CREAT) != 0 ? va_arg(arguments, unsigned) : 0; \
    va_end(arguments);                                                              \
    return FailsFor(kOpen, path) ? -1 : real(path, flags, mode);                    \
  }

#define CORVO_FOPEN(name)                                                       \
  std::FILE* name(const char* path, const char* mode) {                         \
    static const auto real = Real<std::FILE*(const char*, const char*)>(#name); \
    return FailsFor(kOpen, path) ? nullptr : real(path, mode);                  \
  }

#define CORVO_FLUSH(name)                                      \
  int name(int file) {                                         \
    static const auto real = Real<int(int)>(#name);            \
    bool is_below = false;                                     \
    return FailsFor(kFsync, file, is_below) ? -1 : real(file); \
  }

extern "C" {

CORVO_OPEN(open)
CORVO_OPEN(open64)
CORVO_FOPEN(fopen)
CORVO_FOPEN(fopen64)
CORVO_FLUSH(fsync)
CORVO_FLUSH(fdatasync)

ssize_t read(int file, void* buffer, std::size_t size) {
  static const auto real = Real<ssize_t(int, void*, std::size_t)>("read");
  bool is_below = false;
  return FailsFor(kRead, file, is_below) ? -1 : real(file, buffer, size);
}

ssize_t write(int file, const void* buffer, std::size_t size) {
  bool is_below = false;
  if (FailsFor(kWrite, file, is_below)) return -1;
  return is_below ? WriteWithinLimit(file, buffer, size) : RealWrite(file, buffer, size);
}

ssize_t writev(int file, const iovec* parts, int num_parts) {
  bool is_below = false;
  if (FailsFor(kWrite, file, is_below)) return -1;
  ssize_t total = 0;
  for (int i = 0; i < num_parts; ++i) {
    if (parts[i].iov_len == 0) continue;
    const ssize_t size = is_below ? WriteWithinLimit(file, parts[i].iov_base, parts[i].iov_len)
                                  : RealWrite(file, parts[i].iov_base, parts[i].iov_len);
    if (size < 0) return total > 0 ? total : -1;
    total += size;
    if (static_cast<std::size_t>(size) < parts[i].iov_len) break;
  }
  return total;
}

int rename(const char* from, const char* to) {
  static const auto real = Real<int(const char*, const char*)>("rename");
  return FailsFor(kRename, from, to) ? -1 : real(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  static const auto real = Real<int(int, const char*, int, const char*, unsigned)>("renameat2");
  return FailsFor(kRename, from, to) ? -1 : real(from_folder, from, to_folder, to, flags);
}

void* malloc(std::size_t size) { return FailsForMemory() ? nullptr : __libc_malloc(size); }

void* calloc(std::size_t count, std::size_t size) {
  return FailsForMemory() ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* memory, std::size_t size) {
  return FailsForMemory() ? nullptr : __libc_realloc(memory, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return FailsForMemory() ? nullptr : __libc_memalign(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = FailsForMemory() ? nullptr : __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}

}  // extern "C"
