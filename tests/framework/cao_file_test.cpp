// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>

#include "anneal6d/framework/mesh_file.h"
#include "file_test_support.h"

namespace anneal6d {
namespace {

using test::expect_file_error;
using test::TemporaryFolder;

double area_mm2(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles()) {
    const Eigen::Vector3f& a = mesh.vertices()[t[0]].position_mm;
    sum +=
        0.5 *
        (mesh.vertices()[t[1]].position_mm - a).cross(mesh.vertices()[t[2]].position_mm - a).norm();
  }
  return sum;
}

class CaoFile : public testing::Test {
 protected:
  TriangleMesh load(const std::string& content) {
    return load_mesh(folder_.write("model.cao", content));
  }
  void expect_error(const std::string& content, const std::string& place,
                    const std::string& words) {
    const auto path = folder_.write("model.cao", content);
    expect_file_error([&] { load_mesh(path); }, path, place, words);
  }
  TemporaryFolder folder_;
};

// Points of a square of 10 mm, lines and faces to be filled in.
const std::string kSquare = "V1\n4\n0 0 0\n10 0 0\n10 10 0\n0 10 0\n";

TEST_F(CaoFile, CutsConcaveFacesIntoTheirArea) {
  // An L of 30 x 30 less 20 x 20, in the plane x = z.
  const std::string content =
      "V1\n6\n0 0 0\n30 0 30\n30 10 30\n10 10 10\n10 30 10\n0 30 0\n0\n0\n1\n6 0 1 2 3 4 5\n";
  const TriangleMesh mesh = load(content);
  EXPECT_EQ(mesh.triangles().size(), 4U);
  EXPECT_NEAR(area_mm2(mesh), 500 * std::sqrt(2.0), 0.01);
}

TEST_F(CaoFile, CutsNoEarThatHoldsAnotherCorner) {
  // The fourth corner lies within the triangle of the first three.
  const TriangleMesh mesh = load("V1\n4\n0 0 0\n30 0 0\n30 30 0\n20 5 0\n0\n0\n1\n4 0 1 2 3\n");
  EXPECT_NEAR(area_mm2(mesh), 225, 1e-3);
}

TEST_F(CaoFile, CutsFacesWithCornersThatBendNowhere) {
  const std::string content =
      "V1\n7\n0 0 0\n10 0 0\n20 0 0\n20 20 0\n10 20 0\n0 20 0\n0 20 0\n0\n0\n1\n7 0 1 2 3 4 5 6\n";
  EXPECT_NEAR(area_mm2(load(content)), 400, 1e-3);
}

TEST_F(CaoFile, MakesTubesOfCylindersAndDiscsOfCircles) {
  const std::string points = "V1\n4\n0 0 -10\n0 0 10\n1 0 10\n0 1 10\n0\n0\n0\n";
  const TriangleMesh tube = load(points + "1\n0 1 5 name=body\n0\n");
  EXPECT_NEAR(area_mm2(tube), 2 * M_PI * 5 * 20, 3);
  EXPECT_NEAR(tube.max_corner_mm().z(), 10, 1e-4);
  const TriangleMesh disc = load(points + "0\n1\n5 1 2 3\n");
  EXPECT_NEAR(area_mm2(disc), M_PI * 25, 0.5);
  EXPECT_NEAR(disc.min_corner_mm().z(), 10, 1e-4);
}

TEST_F(CaoFile, IgnoresLinesThatBoundNoFace) {
  EXPECT_EQ(load(kSquare + "1\n0 2\n0\n1\n4 0 1 2 3\n0\n0\n").triangles().size(), 2U);
}

TEST_F(CaoFile, ReadsCommentsOptionsAndOldLineEnds) {
  const std::string content =
      "# a square\rV1 # version\r4\r0 0 0 # first\r10 0 0\r10 10 0\r0 10 0\r0\r0\r"
      "1\r4 0 1 2 3 name=\"left # door\" useLod=true\r";
  EXPECT_EQ(load(content).triangles().size(), 2U);
}

TEST_F(CaoFile, ReadsTheModelsThatVispComesWith) {
  const std::filesystem::path folder = "/usr/share/visp-images-data/ViSP-images";
  if (!std::filesystem::exists(folder)) {
    GTEST_SKIP() << "the Debian package visp-images-data is not installed";
  }
  const TriangleMesh cube = load_mesh(folder / "mbt/cube.cao", LengthUnit::metre);
  EXPECT_EQ(cube.triangles().size(), 12U);
  EXPECT_NEAR(cube.diameter_mm(), 84 * std::sqrt(3.0), 1e-3);
  EXPECT_EQ(load_mesh(folder / "mbt/cube_and_cylinder.cao", LengthUnit::metre).triangles().size(),
            12U + 96U);
  const TriangleMesh castle =
      load_mesh(folder / "mbt-depth/Castle-simu/Models/chateau.cao", LengthUnit::metre);
  EXPECT_EQ(castle.triangles().size(), 4U + 4U * 2U);
  for (const char* name : {"linux", "windows"}) {
    const auto path =
        folder / ("mbt-cao/cylinder_cao_model_" + std::string(name) + "_line_ending.cao");
    EXPECT_EQ(load_mesh(path, LengthUnit::metre).triangles().size(), 96U + 48U);
  }
}

TEST_F(CaoFile, RejectsOtherVersionsAndEmptyFiles) {
  expect_error("", "line 1", "should be V1");
  expect_error("# nothing\n", "line 2", "should be V1");
  expect_error("V2\n1\n", "line 1", "'V2' should be V1");
  expect_error("V1\n0\n0\n0\n0\n0\n0\n", "", "holds no triangle");
}

TEST_F(CaoFile, RejectsATruncatedFile) {
  expect_error("V1\n4\n0 0 0\n10 0", "line 4", "a coordinate of a point");
  expect_error(kSquare + "0\n0\n1\n4 0 1 2", "line 10", "the number of a point");
  expect_error(kSquare, "line 7", "the number of lines");
}

TEST_F(CaoFile, RejectsAbsurdCounts) {
  expect_error("V1\n99999999999999999999\n", "line 2", "the number of points");
  expect_error("V1\n-4\n", "line 2", "the number of points");
  expect_error("V1\n4000000000\n0 0 0\n", "line 4", "the file ends");
  expect_error(kSquare + "0\n0\n0\n4000000000\n", "line 10", "absurd");
  expect_error(kSquare + "0\n0\n0\n0\n4000000000\n", "line 11", "absurd");
  expect_error(kSquare + "0\n0\n1\n2 0 1\n", "line 10", "2 points; 3 to 512");
  expect_error(kSquare + "0\n0\n1\n4000000000 0 1\n", "line 10", "3 to 512");
}

TEST_F(CaoFile, RejectsNumbersThatAreNotFinite) {
  expect_error("V1\n1\n0 nan 0\n", "line 3", "'nan'");
  expect_error("V1\n1\n0 1e999 0\n", "line 3", "'1e999'");
  // Finite, but not as a float.
  expect_error("V1\n3\n0 0 0\n1e300 0 0\n0 1e300 0\n0\n0\n1\n3 0 1 2\n", "line 9", "no area");
}

TEST_F(CaoFile, RejectsReferencesToNothing) {
  expect_error(kSquare + "1\n0 4\n", "line 8", "there is no point 4; there are 4");
  expect_error(kSquare + "0\n0\n1\n4 0 1 2 7\n", "line 10", "there is no point 7");
  expect_error(kSquare + "1\n0 1\n1\n3 0 0 1\n", "line 10", "there is no line 1");
}

TEST_F(CaoFile, RejectsFacesWithoutASurface) {
  expect_error(kSquare + "0\n0\n1\n3 0 1 1\n", "line 10", "no area");
  expect_error(kSquare + "0\n0\n1\n4 0 2 1 3\n", "line 10", "crosses itself");
  expect_error(kSquare + "3\n0 1\n2 3\n3 0\n1\n3 0 1 2\n", "line 12", "outline");
}

TEST_F(CaoFile, RejectsRoundPartsWithoutASurface) {
  expect_error(kSquare + "0\n0\n0\n1\n0 1 -5\n", "line 11", "radius");
  expect_error(kSquare + "0\n0\n0\n1\n0 0 5\n", "line 11", "no length");
  expect_error(kSquare + "0\n0\n0\n0\n1\n5 0 1 1\n", "line 12", "on a line");
}

TEST_F(CaoFile, RejectsTextAfterItsEnd) {
  expect_error(kSquare + "0\n0\n1\n4 0 1 2 3\n0\n0\n5\n", "line 13", "after the end");
}

TEST_F(CaoFile, RejectsPartsThatAreMissingMovedOrLoadThemselves) {
  const auto part = folder_.path() / "part.cao";
  const auto model = folder_.write("model.cao", "V1\nload(\"part.cao\")\n0\n0\n0\n0\n");
  expect_file_error([&] { load_mesh(model); }, part, "", "does not exist");
  folder_.write("part.cao", "V1\nload(\"part.cao\")\nload(\"part.cao\")\n0\n0\n0\n0\n");
  expect_file_error([&] { load_mesh(model); }, part, "", "load itself");
  expect_error("V1\nload(\"part.cao\", t=[0; 0; 1])\n", "line 2", "not supported");
  expect_error("V1\nload(part.cao)\n", "line 2", "should have the form");
  expect_error("V1\nload(\"part.cao\n", "line 2", "should have the form");
}

}  // namespace
}  // namespace anneal6d
