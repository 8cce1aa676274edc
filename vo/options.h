#pragma once

#include "orb/options.h"

namespace corvo {

// Every options struct names each field once in `Visit`, with range and meaning: validation, the
// configuration reader and `configs/default.yaml` come from it. See orb::ExtractorOptions::Visit.

/// Two-view initialisation.
struct InitializerOptions {
  int min_matches = 100;
  double min_parallax_px = 1.0;

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("min_matches", self.min_matches, 20, 100000, "matches with the reference frame");
  }
};

/// Everything that decides the output of Odometry, apart from the camera and the images.
struct OdometryOptions {
  orb::ExtractorOptions extractor;
  InitializerOptions initializer;

  /// Throws corvo::Error naming the first field out of range, as "<section>.<field>".
  void Validate() const;

  /// Calls `section(name, options)` for every part.
  template <typename Self, typename Visitor>
  static void VisitSections(Self& self, Visitor&& section) {
    section("extractor", self.extractor);
    section("initializer", self.initializer);
  }
};

}  // namespace corvo
