// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "apps/dataset/image_source.h"
#include "apps/export/run_result.h"
#include "apps/output/map_ply.h"
#include "apps/output/observation_table.h"
#include "apps/synthetic/sequence.h"
#include "tests/cli/command.h"
#include "tests/cli/expect_error.h"
#include "tests/cli/tiny_sequence.h"
#include "tests/support/data.h"
#include "vo/io/config.h"
#include "vo/io/text_lines.h"
#include "vo/io/trajectory_io.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 40;

/// Returns the number of lines that are not comments.
int CountPoses(const fs::path& file) {
  std::istringstream text(ReadText(file));
  int count = 0;
  for (std::string line; std::getline(text, line);) count += line.front() == '#' ? 0 : 1;
  return count;
}

/// Returns the lines that are not comments.
std::vector<std::string> LinesOf(const fs::path& file) {
  std::istringstream text(ReadText(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    if (line.empty() || line.front() != '#') lines.push_back(line);
  }
  return lines;
}

/// Returns the numbers at the start of a line.
std::vector<double> NumbersOf(const std::string& line) {
  std::istringstream text(line);
  return {std::istream_iterator<double>(text), std::istream_iterator<double>()};
}

/// Returns the z coordinate of the first point of a map.
double FirstVertex(const fs::path& ply) { return ReadMapPly(ply).front().in_world.z(); }

/// A fixture that runs `corvo synth`, `run` and `eval` one after the other on a rendered street.
class Pipeline : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    const CommandResult result = RunCorvo(
        {"synth", "street", "-o", *folder_ / "street", "--frames", "40", "--width", "465"});
    ASSERT_EQ(result.exit_code, kDone) << result.err;
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static CommandResult RunOn(const fs::path& input, const fs::path& result,
                             const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"run", input, "-o", result};
    arguments.insert(arguments.end(), {"--camera", *folder_ / "street/camera.yaml"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCorvo(arguments);
  }

  static fs::path Street() { return *folder_ / "street"; }
  /// Returns the result folder of a run with ground truth and one thread. The first call runs it.
  static fs::path Result() {
    const fs::path result = *folder_ / "result";
    if (!fs::exists(result)) {
      EXPECT_EQ(RunOn(Street(), result, {"--gt", Truth(), "--threads", "1"}).exit_code, kDone);
    }
    return result;
  }
  static fs::path Truth() { return Street() / "groundtruth.txt"; }

  /// Runs a script of the tests with the packages of the development environment.
  static CommandResult RunPython(const std::vector<std::string>& arguments) {
    const fs::path python = SourceDir() / ".venv" / "bin" / "python";
    if (!fs::exists(python)) return {};
    return RunProgram(python, arguments,
                      {"HOME=" + folder_->path().string(), "PATH=/usr/bin:/bin"});
  }
  static bool HasPythonPackage(const std::string& name) {
    return fs::exists(SourceDir() / ".venv") && RunPython({"-c", "import " + name}).exit_code == 0;
  }

  static std::unique_ptr<TemporaryFolder> folder_;
};

std::unique_ptr<TemporaryFolder> Pipeline::folder_;

TEST_F(Pipeline, TracksEveryFrameOfAStreet) {
  EXPECT_EQ(CountPoses(Result() / "trajectory.tum"), kFrames);
  const auto summary = nlohmann::json::parse(ReadText(Result() / "summary.json"));
  EXPECT_EQ(summary["posed"], kFrames);
  ASSERT_EQ(summary["segments"].size(), 1u);
  EXPECT_EQ(summary["segments"][0]["num_poses"], kFrames);
  EXPECT_EQ(summary["segments"][0]["scale"]["from"], "arbitrary");
  EXPECT_EQ(CountLines(ReadText(Result() / "trajectory.tum")), kFrames + 1) << "no further comment";
  EXPECT_LT(summary["evaluation"]["ate"]["percent_of_path"], 0.5);
  EXPECT_EQ(summary["trajectory_kitti"], "written");
  EXPECT_EQ(ReadKittiPoses(Result() / "trajectory.kitti").size(), kFrames);
  EXPECT_EQ(ReadTum(Result() / "rotations.tum").size(), kFrames);
  EXPECT_EQ(summary["rotations"], kFrames);
  EXPECT_LT(summary["rotation_over_1s_deg"]["rmse"], 0.5);
  EXPECT_EQ(ReadEurocPoses(Result() / "trajectory_euroc.csv").size(), kFrames);
  EXPECT_EQ(ReadMapPly(Result() / "map.ply").size(), summary["landmarks"]);
}

TEST_F(Pipeline, QuietAndVerboseRunsAndJson) {
  const fs::path quiet = *folder_ / "quiet";
  const CommandResult result = RunOn(Street(), quiet, {"--quiet", "--count", "20"});
  EXPECT_EQ(result.exit_code, kDone);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(
      RunOn(Street(), quiet, {"--verbose", "--count", "20"}).err,
      testing::AllOf(testing::HasSubstr("layout tum, 20 images"), testing::HasSubstr("465 x ")));
  const CommandResult json = RunOn(Street(), quiet, {"--json", "--count", "20"});
  EXPECT_EQ(json.out, ReadText(quiet / "summary.json"));
}

TEST_F(Pipeline, AnInputAloneIsRunWithoutACalibration) {
  const std::string command =
      fmt::format("cd '{}' && '{}' street/rgb --count 20", folder_->path().string(), CORVO_COMMAND);
  const CommandResult result = RunProgram("/bin/sh", {"-c", command}, {"PATH=/usr/bin:/bin"});
  EXPECT_THAT(result.err, testing::HasSubstr("corvo: info: corvo run street/rgb --count 20 --focal "
                                             "auto -o rgb.corvo\n"));
  EXPECT_TRUE(fs::exists(*folder_ / "rgb.corvo/summary.json"));
}

/// Returns the camera's depth of a point of images.txt: "id qw qx qy qz tx ty tz camera name".
double DepthIn(const std::vector<double>& image, const Eigen::Vector3d& point) {
  const Eigen::Quaterniond rotation(image[1], image[2], image[3], image[4]);
  return (rotation * point).z() + image[7];
}

/// Returns whether a depth is within 2% of that of a pixel or, at the edge of a surface, of one of
/// its neighbors. COLMAP's pixel (0.5, 0.5) is the center of the first one.
bool IsOnSurface(double depth, const cv::Mat& true_depth, double x, double y) {
  for (int row = static_cast<int>(y) - 1; row <= static_cast<int>(y) + 1; ++row) {
    for (int column = static_cast<int>(x) - 1; column <= static_cast<int>(x) + 1; ++column) {
      if (row < 0 || column < 0 || row >= true_depth.rows || column >= true_depth.cols) continue;
      const double expected = true_depth.at<float>(row, column);
      if (std::abs(depth - expected) < 0.02 * expected) return true;
    }
  }
  return false;
}

TEST_F(Pipeline, ExportedPointsLieOnTheRenderedSurfaces) {
  const fs::path room = *folder_ / "room", result = *folder_ / "room_result";
  const fs::path model = *folder_ / "room_model";
  synthetic::SequenceOptions options;
  options.frames = 80;
  const synthetic::Sequence sequence = synthetic::MakeRoom(options);
  ASSERT_EQ(RunCorvo({"synth", "room", "-o", room, "--frames", "80"}).exit_code, kDone);
  ASSERT_EQ(RunCorvo({"run", room, "--camera", room / "camera.yaml", "-o", result}).exit_code, 0);
  ASSERT_EQ(RunCorvo({"export", result, "--to", "colmap", "-o", model, "--text"}).exit_code, 0);
  std::map<long, Eigen::Vector3d> points;
  for (const std::string& line : LinesOf(model / "sparse/0/points3D.txt")) {
    const std::vector<double> fields = NumbersOf(line);
    points[std::lround(fields[0])] = {fields[1], fields[2], fields[3]};
  }
  const auto summary = nlohmann::json::parse(ReadText(result / "summary.json"));
  const double scale = summary["evaluation"]["truth_from_estimate"]["scale"];
  std::map<long, bool> is_right;  // In the first image that observes the point.
  const std::vector<std::string> lines = LinesOf(model / "sparse/0/images.txt");
  for (std::size_t i = 0; i + 1 < lines.size(); i += 2) {
    const std::vector<double> image = NumbersOf(lines[i]);
    const std::string time_s = fs::path(lines[i].substr(lines[i].rfind('/') + 1)).stem().string();
    const int frame = static_cast<int>(std::lround(std::stod(time_s) * sequence.frame_rate_hz()));
    const cv::Mat true_depth = sequence.RenderDepth(frame);
    const std::vector<double> observed = NumbersOf(lines[i + 1]);  // x, y and point of each.
    for (std::size_t k = 0; k + 2 < observed.size(); k += 3) {
      const auto point = points.find(std::lround(observed[k + 2]));
      if (point == points.end()) continue;
      const double depth = scale * DepthIn(image, point->second);
      is_right.try_emplace(point->first,
                           IsOnSurface(depth, true_depth, observed[k], observed[k + 1]));
    }
  }
  const auto num_right = std::ranges::count_if(is_right, [](const auto& p) { return p.second; });
  EXPECT_GT(points.size(), 300u);
  EXPECT_GT(static_cast<double>(num_right), 0.9 * static_cast<double>(points.size()));
  RecordProperty("share_right", std::to_string(double(num_right) / double(points.size())));
}

TEST_F(Pipeline, EvalAgreesWithRun) {
  const CommandResult eval = RunCorvo({"eval", Result() / "trajectory.tum", Truth(), "--json"});
  const auto measured = nlohmann::json::parse(eval.out);
  const CommandResult again = RunCorvo({"eval", Result(), Result() / "groundtruth.tum", "--json"});
  EXPECT_EQ(nlohmann::json::parse(again.out)["ate"], measured["ate"]);
  const auto summary = nlohmann::json::parse(ReadText(Result() / "summary.json"));
  EXPECT_NEAR(measured["ate"]["rmse"], summary["evaluation"]["ate"]["rmse"], 1e-9);
}

TEST_F(Pipeline, WritesMetersAndDrawsTracks) {
  const fs::path scaled = *folder_ / "scaled";
  ASSERT_EQ(
      RunOn(Street(), scaled, {"--meters-per-unit", "4", "--draw", *folder_ / "tracks"}).exit_code,
      kDone);
  for (const char* name : {"trajectory.tum", "keyframes.tum"}) {
    const PoseSequence units = ReadTum(Result() / name), meters = ReadTum(scaled / name);
    ASSERT_EQ(meters.size(), units.size());
    EXPECT_EQ(meters.back().world_from_camera.translation(),
              4 * units.back().world_from_camera.translation());
    EXPECT_EQ(meters.back().world_from_camera.rotation().quaternion().coeffs(),
              units.back().world_from_camera.rotation().quaternion().coeffs());
  }
  EXPECT_EQ(ReadKittiPoses(scaled / "trajectory.kitti").back().translation(),
            4 * ReadKittiPoses(Result() / "trajectory.kitti").back().translation());
  EXPECT_NEAR(FirstVertex(scaled / "map.ply"), 4 * FirstVertex(Result() / "map.ply"), 1e-6);
  const auto summary = nlohmann::json::parse(ReadText(scaled / "summary.json"));
  EXPECT_EQ(summary["meters_per_unit"], 4.0);
  const fs::path images = *folder_ / "tracks";
  EXPECT_EQ(std::distance(fs::directory_iterator(images), fs::directory_iterator()), kFrames + 1)
      << "and the manifest";
}

/// Evaluates a result without a similarity: lengths must be in meters. Returns the ATE.
double MetricError(const fs::path& result, const fs::path& truth) {
  const CommandResult eval = RunCorvo({"eval", result, truth, "--align", "se3", "--json"});
  EXPECT_EQ(eval.exit_code, kDone) << eval.err;
  return nlohmann::json::parse(eval.out)["ate"]["rmse"];
}

TEST_F(Pipeline, AKnownCameraHeightMakesLengthsMeters) {
  CORVO_SKIP_IF_SHORT();
  const fs::path street = *folder_ / "wide_street", result = *folder_ / "height";
  ASSERT_EQ(
      RunCorvo({"synth", "street", "-o", street, "--frames", "60", "--width", "930"}).exit_code,
      kDone);
  const CommandResult run = RunCorvo(
      {"run", street, "-o", result, "--camera", street / "camera.yaml", "--camera-height", "1.65"});
  ASSERT_EQ(run.exit_code, kDone) << run.err;
  EXPECT_THAT(run.out, testing::HasSubstr("in meters, scale from the height of the camera, ± "));
  EXPECT_LT(MetricError(result, street / "groundtruth.txt"), 0.02 * 47) << "of a path of 47 m";
  const auto summary = nlohmann::json::parse(ReadText(result / "summary.json"));
  EXPECT_EQ(summary["camera_height"], 1.65);
  EXPECT_EQ(summary["segments"][0]["scale"]["from"], "camera_height");
  EXPECT_EQ(LinesOf(result / "metric_scale.csv").size(), 61);
}

TEST_F(Pipeline, WithoutAVisibleGroundLengthsStayInUnits) {
  const fs::path result = *folder_ / "no_ground";  // These images are too small for it.
  const CommandResult run = RunOn(Street(), result, {"--camera-height", "1.65"});
  EXPECT_EQ(run.exit_code, kDone);
  EXPECT_THAT(run.err, testing::HasSubstr("the lengths of segment 0 are not in meters: no ground"));
  EXPECT_EQ(ReadText(result / "trajectory.tum"), ReadText(Result() / "trajectory.tum"));
}

TEST_F(Pipeline, AKnownCameraHeightHoldsTheScaleOfARealDrive) {
  CORVO_REQUIRE_DATA("kitti/sequences/03");
  CORVO_SKIP_IF_SHORT();
  const fs::path result = *folder_ / "kitti_03";
  ASSERT_EQ(
      RunCorvo({"run", DataPath("kitti/sequences/03"), "-o", result, "--camera-height", "1.65"})
          .exit_code,
      kDone);
  const CommandResult eval = RunCorvo({"eval", result, "--align", "se3", "--json"});
  const auto errors = nlohmann::json::parse(eval.out);
  EXPECT_LT(errors["kitti"]["t_rel_percent"], 2);
}

TEST_F(Pipeline, AKnownDistanceMakesLengthsMeters) {
  const PoseSequence truth = ReadTum(Truth());
  const double meters =
      (truth[30].world_from_camera.translation() - truth[5].world_from_camera.translation()).norm();
  const fs::path result = *folder_ / "distance";
  ASSERT_EQ(RunOn(Street(), result, {"--known-distance", fmt::format("5,30,{}", meters)}).exit_code,
            kDone);
  EXPECT_LT(MetricError(result, Truth()), 0.02 * 30);
}

/// Returns "FRAME,X,Y,X,Y" for two points in the true camera of a frame.
std::string ViewOf(const Camera& camera, const PoseSequence& truth, int frame,
                   const std::vector<Eigen::Vector3d>& ends) {
  std::string text = fmt::format("{}", frame);
  for (const Eigen::Vector3d& end : ends) {
    const auto pixel = camera.Project(truth[frame].world_from_camera.Inverse() * end);
    text += fmt::format(",{:.1f},{:.1f}", pixel->x(), pixel->y());
  }
  return text;
}

TEST_F(Pipeline, KnownSizesMakeLengthsMeters) {
  const PoseSequence truth = ReadTum(Truth());
  const Camera camera = ReadCameraFile(Street() / "camera.yaml").camera;
  const fs::path result = *folder_ / "sizes";
  std::vector<std::string> options;
  for (const int frame : {0, 25}) {
    const SE3& world_from_camera = truth[frame].world_from_camera;
    const std::vector<Eigen::Vector3d> ends = {world_from_camera * Eigen::Vector3d(-2, 0, 14),
                                               world_from_camera * Eigen::Vector3d(2, -1, 15)};
    options.insert(options.end(),
                   {"--known-size", fmt::format("{},{},{}", ViewOf(camera, truth, frame, ends),
                                                ViewOf(camera, truth, frame + 10, ends),
                                                (ends[0] - ends[1]).norm())});
  }
  const CommandResult run = RunOn(Street(), result, options);
  ASSERT_EQ(run.exit_code, kDone) << run.err;
  EXPECT_THAT(run.out, testing::HasSubstr("in meters, scale from the size of an object, ± "));
  EXPECT_LT(MetricError(result, Truth()), 0.02 * 30);
  const auto summary = nlohmann::json::parse(ReadText(result / "summary.json"));
  EXPECT_EQ(summary["known_size"], nlohmann::json({options[1], options[3]}));
  EXPECT_EQ(summary["segments"][0]["scale"]["from"], "known_size");
}

TEST_F(Pipeline, AMalformedKnownSizeIsAnErrorBeforeTheRun) {
  for (const char* text : {"", "1,2,3,4,5,6", "1,2,3,4,5,6,7,8,9,x,1", "1,2,3,4,5,6,7,8,9,10,0",
                           "1,2,3,4,5,6,7,8,9,10,11,12"}) {
    const CommandResult run = RunOn(Street(), *folder_ / "malformed", {"--known-size", text});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.err, testing::HasSubstr("--known-size")) << text;
    EXPECT_FALSE(fs::exists(*folder_ / "malformed"));
  }
}

TEST_F(Pipeline, ADistanceThatDeterminesNoScaleIsAWarning) {
  const fs::path result = *folder_ / "no_distance";
  const CommandResult run = RunOn(Street(), result, {"--known-distance", "5,300,2"});
  EXPECT_EQ(run.exit_code, kDone);
  EXPECT_THAT(run.err, testing::HasSubstr("known distance: frame 300 is not one of 0 to 39"));
  EXPECT_EQ(ReadText(result / "trajectory.tum"), ReadText(Result() / "trajectory.tum"));
}

TEST_F(Pipeline, OneScaleOnlyCanBeGiven) {
  const CommandResult run = RunOn(Street(), *folder_ / "two_scales",
                                  {"--known-distance", "5,30,2", "--camera-height", "1"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_FALSE(fs::exists(*folder_ / "two_scales"));
}

TEST_F(Pipeline, WritesTheEstimatedCameraWithStandardDeviations) {
  const auto summary = nlohmann::json::parse(ReadText(Result() / "summary.json"));
  const CameraFile found = ReadCameraFile(Result() / "camera_estimated.yaml");
  ASSERT_TRUE(found.sigma);
  ASSERT_EQ(found.sigma->size(), 7);
  EXPECT_EQ(found.sigma->front().name, "focal");
  EXPECT_EQ(found.camera.parameters().k1, summary["calibration"]["k1"]["value"]);
  const auto k1 = std::ranges::find(*found.sigma, "k1", &FreeParameter::name);
  ASSERT_NE(k1, found.sigma->end());
  EXPECT_EQ(k1->sigma, summary["calibration"]["k1"]["sigma"]);
  EXPECT_LT(k1->sigma, CalibrationOptions().k1_sigma);
}

TEST_F(Pipeline, WritesHowTheEstimateOfTheCameraChanged) {
  const std::vector<TextLine> lines = ReadTextLines(Result() / "camera_history.csv");
  ASSERT_GE(lines.size(), 3);
  const std::vector<std::string> names = SplitFields(lines.front().text);
  const auto column = [&](const char* name) {
    return std::ranges::find(names, name) - names.begin();
  };
  const auto number = [&](const TextLine& line, const char* name) {
    return std::stod(SplitFields(line.text).at(column(name)));
  };
  const auto summary = nlohmann::json::parse(ReadText(Result() / "summary.json"));
  const auto& k1 = summary["calibration"]["k1"];
  EXPECT_EQ(number(lines[1], "index"), 0);
  EXPECT_EQ(number(lines[1], "k1"), k1["given"]);
  EXPECT_EQ(number(lines[1], "k1_sigma"), CalibrationOptions().k1_sigma);
  EXPECT_NEAR(number(lines.back(), "k1"), k1["value"], 1e-8);
  EXPECT_NEAR(number(lines.back(), "k1_sigma"), k1["sigma"], 1e-6);
  for (std::size_t i = 2; i < lines.size(); ++i) {
    EXPECT_GT(number(lines[i], "index"), number(lines[i - 1], "index"));
    EXPECT_LE(number(lines[i], "k1_sigma"), 1.001 * number(lines[i - 1], "k1_sigma"));
  }
}

TEST_F(Pipeline, FixedCameraIsNotEstimated) {
  const fs::path fixed = *folder_ / "fixed";
  const CommandResult run = RunOn(Street(), fixed, {"--calibration", "fixed"});
  ASSERT_EQ(run.exit_code, kDone) << run.err;
  const auto summary = nlohmann::json::parse(ReadText(fixed / "summary.json"));
  EXPECT_TRUE(summary["calibration"].is_null());
  EXPECT_FALSE(fs::exists(fixed / "camera_history.csv"));
  const CameraFile found = ReadCameraFile(fixed / "camera_estimated.yaml");
  EXPECT_EQ(found.camera.fx(), summary["camera"]["fx"]);
  EXPECT_EQ(found.sigma, std::vector<FreeParameter>());
  EXPECT_EQ(ReadOptions(fixed / "config.yaml").calibration.enabled, false);
}

TEST_F(Pipeline, RefineChangesTheWrittenResults) {
  const fs::path refined = *folder_ / "refined", again = *folder_ / "refined_again";
  const CommandResult run = RunOn(Street(), refined, {"--gt", Truth(), "--refine"});
  ASSERT_EQ(run.exit_code, kDone) << run.err;
  EXPECT_THAT(run.out, testing::ContainsRegex("\nrefined: robust cost [0-9.]+ -> [0-9.]+ over "));
  const auto summary = nlohmann::json::parse(ReadText(refined / "summary.json"));
  const auto plain = nlohmann::json::parse(ReadText(Result() / "summary.json"));
  EXPECT_FALSE(plain.contains("refinement"));
  EXPECT_EQ(summary["refinement"]["refined"], true);
  EXPECT_LT(summary["refinement"]["cost_after"], summary["refinement"]["cost_before"]);
  EXPECT_EQ(summary["posed"], kFrames);
  EXPECT_LT(summary["evaluation"]["ate"]["percent_of_path"], 0.5);
  EXPECT_NE(ReadText(refined / "trajectory.tum"), ReadText(Result() / "trajectory.tum"));
  EXPECT_NE(ReadText(refined / "camera_estimated.yaml"),
            ReadText(Result() / "camera_estimated.yaml"));
  EXPECT_NE(ReadText(refined / "map.ply"), ReadText(Result() / "map.ply"));
  ASSERT_EQ(RunOn(Street(), again, {"--gt", Truth(), "--refine", "--threads", "2"}).exit_code,
            kDone);
  for (const char* name : {"trajectory.tum", "rotations.tum", "keyframes.tum", "map.ply",
                           "summary.json", "camera_estimated.yaml"}) {
    EXPECT_EQ(ReadText(refined / name), ReadText(again / name)) << name;
  }
}

TEST_F(Pipeline, ObservationsAndMapAndFramesBelongTogether) {
  std::map<LandmarkId, int> counts;
  for (const ObservationRow& row : ReadObservations(Result() / "observations.npy")) {
    ++counts[row.landmark];
    EXPECT_LT(row.frame, kFrames);
  }
  const std::vector<MapPoint> points = ReadMapPly(Result() / "map.ply");
  EXPECT_GT(points.size(), 200u);
  for (const MapPoint& point : points) EXPECT_EQ(counts[point.id], point.num_observations);
  EXPECT_LE(counts.size(), points.size());
}

TEST_F(Pipeline, FeaturesOfKeyframesAreWrittenOnRequest) {
  EXPECT_FALSE(fs::exists(Result() / "keyframe_features.npy"));
  const fs::path result = *folder_ / "features";
  ASSERT_EQ(RunOn(Street(), result, {"--keyframe-features"}).exit_code, kDone);
  if (!HasPythonPackage("numpy")) GTEST_SKIP() << "needs NumPy, see CONTRIBUTING.md";
  const fs::path script = SourceDir() / "tests" / "cli" / "check_keyframe_features.py";
  const CommandResult check = RunPython({script, result});
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
}

TEST_F(Pipeline, AResultIsExportedForOtherPrograms) {
  const fs::path model = *folder_ / "model";
  const CommandResult colmap = RunCorvo({"export", Result(), "--to", "colmap", "--images",
                                         "--undistort", "--frames", "all", "-o", model});
  ASSERT_EQ(colmap.exit_code, kDone) << colmap.err;
  for (const char* name : {"cameras.bin", "images.bin", "points3D.bin"}) {
    EXPECT_GT(fs::file_size(model / "sparse/0" / name), 50u) << name;
  }
  const fs::path images = model / "images";
  EXPECT_EQ(
      std::distance(fs::recursive_directory_iterator(images), fs::recursive_directory_iterator()),
      kFrames + 1)
      << "and the folder rgb";
  const fs::path scene = *folder_ / "scene";
  const CommandResult nerfstudio =
      RunCorvo({"export", Result(), "--to", "nerfstudio", "--images", "-o", scene});
  ASSERT_EQ(nerfstudio.exit_code, kDone) << nerfstudio.err;
  const auto transforms = nlohmann::json::parse(ReadText(scene / "transforms.json"));
  EXPECT_TRUE(fs::exists(scene / transforms["ply_file_path"].get<std::string>()));
  EXPECT_GT(transforms["frames"].size(), 3u);
  for (const auto& frame : transforms["frames"]) {
    EXPECT_TRUE(fs::exists(scene / frame["file_path"].get<std::string>()));
  }
  // An export is replaced only on request; other folders never are.
  EXPECT_EQ(RunCorvo({"export", Result(), "--to", "colmap", "-o", model}).exit_code, 1);
  EXPECT_EQ(RunCorvo({"export", Result(), "--to", "colmap", "-o", model, "--force"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(images));
  EXPECT_EQ(RunCorvo({"export", Result(), "--to", "colmap", "-o", Street(), "--force"}).exit_code,
            1);
}

TEST_F(Pipeline, SixteenBitImagesAreExportedAsTheRunSawThem) {
  struct Stored {
    int offset, scale;
    std::string extension;
  };
  // 12 bits; the range of a thermal camera.
  for (const auto& [offset, scale, extension] : {Stored{0, 16, ".png"}, Stored{7000, 6, ".pgm"}}) {
    const TemporaryFolder folder;
    cv::Mat stored;
    for (int i = 0; i < 20; ++i) {
      const fs::path original = ListImages(Street()).images[i].file;
      cv::imread(original, cv::IMREAD_GRAYSCALE).convertTo(stored, CV_16U, scale, offset);
      WriteImage(folder / fmt::format("images/{:02}{}", i, extension), stored);
    }
    const fs::path result = folder / "result", model = folder / "model";
    ASSERT_EQ(RunOn(folder / "images", result, {}).exit_code, kDone);
    const CommandResult exported =
        RunCorvo({"export", result, "--to", "colmap", "--images", "--text", "-o", model});
    ASSERT_EQ(exported.exit_code, kDone) << exported.err;
    ImageSource source(ListImages(folder / "images"));
    const cv::Mat seen = source.First().image;
    EXPECT_GT(cv::mean(seen)[0], 30) << "not dark";
    EXPECT_EQ(ReadRunResult(result).gray_levels.text(), source.gray_levels()->text());
    const fs::path written = model / ("images/00" + extension);
    ASSERT_EQ(cv::imread(written, cv::IMREAD_UNCHANGED).depth(), CV_8U);
    EXPECT_EQ(cv::norm(cv::imread(written, cv::IMREAD_GRAYSCALE), seen, cv::NORM_INF), 0);
    // The first image colors the points that it observes.
    const std::vector<double> observed = NumbersOf(LinesOf(model / "sparse/0/images.txt")[1]);
    std::map<double, double> red;
    for (const std::string& line : LinesOf(model / "sparse/0/points3D.txt")) {
      const std::vector<double> fields = NumbersOf(line);
      red[fields[0]] = fields[4];
    }
    ASSERT_GT(observed.size(), 100u);
    for (std::size_t k = 0; k + 2 < observed.size(); k += 3) {
      const cv::Point pixel(static_cast<int>(observed[k]), static_cast<int>(observed[k + 1]));
      EXPECT_EQ(red.at(observed[k + 2]), seen.at<std::uint8_t>(pixel));
    }
  }
}

TEST_F(Pipeline, GrayLevelsOutOfRangeInASummaryAreAnError) {
  const TemporaryFolder folder;
  fs::copy(Result(), folder / "result", fs::copy_options::recursive);
  const auto error_of = [&](const std::string& levels) {
    auto summary = nlohmann::json::parse(ReadText(Result() / "summary.json"));
    summary["gray_levels"] = nlohmann::json::parse(levels);
    WriteText(folder / "result/summary.json", summary.dump());
    return ErrorOf([&] { ReadRunResult(folder / "result"); });
  };
  using testing::HasSubstr;
  EXPECT_THAT(error_of(R"({"bits": 17})"), HasSubstr("summary.json: gray_levels.bits is 17"));
  EXPECT_THAT(error_of(R"({"low": 1, "high": 65536})"), HasSubstr("high is 65536; allowed is 0"));
  EXPECT_THAT(error_of(R"({"low": 1})"), HasSubstr("gray_levels has no integer \"high\""));
  EXPECT_THAT(error_of("12"), HasSubstr("gray_levels has no integer \"low\""));
}

TEST_F(Pipeline, ColmapReadsAnExportedModelAndHasLittleToImprove) {
  if (!HasPythonPackage("pycolmap")) {
    GTEST_SKIP() << "pycolmap is missing: scripts/install_dependencies.sh --development";
  }
  for (const std::string format : {"--text", "--force"}) {
    const fs::path model = *folder_ / "colmap";
    ASSERT_EQ(RunCorvo({"export", Result(), "--to", "colmap", "-o", model, format}).exit_code, 0);
    const CommandResult check =
        RunPython({SourceDir() / "tests/cli/check_colmap_model.py", model / "sparse/0"});
    ASSERT_EQ(check.exit_code, 0) << check.err;
    const auto measures = nlohmann::json::parse(check.out);
    EXPECT_GT(measures["observations"], 500);
    EXPECT_LT(measures["mean_error"], 0.5) << "px";
    EXPECT_LT(measures["stated"], 1e-6) << "px: pycolmap projects as corvo does";
    EXPECT_GT(measures["robust_cost_ratio"], 0.8);
    EXPECT_GT(measures["cost_ratio"], 0.9) << "the points minimize what COLMAP minimizes";
    EXPECT_LT(measures["moved"], 0.005);
  }
}

TEST_F(Pipeline, GtsamReadsThePoseGraphAndClosesALoop) {
  if (!HasPythonPackage("gtsam")) {
    GTEST_SKIP() << "gtsam is missing: scripts/install_dependencies.sh --development";
  }
  const CommandResult check =
      RunPython({SourceDir() / "tests/cli/check_pose_graph.py", Result() / "pose_graph.g2o"});
  ASSERT_EQ(check.exit_code, 0) << check.err;
  const auto measures = nlohmann::json::parse(check.out);
  EXPECT_GT(measures["vertices"], 5);
  EXPECT_GE(measures["edges"], measures["vertices"].get<int>() - 1);
  EXPECT_LT(measures["error"], 1e-6) << "the edges agree with the poses";
  EXPECT_LT(measures["left"], 0.01) << "the loop is closed";
  EXPECT_NEAR(measures["moved_last"], 1, 0.01);
  EXPECT_GT(measures["moved_middle"], 0.1) << "the loop is distributed over the keyframes";
  EXPECT_LT(measures["moved_middle"], 0.9);
}

TEST_F(Pipeline, EveryPosedFrameHasARelativePoseWithItsCovariance) {
  const auto lines = [](const fs::path& file) {
    const std::string text = ReadText(file);
    return std::count(text.begin(), text.end(), '\n');
  };
  const nlohmann::json summary = nlohmann::json::parse(ReadText(Result() / "summary.json"));
  EXPECT_EQ(lines(Result() / "relative_poses.csv"), 1 + summary["posed"].get<int>());
}

TEST_F(Pipeline, OutputDoesNotDependOnTheNumberOfThreads) {
  const fs::path two = *folder_ / "two";
  ASSERT_EQ(RunOn(Street(), two, {"--gt", Truth(), "--threads", "2"}).exit_code, kDone);
  for (const char* name :
       {"trajectory.tum", "trajectory.kitti", "trajectory_euroc.csv", "keyframes.tum",
        "rotations.tum", "map.ply", "frames.csv", "observations.npy", "summary.json", "config.yaml",
        "trajectory.png", "relative_poses.csv", "pose_graph.g2o", "pose_graph_sim3.g2o",
        "camera_history.csv"}) {
    EXPECT_EQ(ReadText(Result() / name), ReadText(two / name)) << name;
  }
}

TEST_F(Pipeline, ReportsThatTrackingWasLost) {
  const fs::path dark = *folder_ / "dark";
  fs::copy(Street(), dark, fs::copy_options::recursive);
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(dark / "rgb")) images.push_back(entry.path());
  std::sort(images.begin(), images.end());
  const cv::Mat image = cv::imread(images[20].string());
  WriteImage(images[20], cv::Mat::zeros(image.size(), CV_8UC1));
  const CommandResult result = RunOn(dark, *folder_ / "lost", {});
  EXPECT_EQ(result.exit_code, kLost);
  EXPECT_THAT(result.out, testing::StartsWith("lost part-way: 40 frames"));
}

}  // namespace
}  // namespace corvo::test
