// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <map>
#include <set>

#include "anneal6d/framework/number.h"
#include "tool_runner.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

class Bench : public ToolTest {
 protected:
  /// A line of `--out`, by column.
  using Row = std::map<std::string, std::string>;

  std::vector<Row> rows_of(const std::string& file) const {
    const std::vector<std::string> lines = lines_of(scratch_ / file);
    const std::vector<std::string> names = cells_of(lines.at(0));
    std::vector<Row> rows;
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const std::vector<std::string> cells = cells_of(lines[i]);
      EXPECT_EQ(cells.size(), names.size()) << lines[i];
      Row row;
      for (std::size_t k = 0; k < names.size(); ++k) row[names[k]] = cells.at(k);
      rows.push_back(row);
    }
    return rows;
  }

  static bool has_no_opengl(const ProgramRun& run) {
    return run.out.find("OpenGL: none") != std::string::npos;
  }

  std::string small_ = "bench --particles 20 --layers 1,2 --frames 1 --out times.csv ";
};

TEST_F(Bench, MeasuresEveryScorerWithEverySetting) {
  const ProgramRun run = tool(small_ + "--edges sobel,canny --scorer sparse,reference");
  ASSERT_EQ(run.status, 0) << run.err;
  if (has_no_opengl(run)) GTEST_SKIP() << "no OpenGL here, which draws the frames";
  for (const char* title : {"Poses a second", "track() in the thesis's mode", "Stages", "Steps",
                            "Drawing", "to reference", "1.0x"}) {
    EXPECT_NE(run.out.find(title), std::string::npos) << title << "\n" << run.out;
  }
  std::set<std::string> frames;
  for (Row& row : rows_of("times.csv")) {
    const auto milliseconds = parse_number(row["milliseconds"]);
    ASSERT_TRUE(milliseconds) << row["milliseconds"];
    EXPECT_GE(*milliseconds, 0);
    if (row["table"] != "frame" || row["step"] != "total") continue;
    EXPECT_GT(*milliseconds, 0);
    frames.insert(row["mode"] + " " + row["scorer"] + " " + row["edges"] + " " + row["particles"] +
                  " " + row["layers"]);
  }
  std::set<std::string> expected = {"default sparse sobel 0 0"};
  for (const char* scorer : {"sparse ", "reference "}) {
    for (const char* setting : {"sobel 20 1", "sobel 20 2", "canny 20 1", "canny 20 2"}) {
      expected.insert("thesis " + std::string(scorer) + setting);
    }
  }
  EXPECT_EQ(frames, expected);
  EXPECT_TRUE(only_has({"times.csv"}));
}

TEST_F(Bench, StagesAddUpToTheWholeFrame) {
  const ProgramRun run = tool(small_ + "--edges sobel --scorer cpu");
  ASSERT_EQ(run.status, 0) << run.err;
  if (has_no_opengl(run)) GTEST_SKIP() << "no OpenGL here, which draws the frames";
  std::map<std::string, double> stages, totals;
  for (Row& row : rows_of("times.csv")) {
    if (row["table"] != "frame") continue;
    const std::string frame = row["mode"] + row["layers"] + "/" + row["repetition"];
    (row["step"] == "total" ? totals : stages)[frame] += *parse_number(row["milliseconds"]);
  }
  ASSERT_FALSE(totals.empty());
  for (const auto& [frame, total_ms] : totals) EXPECT_NEAR(stages[frame], total_ms, 0.01) << frame;
}

TEST_F(Bench, TellsWhatItCannotMeasureWithoutOpenGl) {
#ifdef _WIN32
  GTEST_SKIP() << "OpenGL's drivers are hidden by a variable of Linux's EGL loader";
#else
  const ProgramRun run =
      run_program("__EGL_VENDOR_LIBRARY_DIRS=/nonexistent " + quoted(ANNEAL6D_TOOL) + " " + small_ +
                      "--scorer reference,cpu",
                  scratch_);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("reference: not available: "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("not measured, since OpenGL draws them"), std::string::npos) << run.out;
  const std::vector<Row> rows = rows_of("times.csv");
  ASSERT_FALSE(rows.empty());
  for (Row row : rows) EXPECT_EQ(row["table"] + row["scorer"], "scorercpu");
#endif
}

TEST_F(Bench, RefusesWhatItDoesNotKnow) {
  expect_refused("bench --scorer best", 2, {"--scorer", "best"});
  expect_refused("bench --scorer cpu,cpu", 2, {"--scorer", "twice"});
  expect_refused("bench --edges laplace", 2, {"laplace"});
  expect_refused("bench --particles 0", 2, {"--particles"});
  expect_refused("bench --layers 1,none", 2, {"--layers"});
  expect_refused("bench --frames 0", 2, {"--frames"});
  expect_refused("bench --out nowhere/times.csv", 1, {"times.csv", "nowhere"});
  EXPECT_TRUE(only_has({}));
}

}  // namespace
}  // namespace anneal6d
