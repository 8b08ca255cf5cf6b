// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <memory>
#include <string>

#include "anneal6d/capture/sequence_writer.h"
#include "anneal6d/capture/simulation_source.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"
#include "command.h"
#include "interrupt.h"
#include "options.h"
#include "plugins.h"
#include "progress.h"
#include "tracking_job.h"

namespace anneal6d {

namespace {

struct SimulateOptions {
  std::string out;
  std::string model;
  std::string model_unit = "mm";
  std::string camera;
  int jpeg_quality = 0;
  bool force = false;
  Settings settings;
};

int simulate(const SimulateOptions& options) {
  if (options.model.empty()) throw ConfigError("--model is needed: the object to simulate");
  catch_interrupt();
  const SimulationOptions simulation = SimulationOptions::from(options.settings);
  const CameraModel camera =
      options.camera.empty() ? default_simulation_camera() : load_camera(options.camera);
  const auto mesh = load_model(options.model, options.model_unit);
  SimulationSource source(mesh, camera, simulation, textured_renderers());

  SequenceWriterOptions writer;
  writer.settings = options.settings;
  writer.settings.set("seed", std::to_string(simulation.seed));
  writer.jpeg_quality = options.jpeg_quality;
  writer.force = options.force;
  Progress progress("simulating", simulation.frames);
  writer.progress = [&](std::int64_t) {
    if (interrupted()) throw Error("interrupted; nothing was written");
    progress.advance();
  };
  const std::int64_t frames = write_sequence(source, *mesh, options.out, writer);
  log(LogLevel::info, options.out + ": " + std::to_string(frames) + " frames with ground truth");
  return 0;
}

}  // namespace

Command add_simulate_command(CLI::App& tool) {
  CLI::App* app = tool.add_subcommand(
      "simulate", "Renders a sequence folder of a moving object, with ground truth");
  auto options = std::make_shared<SimulateOptions>();
  app->add_option("OUT", options->out, "The folder to write")->required()->configurable(false);
  app->add_option("--model", options->model, "The object")->type_name("FILE");
  app->add_option("--model-unit", options->model_unit, "Unit of the model's lengths, default mm")
      ->type_name("mm|cm|m");
  app->add_option("--camera", options->camera, "Calibration; default: 640x480, focal length 650")
      ->type_name("FILE");
  app->add_option("--jpeg-quality", options->jpeg_quality,
                  "Write JPEG of this quality, 1 to 100; default: PNG")
      ->type_name("N")
      ->check(CLI::Range(1, 100));
  app->add_flag("--force", options->force, "Replace a sequence that is there already");
  const auto add = [&](const char* name, const char* type, const char* help) {
    add_setting(*app, options->settings, name, type, help);
  };
  add("frames", "N", "How many, default 100");
  add("seed", "N", "Seed of all random numbers, default 1");
  add("init", "\"tx ty tz qw qx qy qz\"", "First pose, camera_from_object; default: in full view");
  add("sigma-mm", "MM", "Standard deviation of a frame's step along each axis, default 5");
  add("sigma-deg", "DEGREES", "The same of the rotation, default 2");
  add_simulation_options(*app, options->settings);
  return {app, [options] { return simulate(*options); }};
}

}  // namespace anneal6d
