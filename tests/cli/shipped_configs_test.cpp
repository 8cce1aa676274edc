// SPDX-License-Identifier: MIT
#include <algorithm>
#include <fstream>
#include <vector>

#include <gmock/gmock.h>

#include "tests/cli/command.h"
#include "tests/cli/tiny_sequence.h"
#include "tests/data/data_path.h"
#include "tests/support/data.h"
#include "vo/io/config.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;

bool IsCamera(const fs::path& file) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind("model:", 0) == 0) return true;
  }
  return false;
}

/// Returns the names of the shipped camera files if `cameras`, else those of the option files.
std::vector<std::string> Shipped(bool cameras) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(SourceDir() / "configs")) {
    if (IsCamera(entry.path()) == cameras) names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string TestName(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class ShippedConfig : public testing::TestWithParam<std::string> {
 protected:
  const fs::path file_ = SourceDir() / "configs" / GetParam();
  TemporaryFolder folder_;
};

class ShippedOptions : public ShippedConfig {};
class ShippedCamera : public ShippedConfig {};

TEST_P(ShippedOptions, WorkWithEveryCommandThatAcceptsThem) {
  const fs::path images = folder_ / "images";
  const fs::path out = folder_ / "out";
  WriteFolder(images, 2);
  WriteText(folder_ / "camera.yaml",
            "model: pinhole-radtan\nwidth: 96\nheight: 64\nfx: 80\nfy: 80\ncx: 47.5\ncy: 31.5\n");
  const CommandResult config = RunCorvo({"config", "--print", file_});
  EXPECT_EQ(config.exit_code, 0) << config.err;
  EXPECT_EQ(config.out, WriteOptions(ReadOptions(file_)));
  const std::vector<std::string> tail = {"-o", out, "--config", file_};
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), tail.begin(), tail.end());
    return RunCorvo(arguments);
  };
  EXPECT_EQ(run({"features", images / "0.png"}).exit_code, 0);
  EXPECT_EQ(run({"match", images / "0.png", images / "1.png"}).exit_code, 0);
  const CommandResult result = run({"run", images, "--camera", folder_ / "camera.yaml"});
  EXPECT_EQ(result.exit_code, kNeverInitialized) << result.err;
  EXPECT_EQ(ReadText(out / "config.yaml"), config.out);
}

TEST_P(ShippedCamera, RunsOnImagesOfItsSize) {
  const Camera camera = ReadCameraFile(file_).camera;
  for (const int i : {0, 1}) {
    const cv::Mat image(camera.height(), camera.width(), CV_8UC1, cv::Scalar(100 + i));
    WriteImage(folder_ / "images" / (std::to_string(i) + ".png"), image);
  }
  const CommandResult result =
      RunCorvo({"run", folder_ / "images", "--camera", file_, "-o", folder_ / "out"});
  EXPECT_EQ(result.exit_code, kNeverInitialized) << result.err;
  EXPECT_THAT(result.err, testing::IsEmpty()) << "a warning about a shipped camera";
}

INSTANTIATE_TEST_SUITE_P(Configs, ShippedOptions, testing::ValuesIn(Shipped(false)), TestName);
INSTANTIATE_TEST_SUITE_P(Configs, ShippedCamera, testing::ValuesIn(Shipped(true)), TestName);

TEST(ShippedOptionsTest, Orb2011HasTheValuesOfTheArticle) {
  const auto options = ReadOptions(test::SourceDir() / "configs/orb_2011.yaml").extractor;
  EXPECT_EQ(options.num_features, 500);
  EXPECT_EQ(options.num_levels, 5);
  EXPECT_NEAR(options.scale_factor * options.scale_factor, 2, 1e-12);
  EXPECT_EQ(options.ranking, orb::Ranking::kHarris);
  EXPECT_FALSE(options.grid);
  EXPECT_EQ(options.orientation_bins, 30);
  EXPECT_EQ(options.fast_threshold, options.min_fast_threshold) << "only Harris ranks corners";
}

}  // namespace
}  // namespace corvo::test
