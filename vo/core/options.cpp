// SPDX-License-Identifier: MIT
#include "vo/core/options.h"

#include <string>

#include "orb/error.h"
#include "vo/core/option_fields.h"

namespace corvo {
namespace {

/// Calls Validate() of the options, if they have it, and prefixes its error with "<section>.".
template <typename Options>
void CheckTogether(const char* section, const Options& options) {
  if constexpr (requires { options.Validate(); }) {
    try {
      options.Validate();
    } catch (const Error& error) {
      throw Error(std::string(section) + "." + error.what());
    }
  }
}

}  // namespace

void OdometryOptions::Validate() const {
  VisitSections(*this, [](const char* name, const auto& section) {
    CheckFields(name, section);
    CheckTogether(name, section);
  });
}

OdometryOptions OdometryOptions::Checked() const {
  Validate();
  return *this;
}

}  // namespace corvo
