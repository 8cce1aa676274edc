// SPDX-License-Identifier: MIT
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <map>

#include <gmock/gmock.h>
#include <unistd.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "apps/run/run_results.h"
#include "tests/cli/command.h"
#include "tests/cli/tiny_sequence.h"
#include "tests/support/data.h"
#include "vo/io/config.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

const char* const kRunCamera =
    "model: pinhole-radtan\nwidth: 96\nheight: 64\nfx: 80\nfy: 80\ncx: 47.5\ncy: 31.5\n"
    "k1: 0\nk2: 0\np1: 0\np2: 0\nk3: 0\n";

const char* const kReproducibleFiles[] = {"trajectory.tum",
                                          "rotations.tum",
                                          "trajectory_euroc.csv",
                                          "keyframes.tum",
                                          "map.ply",
                                          "frames.csv",
                                          "observations.npy",
                                          "summary.json",
                                          "config.yaml",
                                          "camera_estimated.yaml",
                                          "camera_history.csv",
                                          "trajectory.png",
                                          "relative_poses.csv",
                                          "pose_graph.g2o",
                                          "pose_graph_sim3.g2o"};

/// A fixture with a folder of five unrelated images and a camera file for them.
class Run : public testing::Test {
 protected:
  Run() {
    WriteFolder(images_, 5);
    WriteText(camera_, kRunCamera);
  }

  /// Runs `corvo run <images> --camera <camera> -o <result>` with further arguments.
  CommandResult RunHere(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"run", images_, "--camera", camera_, "-o", result_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCorvo(arguments);
  }

  void ExpectError(const CommandResult& result, const std::string& message) const {
    EXPECT_EQ(result.exit_code, kBadInput);
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(result.err, AllOf(StartsWith("corvo: error: "), HasSubstr(message)));
    EXPECT_EQ(CountLines(result.err), 1) << result.err;
  }

  nlohmann::json Summary() const {
    return nlohmann::json::parse(ReadText(result_ / "summary.json"));
  }

  fs::path Checkpoint() const { return result_ / kCheckpointFolder; }

  TemporaryFolder folder_;
  const fs::path images_ = folder_ / "images";
  const fs::path camera_ = folder_ / "camera.yaml";
  const fs::path result_ = folder_ / "result";
};

TEST_F(Run, WithoutAPoseReportsTheReasons) {
  const CommandResult result = RunHere();
  EXPECT_EQ(result.exit_code, kNeverInitialized);
  EXPECT_THAT(result.out, AllOf(HasSubstr("never initialized"), HasSubstr("5 frames, 0 posed"),
                                HasSubstr("\n5 of 5 frames have no pose:\n")));
  EXPECT_THAT(result.out,
              ContainsRegex("\n  too_few_matches +4  #+ +consecutive images change too much"));
  EXPECT_FALSE(fs::exists(result_ / "trajectory.kitti"));
  EXPECT_EQ(Summary()["trajectory_kitti"], "not written: 5 of 5 frames have no pose");
  EXPECT_THAT(ReadText(result_ / "trajectory.tum"), testing::MatchesRegex("(#.*\n)?"));
}

TEST_F(Run, WithoutAPoseHasNothingToRefine) {
  const CommandResult result = RunHere({"--refine"});
  EXPECT_EQ(result.exit_code, kNeverInitialized);
  EXPECT_THAT(result.out, HasSubstr("\nnot refined: there is nothing to adjust\n"));
  EXPECT_EQ(Summary()["refinement"]["refined"], false);
  EXPECT_EQ(Summary()["refinement"]["why_not"], "there is nothing to adjust");
}

TEST_F(Run, WithoutAPoseHasNothingToEvaluate) {
  WriteText(folder_ / "gt.txt", "0 0 0 0 0 0 0 1\n0.1 1 0 0 0 0 0 1\n");
  const CommandResult result = RunHere({"--gt", folder_ / "gt.txt"});
  EXPECT_EQ(result.exit_code, kNeverInitialized);
  EXPECT_THAT(result.err, HasSubstr("corvo: warning: the trajectory was not evaluated: "));
  EXPECT_FALSE(Summary().contains("evaluation"));
}

TEST_F(Run, RejectsGroundTruthOfAnotherTime) {
  WriteText(folder_ / "gt.txt", "1000 0 0 0 0 0 0 1\n");
  ExpectError(RunHere({"--gt", folder_ / "gt.txt"}), "gt.txt: no pose within 0.016666666 s");
}

TEST_F(Run, RejectsGroundTruthOfAnotherNumberOfFrames) {
  WriteText(folder_ / "gt.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  ExpectError(RunHere({"--gt", folder_ / "gt.txt"}), "gt.txt: 1 poses for a sequence of 5 frames");
}

TEST_F(Run, FindsTheGroundTruthInTheDatasetsLayout) {
  WriteTum(folder_ / "tum", 2);
  const std::vector<std::string> arguments = {"run", folder_ / "tum", "--camera", camera_,
                                              "-o",  result_};
  const fs::path truth = folder_ / "tum/groundtruth.txt";
  WriteText(truth, "1305031102.18 0 0 0 0 0 0 1\n");
  RunCorvo(arguments);
  EXPECT_EQ(Summary()["truth"], truth.string());
  WriteText(truth, "7 0 0 0 0 0 0 1\n");
  EXPECT_THAT(RunCorvo(arguments).err, HasSubstr("corvo: warning: ground truth ignored: "));
  EXPECT_FALSE(Summary().contains("truth"));
  std::vector<std::string> none = arguments;
  none.insert(none.end(), {"--gt", "none"});
  EXPECT_THAT(RunCorvo(none).err, Not(HasSubstr("ground truth")));
}

TEST_F(Run, LogsEveryFrame) {
  RunHere({"--fps", "10"});
  const std::string table = ReadText(result_ / "frames.csv");
  EXPECT_EQ(CountLines(table), 6);
  EXPECT_THAT(table, StartsWith("index,timestamp,state,reason,segment,posed,features,matches,"
                                "inliers,parallax,masked,window_adjustment,camera_adjustment,"
                                "keyframe,found_share,image_coverage,distance_sigma,weakest_sigma,"
                                "drift_sigma,image\n0,0.000000000,"));
  EXPECT_THAT(table, HasSubstr("\n4,0.400000000,"));
  EXPECT_THAT(table, HasSubstr(",0,0.0000,0.0000,0,0,0,4.png\n"));
  EXPECT_EQ(CountLines(ReadText(result_ / "timing.csv")), 6);
  const nlohmann::json summary = Summary();
  EXPECT_EQ(summary["frames"], 5);
  EXPECT_EQ(summary["posed"], 0);
  EXPECT_EQ(summary["outcome"], "never initialized");
  EXPECT_EQ(summary["layout"], "folder");
  EXPECT_EQ(summary["camera"]["fx"], 80.0);
  EXPECT_EQ(summary["calibration"]["fx"]["given"], 80.0);
  EXPECT_EQ(summary["calibration"]["k1"]["value"], 0.0) << "no frame has a pose";
  EXPECT_EQ(ReadCameraFile(result_ / "camera_estimated.yaml").camera.fx(), 80.0);
}

TEST_F(Run, OutputDoesNotDependOnTheNumberOfThreads) {
  RunHere({"--threads", "1"});
  std::vector<std::string> first;
  for (const char* name : kReproducibleFiles) first.push_back(ReadText(result_ / name));
  RunHere({"--threads", "2"});
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(ReadText(result_ / kReproducibleFiles[i]), first[i]) << kReproducibleFiles[i];
  }
}

TEST_F(Run, DescribesItsEnvironment) {
  RunHere({"--threads", "2"});
  const auto environment = nlohmann::json::parse(ReadText(result_ / "environment.json"));
  EXPECT_EQ(environment["threads"], 2);
  EXPECT_GT(environment["peak_memory_mb"], 1.0);
  for (const char* key : {"corvo", "opencv", "eigen", "ceres", "compiler", "cpu"}) {
    EXPECT_FALSE(environment[key].get<std::string>().empty()) << key;
  }
}

TEST_F(Run, ReadsTheConfigItWrote) {
  RunHere();
  const std::string written = ReadText(result_ / "config.yaml");
  const fs::path config = folder_ / "config.yaml";
  WriteText(config, written);
  EXPECT_EQ(RunHere({"--config", config}).exit_code, kNeverInitialized);
  EXPECT_EQ(ReadText(result_ / "config.yaml"), written);
}

TEST_F(Run, WorksWithoutGnuplot) {
  const CommandResult result = RunCorvoAlone({"run", images_, "--camera", camera_, "-o", result_});
  EXPECT_EQ(result.exit_code, kNeverInitialized);
  EXPECT_THAT(result.err, HasSubstr("corvo: warning: trajectory.png was not written"));
  EXPECT_TRUE(fs::exists(result_ / "summary.json"));
  EXPECT_FALSE(fs::exists(result_ / "trajectory.png"));
}

TEST_F(Run, WritesAPlotBesideItsResults) {
  const fs::path file = folder_ / "figure.svg";
  EXPECT_EQ(RunHere({"--plot", file}).exit_code, kNeverInitialized);
  EXPECT_THAT(ReadText(file), AllOf(HasSubstr(": 0 of 5 frames posed"), HasSubstr("</svg>")));
  WriteText(file, "mine");
  ExpectError(RunHere({"--plot", file}), "figure.svg: not written by an earlier corvo");
}

TEST_F(Run, RejectsAPlotBeforeTheWorkBegins) {
  ExpectError(RunHere({"--plot", folder_ / "figure.eps"}), "allowed is .png, .pdf or .svg");
  ExpectError(RunHere({"--plot", result_ / "trajectory.png"}), "is a file of the results");
  EXPECT_FALSE(fs::exists(result_));
}

TEST_F(Run, RecognizesEveryLayout) {
  WriteKitti(folder_ / "kitti", 2);
  WriteEuroc(folder_ / "euroc/mav0", 2);
  WriteTum(folder_ / "tum", 2);
  const std::vector<std::pair<std::string, std::vector<std::string>>> layouts = {
      {"kitti", {}}, {"euroc", {}}, {"tum", {"--camera", camera_}}};
  for (const auto& [layout, more] : layouts) {
    std::vector<std::string> arguments = {"run", folder_ / layout, "-o", result_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(RunCorvo(arguments).exit_code, kNeverInitialized) << layout;
    EXPECT_EQ(Summary()["layout"], layout);
  }
}

TEST_F(Run, RequiresACameraIfTheDatasetShipsNone) {
  ExpectError(RunCorvo({"run", images_, "-o", result_}),
              "ships no calibration; give --camera FILE, --fov DEGREES, or --focal auto");
  for (int i = 0; i < 5; ++i) {
    WriteImage(images_ / (std::to_string(i) + ".png"), TinyImage(i, 640, 480));
  }
  ExpectError(RunCorvo({"run", images_, "-o", result_}),
              "; shipped cameras of 640 x 480 px, for --camera: 7scenes, tum_fr1, ");
}

TEST_F(Run, RejectsTheFocalSearchOfALiveOrCalibratedCamera) {
  ExpectError(RunCorvo({"run", "camera:97", "--focal", "auto", "-o", result_}),
              "--focal auto: camera:97 is a live camera");
  EXPECT_THAT(RunHere({"--focal", "auto"}).err, HasSubstr("--camera excludes --focal"));
}

TEST_F(Run, StatedFocalLengthOrFieldOfViewReplacesTheCameraFile) {
  const auto run = [&](const std::vector<std::string>& stated) {
    std::vector<std::string> arguments = {"run", images_, "-o", result_};
    arguments.insert(arguments.end(), stated.begin(), stated.end());
    EXPECT_EQ(RunCorvo(arguments).exit_code, kNeverInitialized) << stated.front();
    return Summary();
  };
  const nlohmann::json by_focal = run({"--focal", "80"});
  EXPECT_EQ(by_focal["camera_source"], "--focal 80");
  EXPECT_EQ(by_focal["camera"]["fx"], 80.0);
  EXPECT_EQ(by_focal["camera"]["fy"], 80.0);
  EXPECT_EQ(by_focal["camera"]["cx"], 47.5);
  EXPECT_EQ(by_focal["camera"]["cy"], 31.5);
  EXPECT_EQ(by_focal["calibration"]["fx"]["given"], 80.0);
  const nlohmann::json by_fov = run({"--fov", "90", "--resize", "0.5"});
  EXPECT_EQ(by_fov["camera_source"], "--fov 90");
  EXPECT_NEAR(by_fov["camera"]["fx"], 24, 1e-9);
}

/// The room was rendered with a focal length of 262.5 px.
TEST_F(Run, StatedFocalLengthIsRefinedUnlessItIsFixed) {
  CORVO_SKIP_IF_SHORT();
  RunCorvo({"synth", "room", "-o", folder_ / "room", "--frames", "100", "--width", "320"});
  const auto estimate = [&](const std::string& calibration) {
    RunCorvo({"run", folder_ / "room", "--gt", "none", "--focal", "275", "--calibration",
              calibration, "-o", result_});
    return ReadCameraFile(result_ / "camera_estimated.yaml").camera.fx();
  };
  EXPECT_NEAR(estimate("estimate"), 262.5, 6);
  EXPECT_EQ(estimate("fixed"), 275);
}

TEST_F(Run, ErrorsNameAStatedFocalLengthOutOfRange) {
  const auto run = [&](const std::vector<std::string>& stated) {
    std::vector<std::string> arguments = {"run", images_, "-o", result_};
    arguments.insert(arguments.end(), stated.begin(), stated.end());
    return RunCorvo(arguments);
  };
  ExpectError(run({"--focal", "5"}), "--focal is 5; allowed is 12.9 to 1099.4 px");
  ExpectError(run({"--focal", "wide"}), "--focal is \"wide\"; allowed is auto, or a focal length");
  EXPECT_THAT(run({"--fov", "200"}).err, HasSubstr("--fov: 200 is not a number from 5 to 150"));
  EXPECT_THAT(run({"--fov", "70", "--focal", "80"}).err, HasSubstr("excludes --f"));
  EXPECT_THAT(RunHere({"--fov", "70"}).err, HasSubstr("--camera excludes --fov"));
  EXPECT_EQ(RunHere({"--fov", "70"}).exit_code, kBadInput);
  EXPECT_FALSE(fs::exists(result_));
}

TEST_F(Run, WarnsIfImagesDoNotDetermineTheFocalLength) {
  const CommandResult run = RunCorvo({"run", images_, "--focal", "auto", "-o", result_});
  EXPECT_EQ(run.exit_code, kNeverInitialized);
  EXPECT_THAT(run.err, HasSubstr("do not determine the focal length (0 image pairs)"));
  const auto summary = nlohmann::json::parse(ReadText(result_ / "summary.json"));
  EXPECT_EQ(summary["camera_source"], "focal search");
  EXPECT_NEAR(summary["camera"]["fx"], 68.55, 0.1);  // A field of view of 70 degrees over 96 px.
}

/// The images of a rendered room are given without their camera file, in the only subfolder of the
/// input, which is said once although the images are read in several passes.
TEST_F(Run, FindsTheFocalLengthOfImagesWithoutACamera) {
  CORVO_SKIP_IF_SHORT();
  const int every = 6;
  RunCorvo({"synth", "room", "-o", folder_ / "room", "--frames", "100"});
  fs::create_directory(folder_ / "film");
  fs::rename(folder_ / "room/rgb", folder_ / "film/images");
  const std::vector<std::string> arguments = {"run",     folder_ / "film",      "--focal", "auto",
                                              "--every", std::to_string(every), "-o",      result_};
  const CommandResult run = RunCorvo(arguments);
  EXPECT_THAT(run.err, AllOf(HasSubstr("focal search: "), HasSubstr("first pass: ")));
  EXPECT_THAT(run.err, HasSubstr("has its images in"));
  EXPECT_EQ(run.err.find("has its images in"), run.err.rfind("has its images in"));
  const auto summary = nlohmann::json::parse(ReadText(result_ / "summary.json"));
  EXPECT_EQ(summary["camera_source"], "focal search");
  EXPECT_NEAR(summary["camera"]["fx"], 525, 0.1 * 525);
  EXPECT_NEAR(summary["camera"]["cx"], 319.5, 6.4);  // Within 1% of the image width.
  std::vector<std::string> with_threads = arguments;
  with_threads.back() = result_ / "again";
  with_threads.insert(with_threads.end(), {"--threads", "2"});
  RunCorvo(with_threads);
  EXPECT_EQ(ReadText(result_ / "trajectory.tum"), ReadText(result_ / "again/trajectory.tum"));
}

TEST_F(Run, RejectsACameraThatCannotBeRight) {
  const auto error = [&](const std::string& values) {
    WriteText(camera_, "model: pinhole\nwidth: 96\nheight: 64\n" + values);
    return RunHere();
  };
  ExpectError(error("fx: 0.8\nfy: 1.2\ncx: 0.5\ncy: 0.5\n"),
              "camera.yaml: camera.fx is 0.8; allowed");
  ExpectError(error("fx: 80\nfy: 80\ncx: 0\ncy: 0\n"), "camera.yaml: camera.cx is 0; allowed");
  ExpectError(error("fx: 160\nfy: 160\ncx: 97\ncy: 63\n"), "images of twice the size");
  EXPECT_FALSE(fs::exists(result_));
}

TEST_F(Run, WarnsOfAnUnusualCameraAndRunsWithIt) {
  WriteText(camera_, "model: pinhole\nwidth: 96\nheight: 64\nfx: 40\nfy: 40\ncx: 23.5\ncy: 15.5\n");
  const CommandResult result = RunHere();
  EXPECT_EQ(result.exit_code, kNeverInitialized);
  const std::string warning = camera_.string() + ": camera.cx is 23.5 px, far from the center";
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("corvo: warning: " + warning), HasSubstr("images of half the size")));
  ASSERT_EQ(Summary()["warnings"].size(), 1u);
  EXPECT_THAT(Summary()["warnings"][0], StartsWith(warning));
}

TEST_F(Run, ChecksTheCameraBeforeImagesAreResized) {
  WriteText(camera_, "model: pinhole\nwidth: 96\nheight: 64\nfx: 25\nfy: 25\ncx: 47.5\ncy: 31.5\n");
  const CommandResult result = RunHere({"--resize", "16x16"});
  EXPECT_EQ(result.exit_code, kNeverInitialized);
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_LT(Summary()["camera"]["fx"], 5);
  EXPECT_THAT(Summary()["warnings"], IsEmpty());
}

TEST_F(Run, WarnsOfAnUnusualCameraOfADataset) {
  WriteKitti(folder_ / "kitti", 2);
  WriteText(folder_ / "kitti/calib.txt", "P0: 80 0 23.5 0 0 81 31.5 0 0 0 1 0\n");
  const CommandResult result = RunCorvo({"run", folder_ / "kitti", "-o", result_});
  EXPECT_THAT(result.err, HasSubstr("kitti: camera.cx is 23.5 px"));
  EXPECT_EQ(Summary()["warnings"].size(), 1u);
  EXPECT_THAT(RunCorvo({"run", folder_ / "kitti", "--fov", "70", "-o", result_}).err, IsEmpty());
  EXPECT_THAT(Summary()["warnings"], IsEmpty());
}

TEST_F(Run, ErrorsNameTheInvalidInput) {
  ExpectError(RunCorvo({"run", folder_ / "none", "-o", result_}), "none: no such folder");
  ExpectError(RunHere({"--gt", folder_ / "none.txt"}), "none.txt");
  ExpectError(RunHere({"--config", folder_ / "none.yaml"}), "none.yaml");
  WriteText(folder_ / "bad.yaml", "extractor:\n  num_featurs: 10\n");
  ExpectError(RunHere({"--config", folder_ / "bad.yaml"}), "num_featurs");
  WriteText(folder_ / "gt.txt", "0 0 0\n");
  ExpectError(RunHere({"--gt", folder_ / "gt.txt"}), "gt.txt:1: 3 columns");
  EXPECT_FALSE(fs::exists(result_));
}

TEST_F(Run, ErrorNamesACameraOfAnotherSize) {
  for (int i = 0; i < 5; ++i) {
    WriteImage(images_ / (std::to_string(i) + ".png"), TinyImage(i, 80, 60));
  }
  ExpectError(RunHere(), "0.png: the image is 80 x 60 px, the camera 96 x 64 px");
  EXPECT_FALSE(fs::exists(result_));
}

TEST_F(Run, MissingImagesAreFramesWithoutAPose) {
  WriteText(images_ / "0.png", "garbage");
  WriteImage(images_ / "3.png", TinyImage(3, 80, 60));
  const CommandResult result = RunHere({"--fps", "10"});
  EXPECT_EQ(result.exit_code, kNeverInitialized);
  const std::string table = ReadText(result_ / "frames.csv");
  EXPECT_THAT(table, AllOf(HasSubstr("\n0,0.000000000,initializing,unreadable_image,"),
                           HasSubstr("\n3,0.300000000,initializing,wrong_size,")));
  EXPECT_EQ(CountLines(table), 6);
  EXPECT_EQ(CountLines(ReadText(result_ / "timing.csv")), 6);
  EXPECT_EQ(Summary()["complete"], true);
  EXPECT_EQ(Summary()["reasons"]["wrong_size"], 1);
  ASSERT_EQ(Summary()["warnings"].size(), 2u);
  EXPECT_THAT(Summary()["warnings"][0],
              HasSubstr("1 image was not used (unreadable_image), the first: "));
  EXPECT_THAT(result.err, HasSubstr("3.png: the image is 80 x 60 px, the camera 96 x 64 px"));
}

TEST_F(Run, FindsTheCameraAlthoughTheFirstImageIsMissing) {
  WriteText(images_ / "0.png", "");
  const CommandResult result = RunCorvo({"run", images_, "--focal", "auto", "-o", result_});
  EXPECT_EQ(result.exit_code, kNeverInitialized) << result.err;
  EXPECT_EQ(Summary()["camera"]["width"], 96);
  EXPECT_EQ(Summary()["reasons"]["unreadable_image"], 1);
}

TEST_F(Run, WithoutAReadableImageIsAnError) {
  for (int i = 0; i < 5; ++i) WriteText(images_ / (std::to_string(i) + ".png"), "garbage");
  ExpectError(RunHere(), "0.png: not a readable image (none of 5 images can be read)");
  EXPECT_FALSE(fs::exists(result_));
}

TEST_F(Run, AnErrorLeavesThePartialResult) {
  WriteText(images_ / "3.png", "garbage");
  ExpectError(RunHere({"--strict"}), "3.png: not a readable image, after 3 of 5 frames");
  EXPECT_EQ(Summary()["complete"], false);
  EXPECT_THAT(Summary()["ended_by"], HasSubstr("3.png: not a readable image"));
  EXPECT_EQ(Summary()["outcome"], "incomplete");
  EXPECT_EQ(Summary()["exit_code"], kBadInput);
  EXPECT_EQ(Summary()["frames"], 3);
  EXPECT_EQ(Summary()["frames_expected"], 5);
  EXPECT_EQ(CountLines(ReadText(result_ / "frames.csv")), 4);
  EXPECT_EQ(RunHere().exit_code, kNeverInitialized) << "replaces the partial result";
  EXPECT_EQ(Summary()["frames"], 5);
}

TEST_F(Run, DrawsEveryFrameIntoAFilm) {
  const fs::path film = folder_ / "film.avi";
  const auto count_images = [&] {
    cv::VideoCapture capture(film.string(), cv::CAP_FFMPEG);
    int count = 0;
    for (cv::Mat image; capture.read(image);) ++count;
    return count;
  };
  WriteText(images_ / "3.png", "garbage");
  ExpectError(RunHere({"--strict", "--draw", film}), "3.png: not a readable image, after 3 of 5");
  EXPECT_EQ(count_images(), 3) << "a run that ends early leaves a whole film";
  EXPECT_EQ(RunHere({"--draw", film}).exit_code, kNeverInitialized);
  EXPECT_EQ(count_images(), 5) << "also a frame without an image";
  ExpectError(RunHere({"--draw", folder_ / "film.webm"}), "allowed is .mp4, .mov, .mkv or .avi");
}

TEST_F(Run, NeverReplacesTheUsersFiles) {
  WriteText(images_ / "groundtruth.tum", "my trajectory");
  WriteText(images_ / "config.yaml", "my: options");
  const std::vector<std::string> arguments = {"run", images_, "--camera", camera_, "-o", images_};
  ExpectError(RunCorvo(arguments), "images: groundtruth.tum, config.yaml: not written by");
  EXPECT_EQ(ReadText(images_ / "config.yaml"), "my: options");
  EXPECT_EQ(ReadText(images_ / "groundtruth.tum"), "my trajectory");
  EXPECT_EQ(std::distance(fs::directory_iterator(images_), fs::directory_iterator()), 7);
  std::vector<std::string> forced = arguments;
  forced.emplace_back("--force");
  EXPECT_EQ(RunCorvo(forced).exit_code, kNeverInitialized);
  EXPECT_THAT(ReadText(images_ / "config.yaml"), HasSubstr("extractor:"));
}

TEST_F(Run, OutputInsideTheInputDoesNotBecomeInput) {
  for (const fs::path& output : {images_, images_ / "out"}) {
    for (int i = 0; i < 2; ++i) {
      const CommandResult result =
          RunCorvo({"run", images_, "--camera", camera_, "-o", output, "--draw", images_});
      EXPECT_THAT(result.out, HasSubstr("5 frames")) << output << result.err;
    }
  }
}

TEST_F(Run, WritesNamesThatAreNotUtf8) {
  const fs::path input = folder_ / "gr\xfcn";
  WriteFolder(input, 3);
  const CommandResult result = RunCorvo({"run", input, "--camera", camera_, "-o", input / "r\xe9"});
  EXPECT_EQ(result.exit_code, kNeverInitialized) << result.err;
  const auto summary = nlohmann::json::parse(ReadText(input / "r\xe9/summary.json"));
  EXPECT_THAT(summary["input"], HasSubstr("gr\xEF\xBF\xBDn"));
}

TEST_F(Run, ReportsThatStandardOutputCannotBeWritten) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const auto run = [](const std::string& arguments) {
    return RunProgram("/bin/sh", {"-c", CORVO_COMMAND + arguments + " > /dev/full"},
                      {"PATH=/usr/bin:/bin"});
  };
  for (const std::string& arguments :
       {" run " + images_.string() + " --camera " + camera_.string() + " -o " + result_.string(),
        std::string(" config"), std::string(" --help"), std::string(" run --help")}) {
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.exit_code, kBadInput) << arguments;
    EXPECT_THAT(result.err, HasSubstr("corvo: error: the standard output cannot be written: "));
  }
  EXPECT_EQ(Summary()["complete"], true);
}

/// A program in the place of gnuplot succeeds like gnuplot on a full disk.
TEST_F(Run, RejectsAPlotThatIsNotWhole) {
  const fs::path gnuplot = folder_ / "bin/gnuplot";
  WriteText(gnuplot, "#!/bin/sh\nprintf '\\211PNG\\r\\n'\n");
  fs::permissions(gnuplot, fs::perms::owner_all);
  const CommandResult result =
      RunProgram(CORVO_COMMAND, {"run", images_, "--camera", camera_, "-o", result_},
                 {"PATH=" + gnuplot.parent_path().string()});
  ExpectError(result, "trajectory.png: cannot be written in full; only the trajectory is in " +
                          Checkpoint().string());
  EXPECT_TRUE(fs::exists(Checkpoint() / "trajectory.tum"));
  EXPECT_FALSE(fs::exists(result_ / "trajectory.png"));
}

TEST_F(Run, ReadsTheSelectedImages) {
  RunHere({"--start", "1", "--every", "2", "--count", "2", "--fps", "10"});
  const std::string table = ReadText(result_ / "frames.csv");
  EXPECT_EQ(CountLines(table), 3);
  EXPECT_THAT(table, AllOf(HasSubstr("\n0,0.100000000,"), HasSubstr("\n1,0.300000000,")));
  ExpectError(RunHere({"--start", "5"}), "--start");
  ExpectError(RunHere({"--every", "0"}), "--every");
}

TEST_F(Run, ResizesImagesAndCamera) {
  RunHere({"--resize", "0.5"});
  EXPECT_EQ(Summary()["camera"]["width"], 48);
  EXPECT_EQ(Summary()["camera"]["fx"], 40.0);
  ExpectError(RunHere({"--resize", "small"}), "--resize 'small'");
}

TEST_F(Run, DetectsNoFeaturesUnderTheMask) {
  WriteImage(folder_ / "mask.png", cv::Mat::zeros(64, 96, CV_8UC1));
  RunHere({"--mask", folder_ / "mask.png"});
  EXPECT_EQ(Summary()["reasons"]["too_few_features"], 5) << Summary();
  ExpectError(RunHere({"--mask", folder_ / "none.png"}), "none.png");
}

TEST_F(Run, WritesTheMaskIfAnythingWasMasked) {
  RunHere();
  EXPECT_FALSE(fs::exists(result_ / "mask.png"));
  cv::Mat mask(64, 96, CV_8UC1, cv::Scalar(1));
  mask.rowRange(40, 64) = 0;
  WriteImage(folder_ / "given.png", mask);
  RunHere({"--mask", folder_ / "given.png"});
  const cv::Mat written = cv::imread(result_ / "mask.png", cv::IMREAD_UNCHANGED);
  EXPECT_EQ(cv::norm(written, 255 * mask, cv::NORM_INF), 0);
}

TEST_F(Run, ReadsImagesMatchingAGlobPattern) {
  RunCorvo({"run", images_ / "[12].png", "--camera", camera_, "-o", result_});
  EXPECT_EQ(Summary()["frames"], 2);
  EXPECT_EQ(Summary()["layout"], "glob");
}

TEST_F(Run, RejectsAnOutputThatIsAFile) {
  WriteText(result_, "precious");
  ExpectError(RunHere(), "result: the output folder is a file");
  EXPECT_EQ(ReadText(result_), "precious");
}

TEST_F(Run, LeavesEarlierResultsUntouchedWhenItFails) {
  RunHere();
  std::map<fs::path, std::string> before;
  for (const auto& entry : fs::directory_iterator(result_)) {
    before[entry.path()] = ReadText(entry.path());
  }
  WriteText(images_ / "4.png", "garbage");
  ExpectError(RunHere({"--strict"}), "the partial result is in " + Checkpoint().string());
  std::map<fs::path, std::string> after;
  for (const auto& entry : fs::directory_iterator(result_)) {
    if (entry.is_regular_file()) after[entry.path()] = ReadText(entry.path());
  }
  EXPECT_EQ(before, after);
}

class RunInterrupted : public Run, public testing::WithParamInterface<int> {
 protected:
  RunInterrupted() {
    const cv::Mat image = TinyImage(0, 640, 480);
    WriteImage(many_ / "0.png", image);
    for (int i = 1; i < 500; ++i) {
      fs::create_hard_link(many_ / "0.png", many_ / (std::to_string(i) + ".png"));
    }
  }

  CommandResult InterruptHere(const fs::path& when) const {
    return InterruptCorvo(
        {"run", many_, "--camera", SourceDir() / "configs/7scenes.yaml", "-o", result_}, when,
        GetParam());
  }

  const fs::path many_ = folder_ / "many";
};

TEST_P(RunInterrupted, LeavesThePartialResultAndSaysWhy) {
  const CommandResult result = InterruptHere(result_ / ".corvo-unfinished");
  EXPECT_EQ(result.exit_code, 128 + GetParam());
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, AllOf(HasSubstr("corvo: error: interrupted by SIG"),
                                HasSubstr("of 500 frames; the partial result is in ")));
  EXPECT_EQ(Summary()["complete"], false);
  EXPECT_THAT(Summary()["ended_by"], StartsWith("interrupted by SIG"));
  EXPECT_EQ(Summary()["exit_code"], 128 + GetParam());
  EXPECT_EQ(Summary()["frames_expected"], 500);
  EXPECT_EQ(CountLines(ReadText(result_ / "frames.csv")), 1 + Summary()["frames"].get<int>());
  const CommandResult eval = RunCorvo({"eval", result_, result_ / "trajectory.tum"});
  EXPECT_THAT(eval.err, HasSubstr("warning: " + result_.string() + ": the result is partial"));
}

TEST_P(RunInterrupted, KeepsACompleteEarlierResult) {
  RunHere();
  const std::string earlier = ReadText(result_ / "summary.json");
  const CommandResult result = InterruptHere(result_ / ".corvo-unfinished");
  EXPECT_EQ(result.exit_code, 128 + GetParam());
  EXPECT_EQ(ReadText(result_ / "summary.json"), earlier);
  const auto partial = nlohmann::json::parse(ReadText(Checkpoint() / "summary.json"));
  EXPECT_EQ(partial["complete"], false);
  EXPECT_EQ(partial["frames_expected"], 500);
}

INSTANTIATE_TEST_SUITE_P(Signals, RunInterrupted, testing::Values(SIGINT, SIGTERM, SIGHUP));

/// The progress is written to a pipe that nobody reads.
TEST_F(Run, DoesNotEndWithTheReaderOfItsMessages) {
  for (int i = 5; i < 250; ++i) {
    fs::create_hard_link(images_ / "0.png", images_ / (std::to_string(i) + ".png"));
  }
  RunProgram("/bin/sh",
             {"-c", "{ sleep 0.1; exec " CORVO_COMMAND " run " + images_.string() + " --camera " +
                        camera_.string() + " -o " + result_.string() + " 2>&1; } | true"},
             {"PATH=/usr/bin:/bin"});
  while (fs::exists(result_ / ".corvo-unfinished")) usleep(1000);
  EXPECT_EQ(Summary()["complete"], true);
  EXPECT_EQ(Summary()["frames"], 250);
}

TEST_F(Run, IsToldOfAnotherRunIntoItsFolder) {
  const OutputFolder other(result_, PlanOfRun(false));
  ExpectError(RunHere(), "result: another corvo is writing into this folder");
}

TEST_F(Run, ThatWasKilledWhileItPutFilesInPlaceIsFinishedByTheNext) {
  RunHere();
  const fs::path work = result_ / ".corvo-unfinished";
  fs::create_directories(work / "old");
  fs::create_directories(work / "new");
  for (const char* name : {"manifest.json", "frames.csv"}) {
    fs::rename(result_ / name, work / "new" / name);
    WriteText(work / "old" / name, "of an earlier run");
  }
  const CommandResult eval = RunCorvo({"eval", result_, result_ / "trajectory.tum"});
  EXPECT_THAT(eval.err, HasSubstr("result: the files of two results are mixed"));
  { const OutputFolder next(result_, PlanOfRun(false)); }
  EXPECT_THAT(ReadText(result_ / "frames.csv"), StartsWith("index,timestamp"));
  EXPECT_FALSE(fs::exists(work));
}

TEST_F(Run, EvalRejectsAChangedFileUnlessItIsNamed) {
  RunHere();
  const std::string poses = "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 1 1 0 0 0 0 1\n";
  WriteText(result_ / "trajectory.tum", poses);
  const fs::path truth = folder_ / "truth.tum";
  WriteText(truth, poses);
  ExpectError(RunCorvo({"eval", result_, truth}),
              "trajectory.tum: is not the file that the run wrote, according to manifest.json");
  EXPECT_EQ(RunCorvo({"eval", result_ / "trajectory.tum", truth}).exit_code, 0);
}

TEST_F(Run, ShowsAProgressBarOnATerminalOnly) {
  if (!std::filesystem::exists("/dev/pts/ptmx")) GTEST_SKIP() << "no pseudo-terminals here";
  const std::vector<std::string> arguments = {"run", images_, "--camera", camera_, "-o", result_};
  const CommandResult shown = RunCorvoOnTerminal(arguments);
  EXPECT_EQ(shown.exit_code, kNeverInitialized);
  EXPECT_THAT(shown.err, AllOf(HasSubstr("\r\x1b[K[####"), HasSubstr("] frame 5 of 5: ")));
  EXPECT_THAT(shown.out, Not(HasSubstr("\x1b")));
  EXPECT_THAT(RunCorvo(arguments).err, IsEmpty());
}

/// Runs `corvo run` on 200 images of a kitchen with this focal length; about 525 px is correct.
CommandResult RunKitchen(const fs::path& folder, double focal_px,
                         const std::string& calibration = "estimate") {
  const std::string focal = std::to_string(focal_px);
  WriteText(folder / "camera.yaml", "model: pinhole\nwidth: 640\nheight: 480\nfx: " + focal +
                                        "\nfy: " + focal + "\ncx: 320\ncy: 240\n");
  return RunCorvo({"run", DataPath("7scenes/redkitchen"), "--gt", "none", "--count", "200",
                   "--camera", folder / "camera.yaml", "--calibration", calibration, "-o",
                   folder / "result"});
}

TEST(RunWithTheWrongCamera, WarnsThatTheCalibrationIsImplausible) {
  CORVO_SKIP_IF_SHORT();
  CORVO_REQUIRE_DATA("7scenes/redkitchen");
  const TemporaryFolder folder;
  const auto residuals = [&] {
    return nlohmann::json::parse(ReadText(folder / "result/summary.json"))["residuals"];
  };
  EXPECT_THAT(RunKitchen(folder.path(), 525).err, testing::Not(HasSubstr("implausible")));
  EXPECT_EQ(residuals()["implausible_calibration"], false);
  EXPECT_LT(residuals()["median_px"], 2);
  EXPECT_THAT(RunKitchen(folder.path(), 1170).err,
              HasSubstr("warning: the images contradict the given camera"));
  EXPECT_THAT(RunKitchen(folder.path(), 1755, "fixed").err,
              HasSubstr("warning: the calibration is implausible"));
  EXPECT_EQ(residuals()["implausible_calibration"], true);
  EXPECT_THAT(RunKitchen(folder.path(), 1.1 * 525, "fixed").err,
              HasSubstr("warning: the calibration is implausible"));
  EXPECT_GE(residuals()["parts_with_other_fx"], 2);
}

}  // namespace
}  // namespace corvo::test
