// SPDX-License-Identifier: MIT
#pragma once

namespace corvo::orb {

/// The nearest and second-nearest candidate of a query. Ties go to the lower index.
struct Nearest {
  int index = -1;             ///< Index of the nearest, -1 if there is none.
  int distance = 257;         ///< Distance of the nearest, bits; 257 if there is none.
  int second_distance = 257;  ///< Distance of the second nearest, bits; 257 if there is none.
  int second_index = -1;      ///< Index of the second nearest, -1 if there is none.

  bool operator==(const Nearest&) const = default;
};

/// Updates `nearest` with a candidate. Candidates come in ascending order of index.
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
