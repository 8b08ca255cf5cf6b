// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "tool_runner.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace anneal6d {

namespace fs = std::filesystem;

namespace {

std::string take_file(const fs::path& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  fs::remove(path);
  return content.str();
}

int exit_status_of(int system_result) {
#ifdef _WIN32
  return system_result;
#else
  return WIFEXITED(system_result) ? WEXITSTATUS(system_result) : -1;
#endif
}

}  // namespace

std::string quoted(const std::string& text) { return '"' + text + '"'; }

ProgramRun run_program(const std::string& command_line, const fs::path& scratch) {
  const fs::path out = scratch / ".out", err = scratch / ".err";
  const std::string line = "cd " + quoted(scratch.string()) + " && " + command_line + " >" +
                           quoted(out.string()) + " 2>" + quoted(err.string());
  ProgramRun run;
  run.status = exit_status_of(std::system(line.c_str()));
  run.out = take_file(out);
  run.err = take_file(err);
  return run;
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

ToolTest::ToolTest() {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  scratch_ = fs::path(::testing::TempDir()) /
             (std::string("anneal6d ") + info->test_suite_name() + " " + info->name());
  fs::remove_all(scratch_);
  fs::create_directories(scratch_);
}

ToolTest::~ToolTest() {
  std::error_code ignored;
  fs::remove_all(scratch_, ignored);
}

ProgramRun ToolTest::tool(const std::string& arguments) const {
  return run_program(quoted(ANNEAL6D_TOOL) + " " + arguments, scratch_);
}

void ToolTest::expect_refused(const std::string& arguments, int status,
                              const std::vector<std::string>& words) const {
  const ProgramRun run = tool(arguments);
  EXPECT_EQ(run.status, status) << arguments << "\n" << run.err;
  EXPECT_EQ(run.out, "") << arguments;
  for (const std::string& word : words) {
    EXPECT_NE(run.err.find(word), std::string::npos)
        << "'" << word << "' is missing in the message of\n"
        << arguments << "\n"
        << run.err;
  }
}

std::string ToolTest::why_no_opengl() const {
  const std::string list = tool("list").out;
  const std::size_t reference = list.find("reference");
  const std::size_t reason = list.find("not available", reference);
  if (reference == std::string::npos || reason == std::string::npos ||
      reason > list.find("frame sources")) {
    return "";
  }
  return "no OpenGL here: " + list.substr(reason);
}

fs::path ToolTest::copy_of_sequence() const {
  const fs::path copy = scratch_ / "sequence";
  fs::copy(sequence_, copy, fs::copy_options::recursive);
  return copy;
}

void ToolTest::write(const fs::path& path, const std::string& content) const {
  std::ofstream(scratch_ / path, std::ios::binary) << content;
}

::testing::AssertionResult ToolTest::only_has(const std::vector<std::string>& names) const {
  std::set<std::string> found;
  for (const auto& entry : fs::directory_iterator(scratch_)) {
    found.insert(entry.path().filename().string());
  }
  if (found == std::set<std::string>(names.begin(), names.end())) {
    return ::testing::AssertionSuccess();
  }
  auto failure = ::testing::AssertionFailure() << "the folder holds";
  for (const std::string& name : found) failure << " '" << name << "'";
  return failure;
}

}  // namespace anneal6d
