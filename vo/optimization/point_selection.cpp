// SPDX-License-Identifier: MIT
#include "vo/optimization/point_selection.h"

#include <algorithm>
#include <numeric>

namespace corvo {

std::vector<char> SelectPoints(const Bundle& bundle, int points_per_view) {
  const std::vector<int> begin = ObservationOffsets(bundle);
  std::vector<int> order(bundle.points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return begin[a + 1] - begin[a] > begin[b + 1] - begin[b]; });
  std::vector<char> is_selected(bundle.points.size());
  std::vector<int> num_selected(bundle.views.size());
  for (const int point : order) {
    const auto first = bundle.observations.begin() + begin[point];
    const auto last = bundle.observations.begin() + begin[point + 1];
    is_selected[point] = std::any_of(first, last, [&](const Bundle::Observation& observation) {
      return !bundle.views[observation.view].is_fixed &&
             num_selected[observation.view] < points_per_view;
    });
    if (!is_selected[point]) continue;
    for (auto observation = first; observation != last; ++observation)
      ++num_selected[observation->view];
  }
  return is_selected;
}

Bundle ThinPoints(const Bundle& bundle, int points_per_view) {
  const std::vector<int> begin = ObservationOffsets(bundle);
  const std::vector<char> is_selected = SelectPoints(bundle, points_per_view);
  Bundle thinned{bundle.world_from_local, bundle.views, {}, {}};
  for (std::size_t point = 0; point < bundle.points.size(); ++point) {
    if (!is_selected[point] || begin[point + 1] - begin[point] < 2) continue;
    for (int i = begin[point]; i < begin[point + 1]; ++i) {
      thinned.observations.push_back(bundle.observations[i]);
      thinned.observations.back().point = static_cast<int>(thinned.points.size());
    }
    thinned.points.push_back(bundle.points[point]);
  }
  return thinned;
}

}  // namespace corvo
