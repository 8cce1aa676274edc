// SPDX-License-Identifier: MIT
#include "apps/output/residual_plot.h"

#include <gmock/gmock.h>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

/// Returns a bundle with one view at the origin that observes points at `pixels` with an error of
/// `error_px`.
Bundle Seen(const std::vector<Eigen::Vector2d>& pixels, const Eigen::Vector2d& error_px) {
  Bundle bundle;
  bundle.views.push_back({0, false, SE3().data()});
  for (const Eigen::Vector2d& pixel : pixels) {
    const Eigen::Vector2d ray = *test::PinholeCamera().Undistort(pixel);
    bundle.points.push_back({0, 5 * Eigen::Vector3d(ray.x(), ray.y(), 1)});
    bundle.observations.push_back(
        {{0, kNoId, pixel + error_px, 1.0}, 0, static_cast<int>(bundle.points.size()) - 1});
  }
  return bundle;
}

TEST(MeanResidualsTest, AreAveragedPerCell) {
  std::vector<Bundle> bundles{Seen({{10, 10}, {12, 30}}, {0.5, -0.25}), Seen({{630, 470}}, {1, 2})};
  const auto cells = MeanResiduals(test::PinholeCamera(), bundles, 4, 3);
  ASSERT_EQ(cells.size(), 12);
  EXPECT_THAT(cells[0].center, test::IsMatrixNear(Eigen::Vector2d(79.5, 79.5), 1e-9));
  EXPECT_EQ(cells[0].count, 2);
  EXPECT_THAT(cells[0].mean_px, test::IsMatrixNear(Eigen::Vector2d(0.5, -0.25), 1e-9));
  EXPECT_EQ(cells[1].count, 0);
  EXPECT_EQ(cells[11].count, 1);
  EXPECT_THAT(cells[11].mean_px, test::IsMatrixNear(Eigen::Vector2d(1, 2), 1e-9));
}

TEST(MeanResidualsTest, OutliersDoNotCount) {
  std::vector<Bundle> bundles{Seen({{10, 10}}, {0.5, 0})};
  bundles[0].observations[0].is_inlier = false;
  EXPECT_EQ(MeanResiduals(test::PinholeCamera(), bundles, 1, 1)[0].count, 0);
}

TEST(ResidualPlotScriptTest, DrawsCellsWithEnoughResiduals) {
  const std::string script = ResidualPlotScript(
      test::PinholeCamera(), {{{100, 50}, {0.5, 0}, 5}, {{200, 60}, {0.1, 0.1}, 4}});
  EXPECT_THAT(script, testing::HasSubstr("\n100.00 50.00 26.667 0.000 5\n"));  // 640 px / 24.
  EXPECT_THAT(script, testing::Not(testing::HasSubstr("200.00")));
  EXPECT_THAT(script, testing::HasSubstr("with vectors"));
}

}  // namespace
}  // namespace corvo
