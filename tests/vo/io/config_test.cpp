// SPDX-License-Identifier: MIT
#include "vo/io/config.h"

#include <gmock/gmock.h>

#include <string>

#include "orb/pattern_file.h"
#include "tests/support/data.h"
#include "tests/support/matchers.h"

namespace corvo {
namespace {

using test::ThrowsError;

constexpr const char* kCamera =
    "model: pinhole-radtan\nwidth: 640\nheight: 480\nfx: 500\nfy: 510.5\ncx: 320\ncy: 240\n";

class OptionsFileTest : public ::testing::Test {
 protected:
  OdometryOptions Read(const std::string& text) const {
    return ReadOptions(dir_.Write("a.yaml", text));
  }

  test::TemporaryFolder dir_;
};

TEST_F(OptionsFileTest, OmittedKeysKeepTheirDefaults) {
  const OdometryOptions options = Read(
      "extractor:\n  num_features: 1234\n  scale_factor: 1.5\n  grid: false\n  ranking: harris\n");
  EXPECT_EQ(options.extractor.num_features, 1234);
  EXPECT_EQ(options.extractor.scale_factor, 1.5);
  EXPECT_EQ(options.extractor.grid, false);
  EXPECT_EQ(options.extractor.ranking, orb::Ranking::kHarris);
  EXPECT_EQ(options.extractor.num_levels, OdometryOptions().extractor.num_levels);
}

TEST_F(OptionsFileTest, EmptyFilesAndSectionsGiveTheDefaults) {
  const std::string defaults = WriteOptions({});
  EXPECT_EQ(WriteOptions(Read("")), defaults);
  EXPECT_EQ(WriteOptions(Read("# nothing\n")), defaults);
  EXPECT_EQ(WriteOptions(Read("extractor:\ninitializer:\n")), defaults);
}

TEST_F(OptionsFileTest, WholeNumbersAreAcceptedAsRealNumbers) {
  EXPECT_EQ(Read("extractor: {scale_factor: 2}").extractor.scale_factor, 2);
}

TEST_F(OptionsFileTest, WrittenOptionsReadBackTheSame) {
  OdometryOptions options;
  options.extractor.num_features = 777;
  options.extractor.scale_factor = 1.2345678901234567;
  options.extractor.ranking = orb::Ranking::kHarris;
  options.extractor.upright = true;
  options.initializer.min_matches = 21;
  const std::string text = WriteOptions(options);
  const OdometryOptions back = Read(text);
  EXPECT_EQ(back.extractor.scale_factor, options.extractor.scale_factor);
  EXPECT_EQ(back.initializer.min_matches, 21);
  EXPECT_EQ(WriteOptions(back), text);
  EXPECT_NE(text, WriteOptions({}));
}

TEST_F(OptionsFileTest, PatternsAreGivenByNameOrFile) {
  const std::string file =
      dir_.Write("123 # no comment: a pattern", orb::PatternText(orb::MakeBriefPattern(1)))
          .string();
  OdometryOptions options;
  options.extractor.pattern = file;
  EXPECT_EQ(Read(WriteOptions(options)).extractor.pattern, file);
  EXPECT_EQ(Read("extractor: {pattern: brief}").extractor.pattern, "brief");
  EXPECT_EQ(Read("extractor: {pattern: \"brief\"}").extractor.pattern, "brief");
}

TEST_F(OptionsFileTest, PatternsThatCannotBeLoadedAreErrors) {
  EXPECT_THAT([&] { Read("extractor: {pattern: biref}"); },
              ThrowsError("a.yaml: extractor.pattern: \"biref\"; allowed is learned, brief"));
  EXPECT_THAT([&] { Read("extractor:\n  pattern: []\n"); },
              ThrowsError("a.yaml:2: extractor.pattern", "allowed is binary tests: learned"));
  EXPECT_THAT([&] { Read("extractor:\n  pattern:\n"); }, ThrowsError("a.yaml:2: ", "is empty"));
  EXPECT_THAT([&] { Read("extractor:\n  pattern: ''\n"); }, ThrowsError("a.yaml:2: ", "is \"\""));
  const std::string bad = dir_.Write("bad.inc", "// nothing\n1, 2, 3,\n").string();
  EXPECT_THAT([&] { Read("extractor: {pattern: " + bad + "}"); },
              ThrowsError("a.yaml: extractor.pattern: ", "bad.inc:2: "));
}

TEST_F(OptionsFileTest, UnknownKeysAreNamedWithTheNearestKnown) {
  EXPECT_THAT([&] { Read("extractor:\n  num_levels: 8\n  num_feature: 5\n"); },
              ThrowsError("a.yaml:3: ", "unknown key extractor.num_feature;",
                          "nearest known key is extractor.num_features"));
  EXPECT_THAT([&] { Read("\nextracter:\n  num_levels: 8\n"); },
              ThrowsError("a.yaml:2: ", "unknown key extracter", "is extractor"));
}

TEST_F(OptionsFileTest, ErrorsOfRenamedKeysGiveTheirNewNames) {
  EXPECT_THAT([&] { Read("tracker:\n  max_distance: 80\n"); },
              ThrowsError("a.yaml:2: the key tracker.max_distance is now "
                          "matching.max_tracking_distance"));
  EXPECT_THAT([&] { Read("keyframes:\n  min_found_share: 0.2\n"); },
              ThrowsError("is now CullingOptions::min_found_share in C++"));
}

TEST_F(OptionsFileTest, KeysGivenTwiceAreErrors) {
  EXPECT_THAT([&] { Read("extractor:\n  num_levels: 8\n  num_levels: 8\n"); },
              ThrowsError("a.yaml:3: ", "extractor.num_levels is given twice"));
  EXPECT_THAT([&] { Read("extractor:\n  num_levels: 8\nextractor:\n  grid: true\n"); },
              ThrowsError("a.yaml:3: ", "extractor is given twice"));
}

TEST_F(OptionsFileTest, WrongTypesAreErrors) {
  const auto expect_error = [&](const std::string& field, const std::string& allowed) {
    EXPECT_THAT([&] { Read("extractor:\n  " + field + "\n"); },
                ThrowsError("a.yaml:2: extractor.", allowed))
        << field;
  };
  expect_error("num_levels: eight", "num_levels is \"eight\"; allowed is a whole number");
  expect_error("num_levels: 8.5", "a whole number");
  expect_error("num_levels: \"8\"", "a whole number");
  expect_error("num_levels: [8]", "is a list or mapping; allowed is a whole number");
  expect_error("num_levels:", "is empty; allowed is a whole number");
  expect_error("num_levels: 99999999999999", "a whole number");
  expect_error("scale_factor: 1.2x", "a number");
  expect_error("scale_factor: true", "a number");
  expect_error("grid: 1", "true or false");
  expect_error("grid: yes", "true or false");
  expect_error("ranking: shi", "fast (score) or harris (response)");
}

TEST_F(OptionsFileTest, ValuesOutOfRangeAreErrors) {
  EXPECT_THAT([&] { Read("extractor:\n  num_levels: 0\n"); },
              ThrowsError("a.yaml:2: extractor.num_levels is 0; allowed is 1 to 32"));
  EXPECT_THAT([&] { Read("extractor:\n  scale_factor: nan\n"); },
              ThrowsError("a.yaml:2: extractor.scale_factor is nan"));
  EXPECT_THAT([&] { Read("extractor: {fast_threshold: 10, min_fast_threshold: 11}"); },
              ThrowsError("a.yaml: extractor.min_fast_threshold is 11"));
}

TEST_F(OptionsFileTest, FilesThatAreNotMappingsAreErrors) {
  EXPECT_THAT([&] { Read("- a\n- b\n"); }, ThrowsError("a.yaml", "key: value"));
  EXPECT_THAT([&] { Read("extractor: 5\n"); }, ThrowsError("a.yaml:1: extractor", "key: value"));
  EXPECT_THAT([&] { Read("extractor:\n  [unclosed\n"); }, ThrowsError("a.yaml:"));
  EXPECT_THAT([&] { Read("&a,"); }, ThrowsError("a.yaml:1: "));
  EXPECT_THAT([&] { Read("{[1, 2]: 3}\n"); }, ThrowsError("a.yaml:1: "));
  EXPECT_THAT([&] { Read("extractor:\n---\nextractor:\n"); },
              ThrowsError("more than one document"));
  EXPECT_THAT([&] { ReadOptions(dir_.path() / "none.yaml"); }, ThrowsError("none.yaml"));
  EXPECT_THAT([&] { ReadOptions(dir_.path()); }, ThrowsError(dir_.path().string()));
}

TEST(DefaultConfigTest, EqualsTheWrittenDefaults) {
  EXPECT_EQ(test::ReadText(test::SourceDir() / "configs" / "default.yaml"), WriteOptions({}))
      << "regenerate configs/default.yaml: corvo config > configs/default.yaml";
}

TEST(DefaultConfigTest, ReadsBackAsTheDefaults) {
  const auto options = ReadOptions(test::SourceDir() / "configs" / "default.yaml");
  EXPECT_EQ(WriteOptions(options), WriteOptions({}));
}

class CameraFileTest : public ::testing::Test {
 protected:
  CameraFile Read(const std::string& text) const {
    return ReadCameraFile(dir_.Write("cam.yaml", text));
  }

  test::TemporaryFolder dir_;
};

TEST_F(CameraFileTest, DistortionFrameRateAndSourceAreOptional) {
  const CameraFile file = Read(kCamera);
  EXPECT_EQ(file.camera.width(), 640);
  EXPECT_EQ(file.camera.fy(), 510.5);
  EXPECT_EQ(file.camera.parameters().k1, 0);
  EXPECT_EQ(file.frame_rate_hz, std::nullopt);
  EXPECT_EQ(file.source, "");
}

TEST_F(CameraFileTest, ReadsEveryKey) {
  const CameraFile file = Read(std::string(kCamera) +
                               "k1: 0.1\nk2: -0.2\np1: 1e-3\np2: 0.004\nk3: 5\n"
                               "frame_rate_hz: 29.97\nsource: \"a paper: table 1\"\n");
  const CameraParameters& p = file.camera.parameters();
  EXPECT_THAT((std::vector<double>{p.k1, p.k2, p.p1, p.p2, p.k3}),
              ::testing::ElementsAre(0.1, -0.2, 1e-3, 0.004, 5));
  EXPECT_EQ(file.frame_rate_hz, 29.97);
  EXPECT_EQ(file.source, "a paper: table 1");
}

TEST_F(CameraFileTest, WrittenCamerasReadBackTheSame) {
  CameraFile file = Read(std::string(kCamera) + "k1: 0.1234567890123\nframe_rate_hz: 10\n");
  for (const std::string source :
       {"", "plain", "a: b # c", "two\nlines", "\"quoted\" 'twice'", "12"}) {
    file.source = source;
    const CameraFile back = Read(WriteCameraFile(file));
    EXPECT_EQ(back.camera, file.camera);
    EXPECT_EQ(back.frame_rate_hz, file.frame_rate_hz);
    EXPECT_EQ(back.source, source);
  }
}

TEST_F(CameraFileTest, SigmasDefineTheCameraPrior) {
  const CameraFile file = Read(std::string(kCamera) + "sigma: {k2: 0.02, focal: 0.003, cx: 1.5}\n");
  EXPECT_EQ(file.sigma, (std::vector<FreeParameter>{{"focal", 0.003}, {"cx", 1.5}, {"k2", 0.02}}));
  EXPECT_EQ(file.Prior({}), (CameraPrior{file.camera.parameters(), *file.sigma}));
  EXPECT_EQ(Read(WriteCameraFile(file)).sigma, file.sigma);
  const CameraFile exact = Read(std::string(kCamera) + "sigma: {}\n");
  EXPECT_EQ(exact.Prior({}).num_free(), 0);
  EXPECT_EQ(Read(WriteCameraFile(exact)).sigma, exact.sigma);
  const CameraFile unsaid = Read(kCamera);
  EXPECT_EQ(unsaid.sigma, std::nullopt);
  EXPECT_EQ(unsaid.Prior({}), MakePrior(unsaid.camera.parameters(), {}));
}

TEST_F(CameraFileTest, WrongSigmasAreErrors) {
  const auto expect_error = [&](const std::string& sigma, const std::string& message) {
    EXPECT_THAT([&] { Read(kCamera + ("sigma: " + sigma) + "\n"); },
                ThrowsError("cam.yaml:8: sigma" + message));
  };
  expect_error("0.01", " must hold \"key: value\" lines");
  expect_error("{k1: 0}", ".k1 is 0; allowed is 1e-12 to 1e+06");
  expect_error("{k1: much}", ".k1 is \"much\"; allowed is a number");
  expect_error("{focal: 0.01, fy: 2}", ": camera prior: fy is free twice");
  EXPECT_THAT([&] { Read(std::string(kCamera) + "sigma: {omega: 0.1}\n"); },
              ThrowsError("cam.yaml:8: unknown key sigma.omega"));
}

TEST_F(CameraFileTest, MissingRequiredKeysAreNamed) {
  for (const std::string key : {"model", "width", "height", "fx", "fy", "cx", "cy"}) {
    std::string text = kCamera;
    const std::size_t begin = text.find(key + ":");
    text.erase(begin, text.find('\n', begin) + 1 - begin);
    EXPECT_THAT([&] { Read(text); }, ThrowsError("cam.yaml: " + key + " is missing"));
  }
  EXPECT_THAT([&] { Read(""); }, ThrowsError("is missing"));
}

TEST_F(CameraFileTest, WrongValuesAreErrors) {
  const auto expect_error = [&](const std::string& line, const std::string& message) {
    EXPECT_THAT([&] { Read(kCamera + line + "\n"); }, ThrowsError("cam.yaml:8: " + message));
  };
  expect_error("k5: 0", "unknown key k5; the nearest known key is k");
  expect_error("fx: 500", "fx is given twice");
  expect_error("k1: much", "k1 is \"much\"; allowed is a number");
  expect_error("k1: 1e9", "k1 is 1e+09; allowed is -1000 to 1000");
  expect_error("frame_rate_hz: 0", "frame_rate_hz is 0; allowed is 0.001 to 100000");
  expect_error("frame_rate_hz: -30", "frame_rate_hz is -30");
  expect_error("source: [a]", "source must be text");
  EXPECT_THAT(
      [&] { Read("model: fisheye\nwidth: 640\n"); },
      ThrowsError("cam.yaml:1: model", "\"fisheye\"", "allowed is pinhole-radtan, kb4 or fov"));
}

TEST_F(CameraFileTest, EveryModelReadsBackTheSame) {
  const std::string size = "width: 640\nheight: 480\nfx: 200\nfy: 201\ncx: 320\ncy: 240\n";
  for (const std::string& text :
       {"model: pinhole\n" + size + "k1: 0.1\np2: 0.2\n",
        "model: kb4\n" + size + "k1: 0.01\nk2: 0.02\nk3: 0.03\nk4: 0.04\n",
        "model: fov\n" + size + "omega: 0.9\n"}) {
    const CameraFile file = Read(text);
    EXPECT_EQ(Read(WriteCameraFile(file)).camera, file.camera) << text;
  }
  const CameraFile kb4 = Read("model: kb4\n" + size + "k4: 0.04\np1: 0\n");
  EXPECT_EQ(kb4.camera.parameters().model, CameraModel::kKb4);
  EXPECT_EQ(kb4.camera.parameters().k4, 0.04);
  EXPECT_THAT(WriteCameraFile(kb4), ::testing::AllOf(::testing::HasSubstr("k4: 0.04"),
                                                     ::testing::Not(::testing::HasSubstr("p1"))));
}

TEST_F(CameraFileTest, DistortionOfAnotherModelIsAnError) {
  EXPECT_THAT([&] { Read(std::string(kCamera) + "omega: 0.9\n"); },
              ThrowsError("cam.yaml: camera.omega is 0.9", "pinhole-radtan has no such parameter"));
}

CameraFile Shipped(const std::string& name) {
  return ReadCameraFile(test::SourceDir() / "configs" / (name + ".yaml"));
}

TEST(ShippedCamerasTest, CoverTheImageUpToItsEdges) {
  for (const char* name : {"7scenes", "euroc", "kitti_00-02", "kitti_03", "kitti_04-12", "tum_fr1",
                           "tum_fr2", "tum_fr3", "tum_mono", "tumvi"}) {
    const CameraFile file = Shipped(name);
    EXPECT_FALSE(file.source.empty()) << name;
    const Camera& camera = file.camera;
    for (const Eigen::Vector2d& pixel :
         {Eigen::Vector2d(0, camera.cy()), Eigen::Vector2d(camera.width() - 1, camera.cy()),
          Eigen::Vector2d(camera.cx(), 0), Eigen::Vector2d(camera.cx(), camera.height() - 1)}) {
      EXPECT_TRUE(camera.Undistort(pixel)) << name << " at " << pixel.transpose();
    }
  }
}

TEST(ShippedCamerasTest, HaveThePublishedParameters) {
  EXPECT_EQ(Shipped("tum_fr1").camera.fx(), 517.306408);
  EXPECT_EQ(Shipped("tum_fr1").camera.parameters().k3, 1.163314);
  EXPECT_EQ(Shipped("tum_fr1").frame_rate_hz, 30);
  EXPECT_EQ(Shipped("7scenes").camera.fx(), 585);
  EXPECT_EQ(Shipped("tumvi").camera.parameters().model, CameraModel::kKb4);
  EXPECT_EQ(Shipped("tumvi").camera.parameters().k4, 0.00020293673591811182);
  // camera.txt gives the values in units of the image size: 0.535719308086809 0.669566858850269 ...
  const Camera tum_mono = Shipped("tum_mono").camera;
  EXPECT_EQ(tum_mono.parameters().model, CameraModel::kFov);
  EXPECT_DOUBLE_EQ(tum_mono.fx(), 1280 * 0.535719308086809);
  EXPECT_DOUBLE_EQ(tum_mono.fy(), 1024 * 0.669566858850269);
  EXPECT_DOUBLE_EQ(tum_mono.cx(), 1280 * 0.493248545285398 - 0.5);
  EXPECT_DOUBLE_EQ(tum_mono.cy(), 1024 * 0.500408664348414 - 0.5);
}

}  // namespace
}  // namespace corvo
