// SPDX-License-Identifier: MIT
#include <atomic>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "apps/commands/command_line.h"
#include "apps/system/decoder_messages.h"
#include "apps/system/interruption.h"

namespace corvo {
namespace {

std::atomic<bool> memory_ran_out = false;

/// Fails as operator new does by itself, and remembers it for IsOutOfMemory().
[[noreturn]] void ThrowBadAlloc() {
  memory_ran_out = true;
  throw std::bad_alloc();
}

/// Returns whether std::terminate is called for want of memory. The exception is unknown if it left
/// a destructor.
bool IsOutOfMemory() {
  const std::exception_ptr current = std::current_exception();
  if (!current) return memory_ran_out;
  try {
    std::rethrow_exception(current);
  } catch (const std::bad_alloc&) {
    return true;
  } catch (...) {
    return false;
  }
}

/// Ends the process where no handler catches std::bad_alloc, as in functions that must not throw.
/// Aborts it for any other reason.
[[noreturn]] void EndOutOfMemory() {
  if (!IsOutOfMemory()) std::abort();
  constexpr std::string_view kMessage = "corvo: error: out of memory\n";
  WriteUncaught(kMessage);
  std::_Exit(kBadInput);
}

}  // namespace
}  // namespace corvo

int main(int argc, char** argv) {
  std::set_new_handler(corvo::ThrowBadAlloc);
  std::set_terminate(corvo::EndOutOfMemory);
  try {
    corvo::EndOnInterruption();
    return corvo::RunCommandLine({argv + 1, argv + argc});
  } catch (...) {  // Reporting an error needs memory, of which there is none.
    corvo::EndOutOfMemory();
  }
}
