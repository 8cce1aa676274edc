// SPDX-License-Identifier: MIT
#include <filesystem>

#include <dlfcn.h>

#include <fmt/format.h>

#include "apps/codecs/codecs.h"
#include "apps/output/command_path.h"
#include "orb/error.h"

namespace corvo {
namespace {

const Codecs& LoadCodecs() {
  const std::filesystem::path path = PathFromCommand(CORVO_CODECS_FROM_COMMAND);
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
