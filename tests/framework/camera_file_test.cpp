// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <gtest/gtest.h>

#include <opencv2/core/persistence.hpp>

#include "anneal6d/framework/camera_model.h"
#include "file_test_support.h"

namespace anneal6d {
namespace {

using test::content_of;
using test::expect_file_error;
using test::golden;
using test::replaced;
using test::TemporaryFolder;

void expect_is_golden_camera(const CameraModel& camera) {
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_EQ(camera.height_px, 480);
  EXPECT_EQ(camera.fx_px, 800.5);
  EXPECT_EQ(camera.fy_px, 801.25);
  EXPECT_EQ(camera.cx_px, 320.125);
  EXPECT_EQ(camera.cy_px, 240.75);
  EXPECT_EQ(camera.distortion, (std::array<double, 5>{-0.25, 0.125, 0.001, -0.002, 0}));
}

class CameraFile : public testing::Test {
 protected:
  /// Expects an error for a golden file in which `from` is replaced by `to`.
  void expect_error(const std::string& name, const std::string& from, const std::string& to,
                    const std::string& place, const std::string& words) {
    expect_error(replaced(content_of(golden(name)), from, to), place, words);
  }
  void expect_error(const std::string& content, const std::string& place,
                    const std::string& words) {
    const auto path = folder_.write("camera.yml", content);
    expect_file_error([&] { load_camera(path); }, path, place, words);
  }
  TemporaryFolder folder_;
};

TEST_F(CameraFile, ReadsEveryFormatAlike) {
  for (const char* name :
       {"opencv.yml", "ros.yaml", "ros_flow.yaml", "ivt_mono.txt", "ivt_stereo.txt"}) {
    SCOPED_TRACE(name);
    expect_is_golden_camera(load_camera(golden(name)));
  }
}

TEST_F(CameraFile, ReadsWindowsLineEnds) {
  std::string content;
  for (const char c : content_of(golden("opencv.yml")))
    content += c == '\n' ? "\r\n" : std::string(1, c);
  expect_is_golden_camera(load_camera(folder_.write("camera.yml", content)));
}

TEST_F(CameraFile, ReadsStereoWithoutItsTail) {
  const std::string content = content_of(golden("ivt_stereo.txt"));
  const std::size_t tail = content.rfind("\n\n");
  expect_is_golden_camera(load_camera(folder_.write("stereo.txt", content.substr(0, tail))));
}

TEST_F(CameraFile, ReadsFourAndEightCoefficientsIfTheRestIsZero) {
  const std::string ros = content_of(golden("ros.yaml"));
  const std::string list = "[-0.25, 0.125, 0.001, -0.002, 0]";
  const std::string four =
      replaced(replaced(ros, "cols: 5", "cols: 4"), list, "[-0.25, 0.125, 0.001, -0.002]");
  expect_is_golden_camera(load_camera(folder_.write("four.yaml", four)));
  const std::string eight = replaced(replaced(ros, "cols: 5", "cols: 8"), list,
                                     "[-0.25, 0.125, 0.001, -0.002, 0, 0.0, 0, 0e3]");
  expect_is_golden_camera(load_camera(folder_.write("eight.yaml", eight)));
}

TEST_F(CameraFile, SkipsWhatLiesDeeper) {
  const std::string extra =
      "  history:\n    rows: 7\n    - rows: 8\n      note: 'a: b # c'\nlist:\n- a: 1\n  b: 2\n- a: "
      "3\n  b: 4\n";
  const std::string content =
      replaced(content_of(golden("ros.yaml")), "distortion_model", extra + "distortion_model");
  expect_is_golden_camera(load_camera(folder_.write("camera.yml", content)));
}

TEST_F(CameraFile, ReadsWhatItWrites) {
  CameraModel camera = load_camera(golden("opencv.yml"));
  camera.fx_px = 1000.0 / 3;
  camera.distortion[4] = 1e-17;
  const auto path = folder_.path() / "written.yml";
  save_camera(camera, path);
  const CameraModel read = load_camera(path);
  EXPECT_EQ(read.fx_px, camera.fx_px);
  EXPECT_EQ(read.cy_px, camera.cy_px);
  EXPECT_EQ(read.distortion, camera.distortion);
}

TEST_F(CameraFile, WritesWhatOpenCvReads) {
  const auto path = folder_.path() / "written.yml";
  save_camera(load_camera(golden("opencv.yml")), path);
  const cv::FileStorage storage(path.string(), cv::FileStorage::READ);
  cv::Mat matrix, distortion;
  storage["camera_matrix"] >> matrix;
  storage["distortion_coefficients"] >> distortion;
  EXPECT_EQ(static_cast<int>(storage["image_width"]), 640);
  ASSERT_EQ(matrix.size(), cv::Size(3, 3));
  EXPECT_EQ(matrix.at<double>(1, 1), 801.25);
  ASSERT_EQ(distortion.total(), 5U);
  EXPECT_EQ(distortion.at<double>(3), -0.002);
}

TEST_F(CameraFile, ReadsWhatOpenCvWrites) {
  const auto path = folder_.path() / "opencv.yml";
  {
    cv::FileStorage storage(path.string(), cv::FileStorage::WRITE);
    storage << "image_width" << 640 << "image_height" << 480;
    storage << "grid" << std::vector<cv::Point2f>(20, {1, 2});
    storage << "camera_matrix"
            << cv::Mat(cv::Matx33d(800.5, 0, 320.125, 0, 801.25, 240.75, 0, 0, 1));
    storage << "distortion_coefficients"
            << cv::Mat(cv::Vec<double, 5>(-0.25, 0.125, 0.001, -0.002, 0));
  }
  expect_is_golden_camera(load_camera(path));
}

TEST_F(CameraFile, RejectsAMissingAnEmptyAndABinaryFile) {
  const auto missing = folder_.path() / "missing.yml";
  expect_file_error([&] { load_camera(missing); }, missing, "", "does not exist");
  expect_file_error([&] { load_camera(folder_.path()); }, folder_.path(), "", "is a folder");
  expect_error("", "", "is empty");
  expect_error(" \n\n", "", "is empty");
  expect_error(content_of(golden("box.png")), "", "none of the known formats");
  expect_error("<?xml version='1.0'?>", "", "none of the known formats");
}

TEST_F(CameraFile, RejectsMissingKeys) {
  expect_error("opencv.yml", "image_width", "image_with", "", "'image_width' is missing");
  expect_error("opencv.yml", "camera_matrix", "matrix", "", "'camera_matrix.rows' is missing");
  expect_error("ros.yaml", "distortion_coefficients", "d", "",
               "'distortion_coefficients.rows' is missing");
}

TEST_F(CameraFile, RejectsATruncatedYamlFile) {
  const std::string content = content_of(golden("opencv.yml"));
  expect_error(content.substr(0, content.find("8.0125")), "line 13", "not closed");
}

TEST_F(CameraFile, RejectsWrongValues) {
  expect_error("ros.yaml", "640", "VGA", "line 1 (image_width)", "whole number");
  expect_error("ros.yaml", "640", "640.5", "line 1 (image_width)", "whole number");
  expect_error("ros.yaml", "640", "99999999999", "line 1 (image_width)", "whole number");
  expect_error("ros.yaml", "640", "3", "", "image size 3x480");
  expect_error("ros.yaml", "801.25", ".nan", "line 7 (camera_matrix.data)", "number 5 of the list");
  expect_error("ros.yaml", "801.25", "1e999", "line 7 (camera_matrix.data)", "finite");
  expect_error("ros.yaml", "801.25", "-801.25", "", "focal length");
  expect_error("ros.yaml", "320.125", "32012.5", "", "principal point");
  expect_error("ros.yaml", "[800.5, 0,", "[800.5, 4,", "line 7 (camera_matrix.data)", "skew");
  expect_error("ros.yaml", "0, 0, 1]", "0, 0, 2]", "line 7 (camera_matrix.data)", "the form");
}

TEST_F(CameraFile, RejectsWrongCounts) {
  expect_error("ros.yaml", "rows: 3", "rows: 4", "line 7 (camera_matrix.data)",
               "9 numbers do not make a matrix of 4 rows and 3 columns");
  expect_error("ros.yaml", "801.25, ", "", "line 7 (camera_matrix.data)", "8 numbers");
  expect_error("ros.yaml", "rows: 3\n  cols: 3", "rows: 1\n  cols: 9", "line 4 (camera_matrix)",
               "3 rows and 3 columns");
  expect_error("ros.yaml", "rows: 3", "rows: -3", "line 7 (camera_matrix.data)", "-3 rows");
}

TEST_F(CameraFile, RejectsLensesItCannotModel) {
  expect_error("ros.yaml", "plumb_bob", "equidistant", "line 8 (distortion_model)",
               "'equidistant'");
  expect_error("ros.yaml", "camera_name", "camera_model: fisheye\ncamera_name",
               "line 3 (camera_model)", "'fisheye'");
  expect_error("opencv.yml", "flags: 128", "fisheye_model: 1", "line 8 (fisheye_model)", "fisheye");
  expect_error(replaced(replaced(content_of(golden("ros.yaml")), "cols: 5", "cols: 8"),
                        "-0.002, 0]", "-0.002, 0, 0, 0.5, 0]"),
               "line 12 (distortion_coefficients.data)", "beyond k1 k2 p1 p2 k3");
  expect_error(
      replaced(replaced(content_of(golden("ros.yaml")), "cols: 5", "cols: 3"), "-0.002, 0]", "]"),
      "line 12 (distortion_coefficients.data)", "there are 3 distortion coefficients");
}

TEST_F(CameraFile, RejectsWhatIsNoYaml) {
  expect_error("ros.yaml", "image_width: 640", "image_width: 640\nhello", "line 2", "'key: value'");
  expect_error("ros.yaml", "image_height: 480", "image_width: 480", "line 2", "given twice");
  expect_error("ros.yaml", "[800.5", "]800.5", "line 7 (camera_matrix.data)", "finite number");
  expect_error("%YAML:1.0\n---\n" + std::string(1 << 20, '-'), "line 3", "'key: value'");
  expect_error("image_width: " + std::string(1 << 20, '['), "line 1", "not closed");
}

TEST_F(CameraFile, RejectsMalformedIvtText) {
  const std::string mono = content_of(golden("ivt_mono.txt"));
  expect_error(mono.substr(0, mono.size() / 2), "line 4", "the file ends where number");
  expect_error("ivt_mono.txt", "800.5000000000", "eight", "line 3", "'eight'");
  expect_error("ivt_mono.txt", "800.5000000000", "nan", "line 3", "'nan'");
  expect_error("ivt_mono.txt", "640.0", "640.5", "camera 1", "whole numbers of pixels");
  expect_error("0" + mono.substr(1), "line 1", "should be 1 to 64");
  expect_error("1000000000" + mono.substr(1), "line 1", "should be 1 to 64");
  expect_error("2" + mono.substr(1), "line 6", "number 1 of 27 of camera 2");
  expect_error(mono + "17", "line 6", "after the end");
  expect_error(content_of(golden("ivt_stereo.txt")) + "17", "line 12", "after the end");
}

TEST_F(CameraFile, IsIndependentOfTheLocale) {
  const test::CommaLocale comma;
  const auto path = folder_.path() / "written.yml";
  save_camera(load_camera(golden("opencv.yml")), path);
  expect_is_golden_camera(load_camera(path));
}

}  // namespace
}  // namespace anneal6d
