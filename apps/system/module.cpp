// SPDX-License-Identifier: MIT
#include "apps/system/module.h"

#include <dlfcn.h>

#include "orb/error.h"

namespace corvo {

void* LoadFunction(const std::filesystem::path& library, const char* name) {
  void* const loaded = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const function = loaded == nullptr ? nullptr : dlsym(loaded, name);
  if (function == nullptr) throw Error(dlerror());
  return function;
}

}  // namespace corvo
