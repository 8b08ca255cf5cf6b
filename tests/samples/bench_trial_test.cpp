// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "bench_trial.h"

#include <gmock/gmock.h>

#include "anneal6d/capture/simulation_source.h"
#include "bench_scene.h"
#include "bench_tables.h"
#include "bench_trials.h"

namespace anneal6d {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// A trial that writes down that it ran and gives 1, 2, 3, ... milliseconds.
BenchTrial recording(const std::string& name, std::vector<std::string>& record) {
  BenchTrial trial{.subject = {.table = "scorer", .scorer = name}, .steps = {"score"}};
  trial.run = [&record, name, count = 0](std::size_t, std::span<double> step_ms) mutable {
    record.push_back(name);
    step_ms[0] = ++count;
  };
  return trial;
}

/// As if measured: these milliseconds for all steps.
BenchTrial measured(BenchSubject subject, std::vector<std::string> steps,
                    const std::vector<double>& milliseconds) {
  BenchTrial trial{.subject = std::move(subject), .steps = std::move(steps)};
  trial.samples_ms.assign(trial.steps.size(), milliseconds);
  return trial;
}

TEST(BenchTrial, TakesTurnsAndForgetsTheFirstRun) {
  std::vector<std::string> record;
  BenchTrial trials[] = {recording("a", record), recording("b", record)};
  Progress progress("measuring", std::nullopt);
  measure(trials, 2, 0, progress);
  EXPECT_THAT(record, ElementsAre("a", "b", "a", "b", "a", "b"));
  EXPECT_THAT(trials[0].samples_ms, ElementsAre(ElementsAre(2, 3)));
}

TEST(BenchTrial, RepeatsWhatIsQuickUntilItsTurnIsOver) {
  std::vector<std::string> record;
  BenchTrial trials[] = {recording("a", record)};
  Progress progress("measuring", std::nullopt);
  measure(trials, 1, 20, progress);
  EXPECT_GT(trials[0].samples_ms[0].size(), 1U);
  EXPECT_EQ(trials[0].samples_ms[0].size() + 1, record.size());
}

TEST(BenchTrial, HasMedianAndQuantileOfEachStep) {
  BenchTrial trial{.subject = {}, .steps = {"draw", "total"}};
  trial.samples_ms = {{1, 2, 9}, {4, 5, 6}};
  EXPECT_EQ(trial.median_ms("draw"), 2);
  EXPECT_EQ(trial.p95_ms("draw"), 9);
  EXPECT_EQ(trial.median_ms("total"), 5);
}

TEST(BenchTrial, GivesALineOfCsvForEachSample) {
  const BenchTrial trials[] = {measured({.table = "frame",
                                         .scorer = "cpu",
                                         .mode = "thesis",
                                         .edges = "sobel",
                                         .particles = 600,
                                         .layers = 5,
                                         .threads = 2,
                                         .triangles = 12},
                                        {"total"}, {1.5, 2})};
  EXPECT_EQ(to_csv(trials),
            "table,scorer,mode,edges,particles,layers,threads,triangles,step,repetition,"
            "milliseconds\n"
            "frame,cpu,thesis,sobel,600,5,2,12,total,0,1.500000\n"
            "frame,cpu,thesis,sobel,600,5,2,12,total,1,2.000000\n");
}

TEST(BenchTables, CompareWithTheReferenceOfTheSameSettingsOnly) {
  const BenchSubject reference{
      .table = "scorer", .scorer = "reference", .edges = "sobel", .particles = 100, .threads = 1};
  BenchSubject cpu = reference, canny = reference;
  cpu.scorer = canny.scorer = "cpu";
  canny.edges = "canny";
  const BenchTrial trials[] = {measured(reference, {"score"}, {50}), measured(cpu, {"score"}, {5}),
                               measured(canny, {"score"}, {2})};
  const std::string table = scorer_table(trials);
  EXPECT_THAT(table, HasSubstr("       20000       50.00       50.00         10.0x\n"));
  EXPECT_THAT(table, HasSubstr("       50000       20.00       20.00             -\n"));
  EXPECT_THAT(table, Not(HasSubstr("25.0x")));
}

TEST(BenchTables, ShowAFrameOfEveryScorerInOneLine) {
  const std::vector<std::string> steps = {kEdgesStep, kSearchStep, kJudgeStep, kTotalStep};
  BenchSubject subject{.table = "frame", .scorer = "cpu", .mode = "thesis", .edges = "sobel"};
  subject.particles = 100;
  subject.layers = 5;
  const BenchTrial cpu = measured(subject, steps, {3, 4, 8});
  subject.scorer = "reference";
  const BenchTrial trials[] = {cpu, measured(subject, steps, {40})};
  EXPECT_THAT(frame_table(trials),
              HasSubstr("sobel         100       5           4.00 (8.00)    10.0x"
                        "         40.00 (40.00)     1.0x\n"));
  EXPECT_THAT(stage_table(trials), HasSubstr("4.000      8.000         10.0x\n"));
}

TEST(BenchScene, CupHasAsManyTrianglesAsPromised) {
  for (const std::uint32_t d : {1U, 2U, kBenchCupDetail}) {
    EXPECT_EQ(make_bench_cup(d)->triangles().size(), 88 * d * d + 36 * d);
  }
}

TEST(BenchScene, CupIsAboutTwoHundredPixelsWideAndHigh) {
  const auto cup = make_bench_cup(kBenchCupDetail);
  const CameraModel camera = default_simulation_camera();
  for (const Pose& pose : make_bench_poses(*cup, camera, 1, 20)) {
    Eigen::AlignedBox2d seen;
    for (const MeshVertex& vertex : cup->vertices()) {
      seen.extend(camera.project(pose * vertex.position_mm.cast<double>()));
    }
    EXPECT_NEAR(seen.sizes().x(), 200, 60);
    EXPECT_NEAR(seen.sizes().y(), 200, 60);
  }
}

}  // namespace
}  // namespace anneal6d
