// SPDX-License-Identifier: MIT
#include "apps/dataset/camera_formats/calibration_file.h"

#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "apps/export/colmap_camera.h"
#include "apps/export/nerfstudio_transforms.h"
#include "apps/output/binary_data.h"
#include "tests/cli/expect_error.h"
#include "tests/data/temporary_folder.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Texts of calibration files by the name of their form.
using Texts = std::map<std::string, std::string>;

/// A camera whose numbers are exact in every form, with half a pixel added, and as fractions.
CameraParameters Undistorted() {
  CameraParameters camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = 520;
  camera.fy = 510;
  camera.cx = 319.5;
  camera.cy = 209.5;
  return camera;
}

CameraParameters RadialTangential() {
  CameraParameters camera = Undistorted();
  camera.k1 = -0.25;
  camera.k2 = 0.0625;
  camera.p1 = 0.001;
  camera.p2 = -0.002;
  return camera;
}

CameraParameters Fisheye() {
  CameraParameters camera = Undistorted();
  camera.model = CameraModel::kKb4;
  camera.k1 = 0.003;
  camera.k2 = 0.0007;
  camera.k3 = -0.002;
  camera.k4 = 0.0002;
  return camera;
}

CameraParameters Fov() {
  CameraParameters camera = Undistorted();
  camera.model = CameraModel::kFov;
  camera.omega = 0.9;
  return camera;
}

/// Returns `text` with its first `from` replaced.
std::string Replaced(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  return text.substr(0, at) + to + text.substr(at + from.size());
}

CalibrationFile Read(const std::string& text, const std::string& name = "") {
  const TemporaryFolder folder;
  WriteText(folder / "calibration", text);
  return ReadCalibrationFile(folder / "calibration", name);
}

/// Returns the error for a text, with the name of its file.
std::string ErrorFor(const std::string& text, const std::string& name = "") {
  const std::string error = ErrorOf([&] { Read(text, name); });
  EXPECT_THAT(error, HasSubstr("/calibration:")) << "names the file";
  return error;
}

void ExpectCamera(const CameraParameters& expected, const Texts& texts) {
  for (const auto& [form, text] : texts) {
    SCOPED_TRACE(form);
    try {
      EXPECT_EQ(Read(text).camera.ForImages(640, 480).camera.parameters(), expected);
    } catch (const Error& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

std::string Own(const std::string& model, const std::string& distortion) {
  return "model: " + model + "\nwidth: 640\nheight: 480\nfx: 520\nfy: 510\ncx: 319.5\ncy: 209.5\n" +
         distortion;
}

std::string OpenCvYaml(const std::string& more, const std::string& coefficients) {
  return "%YAML:1.0\n---\ncalibration_time: \"Mon Jan  1 10:00:00 2024\"\nnr_of_frames: 25\n"
         "image_width: 640\nimage_height: 480\nboard_width: 9\n" +
         more +
         "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
         "   data: [ 5.2000000000000000e+02, 0., 3.1950000000000000e+02, 0.,\n"
         "       510., 209.5, 0., 0., 1. ]\n"
         "distortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n"
         "   data: [ " +
         coefficients + " ]\navg_reprojection_error: 2.5e-01\n";
}

std::string OpenCvXml(const std::string& coefficients) {
  return "<?xml version=\"1.0\"?>\n<opencv_storage>\n<calibrationDate>\"now\"</calibrationDate>\n"
         "<!-- interactive calibration -->\n<cameraResolution>\n  640 480</cameraResolution>\n"
         "<cameraMatrix type_id=\"opencv-matrix\">\n  <rows>3</rows>\n  <cols>3</cols>\n"
         "  <dt>d</dt>\n  <data>\n    520. 0. 319.5 0. 5.1e+02 209.5 0. 0. 1.</data>"
         "</cameraMatrix>\n<dist_coeffs type_id=\"opencv-matrix\"><rows>1</rows><cols>5</cols>"
         "<dt>d</dt><data>\n    " +
         coefficients + "</data></dist_coeffs>\n<empty/>\n</opencv_storage>\n";
}

std::string OpenCvJson(const std::string& coefficients) {
  return "{\n    \"image_width\": 640,\n    \"image_height\": 480,\n    \"camera_matrix\": {\n"
         "        \"type_id\": \"opencv-matrix\", \"rows\": 3, \"cols\": 3, \"dt\": \"d\",\n"
         "        \"data\": [ 520.0, 0.0, 319.5, 0.0, 510.0, 209.5, 0.0, 0.0, 1.0 ]\n    },\n"
         "    \"distortion_coefficients\": { \"type_id\": \"opencv-matrix\", \"rows\": 5,\n"
         "\t\"cols\": 1, \"dt\": \"d\", \"data\": [ " +
         coefficients + " ] }\n}\n";
}

std::string Kalibr(const std::string& name, const std::string& distortion,
                   const std::string& coefficients) {
  return name + ":\n  cam_overlaps: []\n  camera_model: pinhole\n  distortion_coeffs: [" +
         coefficients + "]\n  distortion_model: " + distortion +
         "\n  intrinsics: [520.0, 510.0, 319.5, 209.5]\n  resolution: [640, 480]\n"
         "  rostopic: /" +
         name + "/image_raw\n";
}

std::string Euroc(const std::string& distortion, const std::string& coefficients) {
  return "%YAML:1.0\n# General sensor definitions.\nsensor_type: camera\nrate_hz: 20\n"
         "resolution: [640, 480]\ncamera_model: pinhole\n"
         "intrinsics: [520, 510, 319.5, 209.5] #fu, fv, cu, cv\ndistortion_model: " +
         distortion + "\ndistortion_coefficients: [" + coefficients + "]\n";
}

std::string Ros(const std::string& distortion, const std::string& coefficients) {
  return "image_width: 640\nimage_height: 480\ncamera_name: narrow_stereo\ncamera_matrix:\n"
         "  rows: 3\n  cols: 3\n  data: [520, 0, 319.5, 0, 510, 209.5, 0, 0, 1]\n"
         "distortion_model: " +
         distortion + "\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [" + coefficients +
         "]\nrectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n";
}

std::string OrbSlam(const std::string& camera, const std::string& more) {
  return fmt::format(
      "%YAML:1.0\n\n#--- Camera Parameters ---\n{0}.fx: 520.0\n{0}.fy: 510.0\n{0}.cx: 319.5\n"
      "{0}.cy: 209.5\n{1}Camera.fps: 25.0\nCamera.RGB: 1\nORBextractor.nFeatures: 2000\n",
      camera, more);
}

const std::string kOrbSlam3 =
    "File.version: \"1.0\"\nCamera.width: 640\nCamera.height: 480\nCamera.newWidth: 320\n";

std::string Stella(const std::string& model, const std::string& distortion) {
  return "Camera:\n  name: \"test\"\n  setup: \"monocular\"\n  model: \"" + model +
         "\"\n  fx: 520.0\n  fy: 510.0\n  cx: 319.5\n  cy: 209.5\n" + distortion +
         "  fps: 25.0\n  cols: 640\n  rows: 480\n  color_order: \"Gray\"\nFeature:\n  name: x\n";
}

std::string ColmapText(const std::string& model, const std::string& distortion) {
  return "# Camera list with one line of data per camera:\n"
         "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n# Number of cameras: 1\n1 " +
         model + " 640 480 520 510 320 210" + distortion + "\n";
}

std::string ColmapBinary(int model_id, const std::vector<double>& distortion,
                         std::uint64_t width = 640) {
  std::string bytes;
  AppendBytes<std::uint64_t>(1, bytes);
  AppendBytes<std::uint32_t>(7, bytes);
  AppendBytes<std::int32_t>(model_id, bytes);
  AppendBytes<std::uint64_t>(width, bytes);
  AppendBytes<std::uint64_t>(480, bytes);
  for (const double value : {520.0, 510.0, 320.0, 210.0}) AppendBytes(value, bytes);
  for (const double value : distortion) AppendBytes(value, bytes);
  return bytes;
}

/// A calib_cam_to_cam.txt with raw and rectified images of one camera.
const std::string kCamToCam =
    "calib_time: 09-Jan-2012 13:57:47\ncorner_dist: 9.950000e-02\nS_00: 640 480\n"
    "K_00: 520 0 319.5 0 510 209.5 0 0 1\nD_00: -0.25 0.0625 0.001 -0.002 0\n"
    "R_00: 1 0 0 0 1 0 0 0 1\nT_00: 0 0 0\nS_rect_00: 6.4e+02 4.8e+02\n"
    "R_rect_00: 1 0 0 0 1 0 0 0 1\nP_rect_00: 520 0 319.5 0 0 510 209.5 0 0 0 1 0\n";

std::string Transforms(const std::string& model, const std::string& distortion) {
  return "{\"camera_model\": \"" + model +
         "\", \"fl_x\": 520.0, \"fl_y\": 510.0, \"cx\": 320.0, \"cy\": 210.0, \"w\": 640, "
         "\"h\": 480.0" +
         distortion +
         ", \"frames\": [{\"file_path\": \"images/1.png\", \"transform_matrix\": [[1, 0, 0, 0], "
         "[0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}]}";
}

std::string VslamLab(const std::string& type, const std::string& coefficients) {
  return "cameras:\n- cam_name: rgb_0\n  cam_type: rgb\n  cam_model: pinhole\n"
         "  focal_length: [520.0, 510.0]\n  principal_point: [319.5, 209.5]\n"
         "  distortion_type: " +
         type + "\n  distortion_coefficients: [" + coefficients +
         "]\n  image_dimension: [640, 480]\n  fps: 15.0\n";
}

TEST(CalibrationFiles, OfAllFormsAreTheSameCamera) {
  const std::string four = "-0.25, 0.0625, 0.001, -0.002";
  const std::string lines = "k1: -0.25\nk2: 0.0625\np1: 0.001\np2: -0.002\n";
  const std::string blanks = "-2.5e-01 6.25e-02 1e-03 -2e-03";
  const auto prefixed = [](const std::string& name) {
    return fmt::format("{0}.k1: -0.25\n{0}.k2: 0.0625\n{0}.p1: 0.001\n{0}.p2: -0.002\n", name);
  };
  const std::string json = ", \"k1\": -0.25, \"k2\": 0.0625, \"p1\": 0.001, \"p2\": -0.002";
  ExpectCamera(
      RadialTangential(),
      {{"corvo", Own("pinhole-radtan", lines)},
       {"OpenCV yml", OpenCvYaml("flags: 0\nfisheye_model: 0\n", four + ", 0.")},
       {"OpenCV xml", OpenCvXml(blanks + " 0.")},
       {"OpenCV json", OpenCvJson(four + ", 0.0")},
       {"OpenCV rational", OpenCvYaml("", four + ", 0., 0., 0., 0.")},
       {"lists of lists",
        "{\"camera_matrix\": [[520, 0, 319.5], [0, 510, 209.5], [0, 0, 1]], "
        "\"dist_coeff\": [[-0.25, 0.0625, 0.001, -0.002, 0]]}"},
       {"Kalibr", Kalibr("cam0", "radtan", four)},
       {"EuRoC", Euroc("radial-tangential", four)},
       {"ROS", Ros("plumb_bob", four + ", 0")},
       {"ROS rational", Ros("rational_polynomial", four + ", 0, 0, 0, 0")},
       {"ORB-SLAM2", OrbSlam("Camera", prefixed("Camera"))},
       {"ORB-SLAM3",
        OrbSlam("Camera1", kOrbSlam3 + "Camera.type: \"PinHole\"\n" + prefixed("Camera1"))},
       {"stella",
        Stella("perspective", "  k1: -0.25\n  k2: 0.0625\n  p1: 0.001\n  p2: -0.002\n  k3: 0.0\n")},
       {"OpenVSLAM", OrbSlam("Camera",
                             "Camera.model: \"perspective\"\nCamera.cols: 640\n"
                             "Camera.rows: 480\n" +
                                 prefixed("Camera"))},
       {"COLMAP text", ColmapText("OPENCV", " " + blanks)},
       {"COLMAP full", ColmapText("FULL_OPENCV", " " + blanks + " 0 0 0 0")},
       {"COLMAP binary", ColmapBinary(4, {-0.25, 0.0625, 0.001, -0.002})},
       {"KITTI", kCamToCam.substr(0, kCamToCam.find("S_rect"))},
       {"DSO", "RadTan 0.8125 1.0625 0.5 0.4375 " + blanks + "\n640 480\ncrop\n640 480\n"},
       {"DSO, px", "RadTan 520 510 319.5 209.5 " + blanks + "\n640 480\nnone\n640 480\n"},
       {"DSO, unnamed", "520 510 319.5 209.5 " + blanks + "\n640 480\nnone\n640 480\n"},
       {"nerfstudio", Transforms("OPENCV", json)},
       {"VSLAM-LAB", VslamLab("radtan4", four)},
       {"one line", "520 510 319.5 209.5 " + blanks + "\r\n"},
       {"JSON",
        "{\"image_width\": 640, \"image_height\": 480, \"fx\": 520, \"fy\": 510, "
        "\"cx\": 319.5, \"cy\": 209.5" +
            json + "}"}});
}

TEST(CalibrationFiles, OfFisheyeLensesAreTheSameCamera) {
  const std::string list = "0.003, 0.0007, -0.002, 0.0002";
  const std::string blanks = " 0.003 0.0007 -0.002 0.0002";
  ExpectCamera(
      Fisheye(),
      {{"corvo", Own("kb4", "k1: 0.003\nk2: 0.0007\nk3: -0.002\nk4: 0.0002\n")},
       {"OpenCV", OpenCvYaml("fisheye_model: 1\n", list)},
       {"Kalibr", Kalibr("cam0", "equidistant", list)},
       {"EuRoC", Euroc("equidistant", list)},
       {"ROS", Ros("equidistant", list)},
       {"VSLAM-LAB", VslamLab("equid4", list)},
       {"ORB-SLAM3", OrbSlam("Camera1",
                             "Camera.type: \"KannalaBrandt8\"\nCamera1.k1: 0.003\n"
                             "Camera1.k2: 0.0007\nCamera1.k3: -0.002\n"
                             "Camera1.k4: 0.0002\n" +
                                 kOrbSlam3)},
       {"stella", Stella("fisheye", "  k1: 0.003\n  k2: 0.0007\n  k3: -0.002\n  k4: 0.0002\n")},
       {"COLMAP text", ColmapText("OPENCV_FISHEYE", blanks)},
       {"COLMAP binary", ColmapBinary(5, {0.003, 0.0007, -0.002, 0.0002})},
       {"DSO", "EquiDistant 0.8125 1.0625 0.5 0.4375" + blanks + "\n640 480\ncrop\n640 480\n"},
       {"nerfstudio", Transforms("OPENCV_FISHEYE",
                                 ", \"k1\": 0.003, \"k2\": 0.0007, "
                                 "\"k3\": -0.002, \"k4\": 0.0002")}});
}

TEST(CalibrationFiles, OfTheFieldOfViewModelAreTheSameCamera) {
  ExpectCamera(Fov(), {{"corvo", Own("fov", "omega: 0.9\n")},
                       {"Kalibr", Kalibr("cam0", "fov", "0.9")},
                       {"COLMAP text", ColmapText("FOV", " 0.9")},
                       {"COLMAP binary", ColmapBinary(7, {0.9})},
                       {"TUM-mono", "0.8125 1.0625 0.5 0.4375 0.9\n640 480\ncrop\n640 480\n"},
                       {"DSO", "FOV 0.8125 1.0625 0.5 0.4375 0.9\n640 480\ncrop\n640 480\n"},
                       {"DSO, px", "FOV 520 510 319.5 209.5 0.9\n640 480\nfull\n640 480\n"}});
}

TEST(CalibrationFiles, WithoutDistortionAreTheSameCamera) {
  ExpectCamera(
      Undistorted(),
      {{"corvo", Own("pinhole", "")},
       {"OpenCV", OpenCvYaml("", "0., 0., 0., 0., 0.")},
       {"Kalibr", Kalibr("cam0", "none", "")},
       {"ORB-SLAM2", OrbSlam("Camera", "")},
       {"ORB-SLAM3", OrbSlam("Camera1", kOrbSlam3 + "Camera.type: \"Rectified\"\nCamera1.k1: 5\n")},
       {"COLMAP text", ColmapText("PINHOLE", "")},
       {"COLMAP, omega 0", ColmapText("FOV", " 0")},
       {"COLMAP binary", ColmapBinary(1, {})},
       {"KITTI odometry",
        "P0: 520 0 319.5 0 0 510 209.5 0 0 0 1 0\n"
        "P1: 520 0 319.5 -386 0 510 209.5 0 0 0 1 0\n"},
       {"KITTI raw", kCamToCam},
       {"DSO", "Pinhole 0.8125 1.0625 0.5 0.4375 0\n640 480\nnone\n640 480\n"},
       {"DSO, px", "Pinhole 520 510 319.5 209.5 0\n"},
       {"DSO, unnamed", "520 510 319.5 209.5 0\n640 480\nnone\n640 480\n"},
       {"nerfstudio", Transforms("OPENCV", "")},
       {"one line", "520,510,319.5,209.5"}});
}

TEST(CalibrationFiles, KeepTheThirdRadialCoefficient) {
  CameraParameters expected = RadialTangential();
  expected.k3 = 0.5;
  const std::string list = "-0.25, 0.0625, 0.001, -0.002, 0.5";
  ExpectCamera(expected,
               {{"OpenCV", OpenCvYaml("", list)},
                {"Kalibr", Kalibr("cam0", "radtan", list)},
                {"ROS", Ros("plumb_bob", list)},
                {"COLMAP", ColmapText("FULL_OPENCV", " -0.25 0.0625 0.001 -0.002 0.5 0 0 0")},
                {"one line", "520 510 319.5 209.5 -0.25 0.0625 0.001 -0.002 0.5"}});
}

TEST(CalibrationFiles, OfOneFocalLengthHaveItTwice) {
  const std::string size = " 640 480 500 320 240";
  for (const auto& [text, k1, k2, model] :
       std::vector<std::tuple<std::string, double, double, CameraModel>>{
           {"SIMPLE_PINHOLE" + size, 0, 0, CameraModel::kPinhole},
           {"SIMPLE_RADIAL" + size + " 0.1", 0.1, 0, CameraModel::kPinhole},
           {"RADIAL" + size + " 0.1 0.2", 0.1, 0.2, CameraModel::kPinhole},
           {"SIMPLE_RADIAL_FISHEYE" + size + " 0.1", 0.1, 0, CameraModel::kKb4},
           {"RADIAL_FISHEYE" + size + " 0.1 0.2", 0.1, 0.2, CameraModel::kKb4}}) {
    const CameraParameters camera = Read("3 " + text + "\n").camera.parameters;
    EXPECT_EQ(camera.fx, 500) << text;
    EXPECT_EQ(camera.fy, 500) << text;
    EXPECT_EQ(camera.cx, 319.5) << text;
    EXPECT_EQ(camera.cy, 239.5) << text;
    EXPECT_EQ(camera.k1, k1) << text;
    EXPECT_EQ(camera.k2, k2) << text;
    EXPECT_EQ(camera.model, model) << text;
  }
}

TEST(CalibrationFiles, ThatCorvoExportsAreReadBack) {
  for (const CameraParameters& camera : {Undistorted(), RadialTangential(), Fisheye(), Fov()}) {
    const ColmapCamera colmap = ToColmap(camera);
    EXPECT_EQ(
        Read(fmt::format("1 {} 640 480 {}\n", colmap.model, fmt::join(colmap.parameters, " ")))
            .camera.parameters,
        camera);
    if (camera.model == CameraModel::kFov) continue;
    Reconstruction reconstruction;
    reconstruction.camera = camera;
    EXPECT_EQ(Read(ToTransforms(reconstruction, "images", "points.ply").dump()).camera.parameters,
              camera);
  }
}

TEST(CalibrationFiles, WithoutASizeTakeThatOfTheImages) {
  for (const std::string& text :
       {OrbSlam("Camera", ""), std::string("520 510 319.5 209.5\n"),
        std::string("P0: 520 0 319.5 0 0 510 209.5 0 0 0 1 0\n"),
        std::string("Pinhole 520 510 319.5 209.5 0\n"),
        std::string("{\"fx\": 520, \"fy\": 510, \"cx\": 319.5, \"cy\": 209.5}")}) {
    const StatedCamera camera = Read(text).camera;
    EXPECT_FALSE(camera.has_size()) << text;
    const CameraParameters resolved = camera.ForImages(600, 400).camera.parameters();
    EXPECT_EQ(resolved.width, 600) << text;
    EXPECT_EQ(resolved.height, 400) << text;
  }
  const StatedCamera stated = Read(Own("pinhole", "")).camera;
  EXPECT_TRUE(stated.has_size());
  EXPECT_EQ(stated.ForImages(600, 400).camera.width(), 640);
}

TEST(CalibrationFiles, StateTheFrameRate) {
  const auto rate_of = [](const std::string& text) { return Read(text).camera.frame_rate_hz; };
  EXPECT_EQ(rate_of(Own("pinhole", "frame_rate_hz: 12\n")), 12);
  EXPECT_EQ(rate_of(Euroc("radial-tangential", "0, 0, 0, 0")), 20);
  EXPECT_EQ(rate_of(OrbSlam("Camera", "")), 25);
  EXPECT_EQ(rate_of(Stella("perspective", "")), 25);
  EXPECT_EQ(rate_of(VslamLab("radtan5", "0, 0, 0, 0, 0")), 15);
  EXPECT_EQ(rate_of(OpenCvYaml("", "0., 0., 0., 0., 0.")), std::nullopt);
  const std::string settings = OrbSlam("Camera", "");
  EXPECT_EQ(rate_of(Replaced(settings, "25.0", "0")), std::nullopt);
  EXPECT_THAT(ErrorFor(Replaced(settings, "25.0", "-5")),
              HasSubstr("Camera.fps is -5; allowed is"));
}

TEST(CalibrationFiles, KeepTheSigmaOfCorvo) {
  const StatedCamera camera = Read(Own("pinhole", "source: test\nsigma:\n  focal: 0.02\n")).camera;
  const CameraFile file = camera.ForImages(640, 480);
  EXPECT_EQ(file.source, "test");
  EXPECT_THAT(*file.sigma, ElementsAre(FreeParameter{"focal", 0.02}));
}

TEST(CalibrationFiles, OfSeveralCamerasGiveTheFirstOrTheNamedOne) {
  const std::string second = Replaced(Kalibr("cam1", "radtan", "0, 0, 0, 0"), "520", "600");
  const std::string chain = Kalibr("cam0", "radtan", "0, 0, 0, 0") + second;
  EXPECT_THAT(Read(chain).names, ElementsAre("cam0", "cam1"));
  EXPECT_EQ(Read(chain).name, "cam0");
  EXPECT_EQ(Read(chain).camera.parameters.fx, 520);
  EXPECT_EQ(Read(chain, "cam1").camera.parameters.fx, 600);
  EXPECT_THAT(ErrorFor(chain, "cam2"), HasSubstr("holds no camera cam2; it holds cam0, cam1"));
  const std::string two = "1 PINHOLE 640 480 520 510 320 210\n12 PINHOLE 640 480 600 510 320 210\n";
  EXPECT_EQ(Read(two, "12").camera.parameters.fx, 600);
  EXPECT_EQ(Read(kCamToCam, "K_00").camera.parameters, RadialTangential());
  EXPECT_EQ(Read(kCamToCam).name, "P_rect_00");
  EXPECT_EQ(Read(ColmapBinary(1, {}), "7").camera.parameters, Undistorted());
  EXPECT_THAT(ErrorFor(Own("pinhole", ""), "cam0"), HasSubstr("one camera without a name"));
  EXPECT_EQ(Read(OrbSlam("Camera1", "Camera2.fx: 1\n")).name, "Camera1");
}

TEST(CalibrationFiles, ACameraThatIsNotWantedMayHaveAnotherModel) {
  const std::string other = Replaced(Kalibr("cam0", "radtan", "0, 0, 0, 0"), "pinhole", "ds");
  const std::string chain = other + Kalibr("cam1", "radtan", "0, 0, 0, 0");
  EXPECT_EQ(Read(chain, "cam1").camera.parameters, Undistorted());
  EXPECT_THAT(ErrorFor(chain), HasSubstr("cam0.camera_model is 'ds'; only pinhole can be read"));
}

TEST(CalibrationFiles, OfModelsThatCorvoLacksAreErrorsThatNameThem) {
  const std::string rational = "0.1, 0, 0, 0, 0, 0.25, 0, 0";
  for (const std::string model : {"omni", "eucm", "ds"}) {
    const std::string chain = Replaced(Kalibr("cam0", "none", ""), "pinhole", model);
    EXPECT_THAT(ErrorFor(chain), HasSubstr("cam0.camera_model is '" + model + "'"));
  }
  EXPECT_THAT(ErrorFor(Euroc("mei", "0")), HasSubstr("distortion_model is 'mei'; only"));
  EXPECT_THAT(ErrorFor(OpenCvYaml("", rational)),
              AllOf(HasSubstr("distortion_coefficients: k4 is 0.25"),
                    HasSubstr("no model rational_polynomial")));
  EXPECT_THAT(ErrorFor(OpenCvXml("0 0 0 0 0 0 0 0 1e-3 0 0 0")), HasSubstr("dist_coeffs: s1 is"));
  EXPECT_THAT(ErrorFor(Ros("rational_polynomial", rational)), HasSubstr("k4 is 0.25"));
  EXPECT_THAT(ErrorFor(Ros("thin_prism", rational)),
              HasSubstr("distortion_model is 'thin_prism'; only plumb_bob, rational"));
  EXPECT_THAT(ErrorFor(ColmapText("FULL_OPENCV", " 0 0 0 0 0 0 0.5 0")),
              AllOf(HasSubstr("calibration:4: PARAMS: k5 is 0.5"), HasSubstr("FULL_OPENCV")));
  EXPECT_THAT(ErrorFor(ColmapText("THIN_PRISM_FISHEYE", " 0 0 0 0 0 0 0 0")),
              HasSubstr("MODEL is 'THIN_PRISM_FISHEYE'"));
  EXPECT_THAT(ErrorFor(ColmapText("EQUIRECTANGULAR", "")), HasSubstr("'EQUIRECTANGULAR'"));
  EXPECT_THAT(ErrorFor(ColmapBinary(10, std::vector<double>(8))), HasSubstr("THIN_PRISM_FISHEYE"));
  EXPECT_THAT(ErrorFor(VslamLab("double-sphere", "0.1, 0.2")),
              AllOf(HasSubstr("cameras[0].distortion_type"), HasSubstr("'double-sphere'")));
  EXPECT_THAT(ErrorFor(Stella("equirectangular", "")),
              HasSubstr("Camera.model is 'equirectangular'; only perspective and fisheye"));
  EXPECT_THAT(ErrorFor(OrbSlam("Camera1", "Camera.type: \"Mei\"\n")),
              HasSubstr("Camera.type is 'Mei'; only PinHole, KannalaBrandt8"));
  EXPECT_THAT(ErrorFor(Transforms("EQUIRECTANGULAR", "")), HasSubstr("camera_model is 'EQUI"));
  EXPECT_THAT(ErrorFor(Transforms("OPENCV", ", \"k4\": 0.5")), HasSubstr("k4 is 0.5"));
  EXPECT_THAT(ErrorFor(Transforms("OPENCV_FISHEYE", ", \"p1\": 0.5")),
              AllOf(HasSubstr("p1 is 0.5"), HasSubstr("OPENCV_FISHEYE")));
}

TEST(CalibrationFiles, WithSkewAreErrors) {
  const std::string skewed =
      Replaced(OpenCvYaml("", "0., 0., 0., 0., 0."), "0., 3.195", "2., 3.195");
  EXPECT_THAT(ErrorFor(skewed), AllOf(HasSubstr("camera_matrix: the skew"), HasSubstr("is 2")));
  EXPECT_THAT(ErrorFor("P0: 520 3 319.5 0 0 510 209.5 0 0 0 1 0\n"),
              HasSubstr("calibration:1: P0: the skew, in row 1, column 2, is 3"));
}

TEST(CalibrationFiles, ThatAreMalformedAreErrorsThatNameTheField) {
  const std::string broken = Replaced(Kalibr("cam0", "radtan", "0, 0, 0, 0"), "520.0", "five");
  EXPECT_THAT(ErrorFor(broken), HasSubstr("cam0.intrinsics: 'five' is not a number"));
  EXPECT_THAT(ErrorFor(Kalibr("cam0", "radtan", "0, 0")),
              HasSubstr("cam0.distortion_coeffs is not a list of 4 to 5 numbers"));
  EXPECT_THAT(ErrorFor("Camera.fx: 520\nCamera.fy: 510\nCamera.cx: 319.5\n"),
              HasSubstr("Camera.cy is missing"));
  EXPECT_THAT(ErrorFor("camera_matrix: [1, 0, 0]\n"),
              HasSubstr("camera_matrix is not a list of 9 numbers"));
  EXPECT_THAT(ErrorFor("{\"fx\": -520, \"fy\": 510, \"cx\": 319.5, \"cy\": 209.5}"),
              HasSubstr("camera.fx is -520; allowed is"));
  EXPECT_THAT(ErrorFor("{\"fx\": [1], \"fy\": 510, \"cx\": 319.5, \"cy\": 209.5}"),
              HasSubstr("fx is not a text"));
  EXPECT_THAT(ErrorFor(ColmapText("OPENCV", " 0 0 0")),
              HasSubstr("7 parameters; the model OPENCV has 8"));
  EXPECT_THAT(ErrorFor(ColmapBinary(1, {}, 1ULL << 40)), HasSubstr("camera 7: width is"));
  EXPECT_THAT(ErrorFor("K_02: 520 0 319.5 0 510 209.5 0 0 1\n"), HasSubstr("has no row S_02:"));
  EXPECT_THAT(ErrorFor("RadTan 520 510 319.5 209.5 0 0 0\n640 480\n"),
              HasSubstr("calibration:1: 7 numbers; the model RadTan has 8"));
  EXPECT_THAT(ErrorFor("Pinhole 520 510 319.5 209.5 0.9\n640 480\n"),
              HasSubstr("the number after cy is 0.9; it is 0 in the model Pinhole"));
  EXPECT_THAT(ErrorFor("0.8125 1.0625 0.5 0.4375 0.9\n"), HasSubstr("has no second line"));
  EXPECT_THAT(ErrorFor("0.8125 1.0625 319.5 0.4375 0.9\n640 480\n"),
              HasSubstr("both must be fractions"));
  EXPECT_THAT(ErrorFor("1 2 3 4 nan\n"), HasSubstr("'nan' is not a number"));
  EXPECT_THAT(ErrorFor(Own("pinhole", "k7: 0.1\n")), HasSubstr("unknown key k7"));
}

TEST(CalibrationFiles, OfUnknownFormsAreErrorsThatListTheKnownOnes) {
  for (const std::string& text :
       {std::string(), std::string("just a text"), std::string("tracker:\n  min_matches: 5\n"),
        std::string("1 2 3\n4 5 6\n"), std::string("[1, 2]"), std::string("{\"a\": 1}"),
        std::string("\0\1\2\3", 4), ColmapBinary(77, {}), ColmapBinary(1, {}) + "more",
        ColmapBinary(4, {0.0}), std::string("<opencv_storage></opencv_storage>")}) {
    EXPECT_THAT(ErrorFor(text),
                AllOf(HasSubstr("is no camera file of a known form; known are: "),
                      HasSubstr("COLMAP cameras.txt"), HasSubstr("KITTI calib.txt"),
                      HasSubstr("DSO camera.txt"), HasSubstr("Kalibr"), HasSubstr("EuRoC"),
                      HasSubstr("ROS"), HasSubstr("OpenCV"), HasSubstr("stella_vslam"),
                      HasSubstr("ORB-SLAM3"), HasSubstr("nerfstudio"), HasSubstr("corvo's")))
        << text;
  }
}

TEST(CalibrationFiles, OfXmlHaveErrorsWithLines) {
  EXPECT_THAT(ErrorFor("<html>\n</html>"), HasSubstr("<html> is not <opencv_storage>"));
  EXPECT_THAT(ErrorFor("<opencv_storage>\n<a>1</b>\n"), HasSubstr("calibration:2: '</a>'"));
  EXPECT_THAT(ErrorFor("<opencv_storage>\n<a>1<b>2</b></a></opencv_storage>"),
              HasSubstr("calibration:2: an element is inside of text"));
  EXPECT_THAT(ErrorFor("<opencv_storage>\n\n<!DOCTYPE x></opencv_storage>"),
              HasSubstr("is not the start of an element"));
  EXPECT_THAT(ErrorFor("<opencv_storage></opencv_storage>\nmore"), HasSubstr("text after"));
  EXPECT_THAT(ErrorFor("<?xml"), HasSubstr("'?>' is missing"));
}

TEST(CalibrationFiles, AreBounded) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_THAT(ErrorFor("<opencv_storage>" + deep), HasSubstr("too deeply nested"));
  std::string many = "<opencv_storage>";
  for (int i = 0; i < 200000; ++i) many += "<a/>";
  EXPECT_THAT(ErrorFor(many), HasSubstr("too many"));
  std::string lists = "{\"fx\": ";
  EXPECT_THAT(ErrorFor(lists + std::string(50000, '[') + std::string(50000, ']') + "}"),
              HasSubstr("too many or too deeply nested"));
  std::string values = "{\"fx\": [0";
  for (int i = 0; i < 200000; ++i) values += ",0";
  EXPECT_THAT(ErrorFor(values + "]}"), HasSubstr("too many"));
  EXPECT_THAT(ErrorFor("fx: 1 #" + std::string(2 << 20, 'x')), HasSubstr("1048576"));
  EXPECT_THAT(ErrorFor(std::string(17 << 20, '\0')), HasSubstr("16777216"));
}

TEST(CalibrationFiles, OfNerfstudioMayHaveManyPoses) {
  std::string text = Transforms("OPENCV", "");
  const std::string pose =
      text.substr(text.find("{\"file_path"), text.find("]}]}") + 2 - text.find("{\"file_path"));
  std::string poses;
  for (int i = 0; i < 20000; ++i) poses += pose + ",";
  text.insert(text.find("{\"file_path"), poses);
  EXPECT_EQ(Read(text).camera.parameters, Undistorted());
}

TEST(CalibrationFiles, MayHaveByteOrderMarksAndAnyLineEnds) {
  std::string windows;
  for (const char c : OpenCvYaml("", "-0.25, 0.0625, 0.001, -0.002, 0.")) {
    windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  }
  ExpectCamera(RadialTangential(), {{"YAML", "\xEF\xBB\xBF" + windows}});
  ExpectCamera(Undistorted(), {{"JSON", "\xEF\xBB\xBF" + Transforms("OPENCV", "")},
                               {"text",
                                "\xEF\xBB\xBF"
                                "520 510 319.5 209.5\r"}});
  EXPECT_THAT(ErrorFor(std::string("\xFF\xFE{\0", 4)), HasSubstr("is UTF-16"));
}

}  // namespace
}  // namespace corvo::test
