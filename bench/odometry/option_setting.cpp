// SPDX-License-Identifier: MIT
#include "bench/odometry/option_setting.h"

#include <sstream>
#include <type_traits>
#include <utility>

#include "orb/error.h"
#include "vo/core/option_fields.h"

namespace corvo::bench {
namespace {

/// A visitor that sets the field with a given name if the visited options have it.
class FieldSetter {
 public:
  FieldSetter(std::string name, std::string value)
      : name_(std::move(name)), value_(std::move(value)) {}

  template <typename T, typename... Rest>
  void operator()(const char* name, T& field, const Rest&... /*rest*/) {
    if (name != name_) return;
    has_found_ = true;
    if constexpr (std::is_arithmetic_v<T>) {
      std::istringstream stream(value_);
      if (stream >> field && stream.eof()) return;
    }
    throw Error(name_ + " is \"" + value_ + "\"; allowed is a number");
  }

  bool has_found() const { return has_found_; }

 private:
  std::string name_;
  std::string value_;
  bool has_found_ = false;
};

}  // namespace

void SetOption(const std::string& setting, OdometryOptions& options) {
  const std::size_t dot = setting.find('.');
  const std::size_t equals = setting.find('=');
  if (dot == std::string::npos || equals == std::string::npos || dot > equals) {
    throw Error("\"" + setting + "\" is no setting; allowed is <section>.<field>=<value>");
  }
  FieldSetter setter(setting.substr(dot + 1, equals - dot - 1), setting.substr(equals + 1));
  OdometryOptions::VisitSections(options, [&](const char* name, auto& section) {
    if (name == setting.substr(0, dot)) VisitAllFields(section, setter);
  });
  if (!setter.has_found()) throw Error(setting.substr(0, equals) + " is no option");
  options.Validate();
}

}  // namespace corvo::bench
