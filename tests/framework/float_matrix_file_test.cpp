// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/float_matrix_file.h"

#include <gtest/gtest.h>

#include <limits>

#include "file_test_support.h"

namespace anneal6d {
namespace {

using test::content_of;
using test::expect_file_error;
using test::golden;
using test::TemporaryFolder;

// Two columns, three rows: 1 2 3 4 5 6 as little-endian floats.
std::string small_matrix() {
  return "MATRIX 0000000002 0000000003 " +
         std::string("\0\0\x80\x3F\0\0\0\x40\0\0\x40\x40\0\0\x80\x40\0\0\xA0\x40\0\0\xC0\x40", 24);
}

class FloatMatrixFile : public testing::Test {
 protected:
  void expect_error(const std::string& content, const std::string& place,
                    const std::string& words) {
    const auto path = folder_.write("matrix.dat", content);
    expect_file_error([&] { load_float_matrix(path); }, path, place, words);
  }
  TemporaryFolder folder_;
};

TEST_F(FloatMatrixFile, ReadsLittleEndianNumbersRowByRow) {
  const FloatMatrix matrix = load_float_matrix(folder_.write("m.dat", small_matrix()));
  FloatMatrix expected(3, 2);
  expected << 1, 2, 3, 4, 5, 6;
  EXPECT_EQ(matrix, expected);
}

TEST_F(FloatMatrixFile, ReadsTheGoldenModel) {
  const FloatMatrix matrix = load_float_matrix(golden("box18.dat"));
  ASSERT_EQ(matrix.rows(), 12);
  ASSERT_EQ(matrix.cols(), 18);
  EXPECT_EQ(matrix(0, 0), -1);
  EXPECT_EQ(matrix(0, 4), -30);
}

TEST_F(FloatMatrixFile, WritesWhatItReads) {
  const auto copy = folder_.path() / "copy.dat";
  save_float_matrix(load_float_matrix(golden("box6.dat")), copy);
  EXPECT_EQ(content_of(copy), content_of(golden("box6.dat")));
}

TEST_F(FloatMatrixFile, RejectsAMissingFileAndAFolder) {
  const auto missing = folder_.path() / "missing.dat";
  expect_file_error([&] { load_float_matrix(missing); }, missing, "", "does not exist");
  expect_file_error([&] { load_float_matrix(folder_.path()); }, folder_.path(), "", "is a folder");
}

TEST_F(FloatMatrixFile, RejectsAnEmptyFileAndAnotherMagic) {
  expect_error("", "byte 0", "should begin with 'MATRIX '");
  expect_error("matrix 0000000002 0000000003 ", "byte 0", "should begin with 'MATRIX '");
}

TEST_F(FloatMatrixFile, RejectsATruncatedHeader) {
  expect_error(small_matrix().substr(0, 28), "byte 28", "ends inside its header");
}

TEST_F(FloatMatrixFile, RejectsTruncatedPayload) {
  expect_error(small_matrix().substr(0, 52), "byte 52", "too short for 2 columns and 3 rows");
}

TEST_F(FloatMatrixFile, RejectsTrailingBytes) {
  expect_error(small_matrix() + "!", "byte 53", "1 bytes too many");
}

TEST_F(FloatMatrixFile, RejectsCountsThatAreNoNumbers) {
  expect_error("MATRIX 00000000x2 0000000003 " + std::string(24, '\0'), "byte 7",
               "the number of columns");
  expect_error("MATRIX 0000000002         -3 " + std::string(24, '\0'), "byte 18",
               "the number of rows");
  expect_error("MATRIX 0000000002,0000000003 " + std::string(24, '\0'), "byte 17", "a space");
}

TEST_F(FloatMatrixFile, RejectsAbsurdCountsWithoutAllocating) {
  expect_error("MATRIX 9999999999 9999999999 " + std::string(24, '\0'), "byte 53", "too short");
  expect_error("MATRIX 4294967296 4294967296 ", "byte 29", "too short");
}

TEST_F(FloatMatrixFile, RejectsAMatrixWithoutElements) {
  expect_error("MATRIX 0000000000 0000000003 ", "byte 7", "no columns");
  expect_error("MATRIX 0000000002 0000000000 ", "byte 18", "no rows");
}

TEST_F(FloatMatrixFile, RejectsNumbersThatAreNotFinite) {
  std::string content = small_matrix();
  content.replace(29 + 4 * 3, 4, std::string("\0\0\xC0\x7F", 4));
  expect_error(content, "byte 41", "row 1, column 1 is not finite");
}

TEST_F(FloatMatrixFile, SaysWhereItCannotWrite) {
  const auto path = folder_.path() / "no such folder" / "m.dat";
  expect_file_error([&] { save_float_matrix(FloatMatrix::Zero(1, 1), path); }, path, "",
                    "cannot be written");
}

}  // namespace
}  // namespace anneal6d
