// SPDX-License-Identifier: MIT
#include <filesystem>

#include <fmt/format.h>

#include "apps/codecs/codecs.h"
#include "apps/output/command_path.h"
#include "apps/system/module.h"
#include "orb/error.h"

namespace corvo {
namespace {

const Codecs& LoadCodecs() {
  const std::filesystem::path path = PathFromCommand(CORVO_CODECS_FROM_COMMAND);
  try {
    return *reinterpret_cast<const Codecs* (*)()>(LoadFunction(path, "corvo_codecs"))();
  } catch (const Error& error) {
    throw Error(fmt::format("codecs cannot be loaded: {}", error.what()));
  }
}

}  // namespace

const Codecs& GetCodecs() {
  static const Codecs& codecs = LoadCodecs();
  return codecs;
}

}  // namespace corvo
