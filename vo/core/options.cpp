#include "vo/core/options.h"

#include <string>
#include <type_traits>

#include "orb/error.h"

namespace corvo {
namespace {

/// Throws an Error of CheckRange whose field is "<section>.<name>".
class RangeCheck {
 public:
  explicit RangeCheck(const char* section) : section_(section) {}

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

/// Throws what the options' own Validate() throws, if they have one, as "<section>.<message>".
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
    using Section = std::decay_t<decltype(section)>;
    Section::Visit(section, RangeCheck(name));
    if constexpr (requires { Section::VisitAdvanced(section, RangeCheck(name)); }) {
      Section::VisitAdvanced(section, RangeCheck(name));
    }
    CheckTogether(name, section);
  });
}

OdometryOptions OdometryOptions::Checked() const {
  Validate();
  return *this;
}

}  // namespace corvo
