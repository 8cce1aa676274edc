// SPDX-License-Identifier: MIT
#pragma once

namespace corvo::orb {

/// The nearest and second-nearest candidate of a query. Ties go to the lower index.
struct Nearest {
  int index = -1;             ///< Of the nearest; -1 where there is no candidate.
  int distance = 257;         ///< Of the nearest, bits; 257 where there is none.
  int second_distance = 257;  ///< Of the second nearest, bits; 257 where there is none.
  int second_index = -1;      ///< Of the second nearest; -1 where there is none.

  bool operator==(const Nearest&) const = default;
};

/// Takes a candidate into account. Candidates come in ascending order of index.
inline void Update(Nearest& nearest, int index, int distance) {
  if (distance < nearest.distance) {
    nearest.second_distance = nearest.distance;
    nearest.second_index = nearest.index;
    nearest.distance = distance;
    nearest.index = index;
  } else if (distance < nearest.second_distance) {
    nearest.second_distance = distance;
    nearest.second_index = index;
  }
}

}  // namespace corvo::orb
