// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <spdlog/fmt/fmt.h>

#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "anneal6d/capture/dc1394.h"
#include "anneal6d/capture/sequence_writer.h"
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

struct RecordOptions {
  std::string input;
  std::string out;
  std::string model;
  std::string model_unit = "mm";
  std::string camera;
  std::optional<std::int64_t> frames;
  int jpeg_quality = 0;
  bool force = false;
  Settings device;
};

/// The cameras of "dc1394:GUID,GUID"; empty for any other input.
std::vector<std::string> group_of(const std::string& input) {
  std::vector<std::string> guids;
  if (!input.starts_with("dc1394:") || input.find(',') == std::string::npos) return guids;
  std::istringstream stream(input_argument(input));
  for (std::string guid; std::getline(stream, guid, ',');) guids.push_back(guid);
  return guids;
}

/// A recording wants every frame, unlike a tracker.
Settings recording_settings(const Settings& given) {
  Settings settings = given;
  if (!settings.has("capture")) settings.set("capture", "every");
  return settings;
}

Recording record_group(const RecordOptions& options, const std::vector<std::string>& guids,
                       const SequenceWriterOptions& writer) {
  if (!options.camera.empty() || !options.model.empty()) {
    throw ConfigError(
        "--camera and --model belong to one camera, not to a group; copy them into "
        "the recorded folders");
  }
  const auto source =
      open_dc1394_group(guids, Dc1394Options::from(recording_settings(options.device)));
  log(LogLevel::info, source->description());
  return record_sequences(*source, options.out, writer);
}

Recording record_one(const RecordOptions& options, const SequenceWriterOptions& writer) {
  FrameSourceSetup setup;
  setup.input = options.input;
  setup.settings = recording_settings(options.device);
  if (!options.camera.empty()) setup.camera = load_camera(options.camera);
  std::shared_ptr<const TriangleMesh> mesh;
  if (!options.model.empty()) mesh = load_model(options.model, options.model_unit);
  const auto source = open_frame_source(all_frame_sources(), setup);
  log(LogLevel::info, source->description());
  return record_sequence(*source, mesh.get(), options.out, writer);
}

int record(const RecordOptions& options) {
  catch_interrupt();
  check_device_options(options.input, options.device);
  SequenceWriterOptions writer;
  writer.settings = options.device;
  writer.jpeg_quality = options.jpeg_quality;
  writer.force = options.force;
  Progress progress("recording", options.frames);
  writer.progress = [&](std::int64_t) { progress.advance(); };
  writer.stop = [&](std::int64_t count) { return interrupted() || count == options.frames; };

  const std::vector<std::string> group = group_of(options.input);
  const Recording recording =
      group.empty() ? record_one(options, writer) : record_group(options, group, writer);
  log(LogLevel::info, fmt::format("{}: {} frames", options.out, recording.frames));
  if (recording.lost > 0) {
    log(LogLevel::warning,
        fmt::format("{} frames were lost in between; try more --buffers, a lower --fps or "
                    "--jpeg-quality 95",
                    recording.lost));
  }
  if (recording.broken > 0) {
    log(LogLevel::warning, fmt::format("{} frames were broken and are left out", recording.broken));
  }
  return 0;
}

}  // namespace

Command add_record_command(CLI::App& tool) {
  CLI::App* app = tool.add_subcommand(
      "record", "Records images of a camera as a sequence folder, until Ctrl-C or --frames");
  auto options = std::make_shared<RecordOptions>();
  app->add_option("INPUT", options->input,
                  "dc1394:GUID, dc1394:, camera:N, or dc1394:GUID,GUID for cameras in step")
      ->required()
      ->configurable(false);
  app->add_option("OUT", options->out, "The folder to write")->required()->configurable(false);
  app->add_option("--frames", options->frames, "Stop after N frames")
      ->type_name("N")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000}));
  app->add_option("--camera", options->camera, "Calibration to put beside the images")
      ->type_name("FILE");
  app->add_option("--model", options->model, "Model to put beside the images")->type_name("FILE");
  app->add_option("--model-unit", options->model_unit, "Unit of the model's lengths, default mm")
      ->type_name("mm|cm|m");
  app->add_option("--jpeg-quality", options->jpeg_quality,
                  "Write JPEG of this quality, 1 to 100; default: PNG")
      ->type_name("N")
      ->check(CLI::Range(1, 100));
  app->add_flag("--force", options->force, "Replace a sequence that is there already");
  add_device_options(*app, options->device);
  return {app, [options] { return record(*options); }};
}

}  // namespace anneal6d
