// SPDX-License-Identifier: MIT
#include <filesystem>
#include <string>

#include <dlfcn.h>

#include <fmt/format.h>

#include "apps/codecs/codecs.h"
#include "orb/error.h"

namespace corvo {
namespace {

/// Returns the path of the module, which relative to the executable is the same in the build tree
/// and when installed.
std::string ModulePath() {
  std::error_code none;
  const std::filesystem::path command = std::filesystem::read_symlink("/proc/self/exe", none);
  return (command.parent_path() / CORVO_CODECS_FROM_COMMAND).lexically_normal().string();
}

const Codecs& LoadCodecs() {
  const std::string path = ModulePath();
  void* const module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const entry = module == nullptr ? nullptr : dlsym(module, "corvo_codecs");
  if (entry == nullptr) throw Error(fmt::format("codecs cannot be loaded: {}", dlerror()));
  return *reinterpret_cast<const Codecs* (*)()>(entry)();
}

}  // namespace

const Codecs& GetCodecs() {
  static const Codecs& codecs = LoadCodecs();
  return codecs;
}

}  // namespace corvo
