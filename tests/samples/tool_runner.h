// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace anneal6d {

/// What a program left behind.
struct ProgramRun {
  int status = -1;  ///< exit status; -1 if it crashed
  std::string out, err;
};

/// Runs a command line of the shell in the folder and captures its output. `scratch` takes the
/// captured files.
ProgramRun run_program(const std::string& command_line, const std::filesystem::path& scratch);

/// Text for the shell that means exactly `text`.
std::string quoted(const std::string& text);

/// The lines of a file, without their ends.
std::vector<std::string> lines_of(const std::filesystem::path& file);

/// The cells of a line of CSV.
std::vector<std::string> cells_of(const std::string& line);

/// Base of the tests that drive the tool: a scratch folder of its own for each test.
class ToolTest : public ::testing::Test {
 protected:
  ToolTest();
  ~ToolTest() override;

  /// Runs `anneal6d ARGUMENTS` with the scratch folder as working folder.
  ProgramRun tool(const std::string& arguments) const;
  /// Expects the exit status and that stderr mentions all of `words`.
  void expect_refused(const std::string& arguments, int status,
                      const std::vector<std::string>& words) const;

  /// Why the tool cannot draw here, as `anneal6d list` says it; empty if it can.
  std::string why_no_opengl() const;

  /// A copy of the short sequence for a test to damage.
  std::filesystem::path copy_of_sequence() const;
  void write(const std::filesystem::path& path, const std::string& content) const;
  /// Whether the scratch folder holds nothing but what is named.
  ::testing::AssertionResult only_has(const std::vector<std::string>& names) const;

  /// 20 simulated frames of 640x480 with ground truth.
  std::filesystem::path sequence_ = std::filesystem::path(ANNEAL6D_TEST_DATA) / "sequence_short";
  std::string sequence_argument_ = quoted(sequence_.string());
  std::filesystem::path scratch_;
  /// Settings with which the tool is fast and still follows.
  std::string fast_ = " --particles 60 --layers 3";
};

}  // namespace anneal6d
