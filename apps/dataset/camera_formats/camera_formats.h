// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/dataset/camera_formats/calibration_content.h"
#include "apps/dataset/camera_formats/stated_camera.h"

/// A pair of functions per form of calibration files. The first returns the names of the cameras in
/// a file, in its order; none if the file does not have the form, and a single empty name if the
/// form has no names. The second reads the camera of one of these names, and throws corvo::Error
/// with file, field and value if it is malformed or cannot be held by corvo's cameras. Files
/// in which integer pixel coordinates are not pixel centers are converted.
namespace corvo {

/// corvo's own camera file; see ReadCameraFile().
std::vector<std::string> CorvoCameras(const CalibrationContent& content);
StatedCamera ReadCorvoCamera(const CalibrationContent& content, const std::string& name);

/// OpenCV's FileStorage, as its calibration samples and applications write it, and camera_info of
/// ROS, which has the same matrices and names the model.
std::vector<std::string> OpenCvCameras(const CalibrationContent& content);
std::vector<std::string> RosCameras(const CalibrationContent& content);
StatedCamera ReadMatrixCamera(const CalibrationContent& content, const std::string& name);

/// A camchain of Kalibr: "cam0", "cam1", ...
std::vector<std::string> KalibrCameras(const CalibrationContent& content);
StatedCamera ReadKalibrCamera(const CalibrationContent& content, const std::string& name);

/// EuRoC's sensor.yaml.
std::vector<std::string> EurocCameras(const CalibrationContent& content);
StatedCamera ReadEurocCamera(const CalibrationContent& content, const std::string& name);

/// Settings of ORB-SLAM2 and ORB-SLAM3: "Camera", or "Camera1" and "Camera2".
std::vector<std::string> OrbSlamCameras(const CalibrationContent& content);
StatedCamera ReadOrbSlamCamera(const CalibrationContent& content, const std::string& name);

/// Settings of stella_vslam and OpenVSLAM.
std::vector<std::string> StellaCameras(const CalibrationContent& content);
StatedCamera ReadStellaCamera(const CalibrationContent& content, const std::string& name);

/// COLMAP's cameras.txt and cameras.bin, whose names are the ids of the cameras.
std::vector<std::string> ColmapTextCameras(const CalibrationContent& content);
StatedCamera ReadColmapTextCamera(const CalibrationContent& content, const std::string& name);
std::vector<std::string> ColmapBinaryCameras(const CalibrationContent& content);
StatedCamera ReadColmapBinaryCamera(const CalibrationContent& content, const std::string& name);

/// KITTI's calib.txt, whose names are those of its projection matrices: "P0", "P1", ...; and
/// calib_cam_to_cam.txt, with "P_rect_00", ... of rectified and "K_00", ... of raw images.
std::vector<std::string> KittiCameras(const CalibrationContent& content);
StatedCamera ReadKittiCamera(const CalibrationContent& content, const std::string& name);

/// DSO's and TUM-mono's camera.txt.
std::vector<std::string> DsoCameras(const CalibrationContent& content);
StatedCamera ReadDsoCamera(const CalibrationContent& content, const std::string& name);

/// A transforms.json of nerfstudio or instant-ngp.
std::vector<std::string> NerfstudioCameras(const CalibrationContent& content);
StatedCamera ReadNerfstudioCamera(const CalibrationContent& content, const std::string& name);

/// A calibration.yaml of VSLAM-LAB: a list of cameras, each with its name.
std::vector<std::string> VslamLabCameras(const CalibrationContent& content);
StatedCamera ReadVslamLabCamera(const CalibrationContent& content, const std::string& name);

/// One line "fx fy cx cy", followed by distortion coefficients in OpenCV's order, if any.
std::vector<std::string> OneLineCameras(const CalibrationContent& content);
StatedCamera ReadOneLineCamera(const CalibrationContent& content, const std::string& name);

/// A mapping with the keys fx, fy, cx, cy, and others as in OpenCV.
std::vector<std::string> PlainCameras(const CalibrationContent& content);
StatedCamera ReadPlainCamera(const CalibrationContent& content, const std::string& name);

}  // namespace corvo
