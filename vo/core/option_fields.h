// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <type_traits>

#include "orb/error.h"

namespace corvo {

/// A visitor that throws the corvo::Error of CheckRange for a field out of range, which it names
/// "<section>.<name>".
class FieldRangeCheck {
 public:
  explicit FieldRangeCheck(std::string section) : section_(std::move(section)) {}

  template <typename T>
  void operator()(const char* name, const T& value, const std::type_identity_t<T>& min,
                  const std::type_identity_t<T>& max, const char* /*meaning*/) const {
    CheckRange(section_ + "." + name, value, min, max);
  }

  template <typename T>
  void operator()(const char* /*name*/, const T& /*value*/, const char* /*meaning*/) const {}

 private:
  std::string section_;
};

/// Visits the fields of an options struct that are keys of configuration files.
template <typename Options, typename Visitor>
void VisitFileFields(Options& options, Visitor&& field) {
  using Section = std::remove_const_t<Options>;
  if constexpr (requires { Section::Visit(options, field); }) Section::Visit(options, field);
}

/// Visits all fields of an options struct: the keys of configuration files and the fields that only
/// users of the library set.
template <typename Options, typename Visitor>
void VisitAllFields(Options& options, Visitor&& field) {
  using Section = std::remove_const_t<Options>;
  VisitFileFields(options, field);
  if constexpr (requires { Section::VisitAdvanced(options, field); }) {
    Section::VisitAdvanced(options, field);
  }
}

/// Throws corvo::Error naming the first field out of range, as "<section>.<field>".
template <typename Options>
void CheckFields(const char* section, const Options& options) {
  VisitAllFields(options, FieldRangeCheck(section));
}

}  // namespace corvo
