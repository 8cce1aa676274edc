// SPDX-License-Identifier: MIT
#include "tests/cli/example_folder.h"

#include <fmt/format.h>
#include <opencv2/videoio.hpp>

#include "tests/cli/tiny_sequence.h"
#include "tests/data/data_path.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;

const char* const kCamera =
    "model: pinhole-radtan\nwidth: 96\nheight: 64\nfx: 80\nfy: 80\ncx: 47.5\ncy: 31.5\n";

/// Writes a Motion JPEG video regardless of the extension of `file`: decoders detect the format
/// from the contents.
void WriteVideo(const fs::path& file) {
  const fs::path avi = file.parent_path() / "video.avi";
  cv::VideoWriter writer(avi.string(), cv::CAP_OPENCV_MJPEG,
                         cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25.0,
                         cv::Size(kTinyWidth, kTinyHeight), false);
  for (int i = 0; i < kExampleFrames; ++i) writer.write(TinyImage(i));
  writer.release();
  fs::rename(avi, file);
}

std::string KittiPoses() {
  std::string text;
  for (int i = 0; i < kExampleFrames; ++i) {
    text += fmt::format("1 0 0 {} 0 1 0 {} 0 0 1 {}\n", i, i % 3, i % 2);
  }
  return text;
}

/// Returns poses in EuRoC format at the times of WriteEuroc().
std::string EurocPoses() {
  std::string text;
  for (int i = 0; i < kExampleFrames; ++i) {
    text +=
        fmt::format("{},{},{},{},1,0,0,0\n", 1403636579763555584 + 50000000LL * i, i, i % 3, i % 2);
  }
  return text;
}

const cv::Mat kVga(480, 640, CV_8UC1, cv::Scalar(100));

/// Writes a sequence without a calibration; its images have the size in configs/tum_fr1.yaml.
void WriteFreiburg1(const fs::path& folder) {
  WriteTum(folder, kExampleFrames);
  for (const auto& entry : fs::directory_iterator(folder / "rgb")) {
    WriteImage(entry.path(), kVga);
  }
  WriteText(folder / "groundtruth.txt", ExamplePoses(1305031102.175304, 0.04));
}

void WriteTumVi(const fs::path& folder) {
  WriteEuroc(folder / "mav0", kExampleFrames);
  fs::remove(folder / "mav0/cam0/sensor.yaml");
  WriteText(folder / "mav0/mocap0/data.csv", EurocPoses());
  WriteText(folder / "dso/camchain.yaml",
            "cam0:\n  T_cam_imu:\n  - [0, -1, 0, 0]\n  - [0, 0, -1, 0]\n  - [1, 0, 0, -0.5]\n"
            "  - [0, 0, 0, 1]\n  camera_model: pinhole\n  distortion_model: equidistant\n"
            "  distortion_coeffs: [0.003, 0.0007, -0.002, 0.0002]\n"
            "  intrinsics: [40.5, 40.25, 47.5, 31.5]\n  resolution: [96, 64]\n");
}

void WriteTumMono(const fs::path& folder) {
  std::string times;
  for (int i = 0; i < kExampleFrames; ++i) {
    WriteImage(folder / fmt::format("images/{:05}.jpg", i), TinyImage(i));
    times += fmt::format("{:05} {:.6f} 1.5\n", i, 0.1 * i);
  }
  WriteText(folder / "times.txt", times);
  WriteText(folder / "camera.txt", "0.5 0.75 0.5 0.5 0.9\n96 64\ncrop\n96 64\n");
  WriteText(folder / "groundtruthSync.txt",
            ExamplePoses(0, 0.1) + "9 NaN NaN NaN NaN NaN NaN NaN\n");
}

void WriteKittiRaw(const fs::path& day) {
  const fs::path drive = day / "2011_09_26_drive_0001_sync";
  std::string times;
  for (int i = 0; i < kExampleFrames; ++i) {
    WriteImage(drive / fmt::format("image_00/data/{:010}.png", i), TinyImage(i));
    WriteText(drive / fmt::format("oxts/data/{:010}.txt", i),
              fmt::format("49 {:.6f} 100 0 0 {:.2f}\n", 8 + 1e-5 * i, 0.1 * i));
    times += fmt::format("2011-09-26 13:02:25.{}00000000\n", i);
  }
  WriteText(drive / "image_00/timestamps.txt", times);
  WriteText(drive / "oxts/timestamps.txt", times);
  WriteText(day / "calib_cam_to_cam.txt",
            "S_rect_00: 96 64\nR_rect_00: 1 0 0 0 1 0 0 0 1\n"
            "P_rect_00: 80 0 47.5 0 0 80 31.5 0 0 0 1 0\n");
  WriteText(day / "calib_velo_to_cam.txt", "R: 0 -1 0 0 0 -1 1 0 0\nT: 0 0 -0.3\n");
  WriteText(day / "calib_imu_to_velo.txt", "R: 1 0 0 0 1 0 0 0 1\nT: -0.8 0.3 -0.8\n");
}

void WriteTartanAir(const fs::path& folder) {
  std::string poses;
  for (int i = 0; i < kExampleFrames; ++i) {
    WriteImage(folder / fmt::format("image_left/{:06}_left.png", i), kVga);
    poses += fmt::format("{} {} {} 0 0 0 1\n", i, i % 3, i % 2);
  }
  WriteText(folder / "pose_left.txt", poses);
}

void WriteSevenScenes(const fs::path& folder) {
  for (int i = 0; i < kExampleFrames; ++i) {
    WriteImage(folder / fmt::format("frame-{:06}.color.png", i), kVga);
    WriteText(folder / fmt::format("frame-{:06}.pose.txt", i),
              fmt::format("1 0 0 {}\n0 1 0 {}\n0 0 1 {}\n0 0 0 1\n", i, i % 3, i % 2));
  }
}

void WriteImages(const fs::path& here) {
  WriteFolder(here / "images", kExampleFrames);
  WriteFolder(here / "left", kExampleFrames);
  for (int i = 0; i < kExampleFrames; ++i) {
    fs::rename(here / fmt::format("left/{}.png", i), here / fmt::format("images/left{}.png", i));
  }
  WriteVideo(here / "drive.mp4");
  WriteImage(here / "bonnet.png", cv::Mat(kTinyHeight, kTinyWidth, CV_8UC1, cv::Scalar(255)));
  for (const char* name : {"photographs/1.png", "bsds500/train/1.jpg"}) {
    WriteImage(here / name, SmoothImage(1, 320, 240));
  }
  for (const char* name : {"a.png", "b.png", "image.png"}) {
    WriteImage(here / name, TinyImage(7, 160, 120));
  }
}

void WriteBenchmarks(const fs::path& here) {
  for (const fs::path& folder : {here, here / "dataset"}) {
    WriteKitti(folder / "sequences/03", kExampleFrames);
    WriteText(folder / "poses/03.txt", KittiPoses());
  }
  WriteEuroc(here / "MH_01_easy/mav0", kExampleFrames);
  WriteText(here / "MH_01_easy/mav0/state_groundtruth_estimate0/data.csv", EurocPoses());
  WriteFreiburg1(here / "rgbd_dataset_freiburg1_xyz");
  WriteFreiburg1(here / "rgbd_dataset_freiburg1_rpy");
  WriteTumVi(here / "dataset-room1_512_16");
  WriteTumMono(here / "sequence_30");
  WriteSevenScenes(here / "redkitchen/seq-01");
  WriteKittiRaw(here / "2011_09_26");
  WriteTartanAir(here / "abandonedfactory/Easy/P000");
}

}  // namespace

std::string ExamplePoses(double first_s, double step_s) {
  std::string text;
  for (int i = 0; i < kExampleFrames; ++i) {
    text += fmt::format("{:.6f} {} {} {} 0 0 0 1\n", first_s + step_s * i, i, i % 3, i % 2);
  }
  return text;
}

ExampleFolder::ExampleFolder() {
  WriteBenchmarks(folder_.path());
  WriteImages(folder_.path());
  for (const char* name : {"camera.yaml", "phone.yaml", "left.yaml"}) {
    WriteText(folder_ / name, kCamera);
  }
  for (const char* name : {"truth.txt", "estimate.txt", "groundtruth.txt"}) {
    WriteText(folder_ / name, ExamplePoses(0, 0.1));
  }
  fs::create_directory_symlink(SourceDir() / "configs", folder_ / "configs");
}

CommandResult ExampleFolder::Run(const std::string& command) const {
  const std::string path = fs::path(CORVO_COMMAND).parent_path().string() + ":/usr/bin:/bin";
  return RunProgram("/bin/sh", {"-c", "cd '" + folder_.path().string() + "' && " + command},
                    {"PATH=" + path});
}

void ExampleFolder::ExpectRuns(const std::string& command) const {
  const CommandResult result = Run(command);
  const bool needs_scene =  // These images show no scene.
      command.starts_with("corvo run") || command.starts_with("corvo calibrate") ||
      command.starts_with("corvo drive.mp4");
  EXPECT_TRUE(result.exit_code == 0 || (needs_scene && result.exit_code == kNeverInitialized))
      << command << "\n"
      << result.out << result.err;
}

}  // namespace corvo::test
