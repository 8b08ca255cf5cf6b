// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"
#include "command.h"
#include "evaluation_run.h"
#include "html_report.h"
#include "interrupt.h"
#include "options.h"
#include "staged_folder.h"

namespace anneal6d {

namespace {

struct EvaluateOptions {
  std::vector<std::string> sequences;
  EvaluationOptions evaluation;
  std::string protocol = "free";
  std::string out;
};

constexpr const char* kSummaryFile = "summary.json";

/// Text that is not UTF-8 (a file's name) is replaced rather than refused.
std::string as_text(const nlohmann::ordered_json& json, int indent = -1) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// "data/cup/" is "cup".
std::string name_of(const std::string& sequence) {
  std::filesystem::path path = std::filesystem::absolute(sequence).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  return path.filename().string();
}

std::vector<std::string> names_of(const EvaluateOptions& options) {
  std::vector<std::string> names;
  std::transform(options.sequences.begin(), options.sequences.end(), std::back_inserter(names),
                 name_of);
  if (std::set<std::string>(names.begin(), names.end()).size() != names.size()) {
    throw ConfigError("two sequences have the same folder name; results go by it: rename one");
  }
  const bool several = options.sequences.size() > 1;
  if (several && !options.evaluation.reference.empty()) {
    throw ConfigError("--reference belongs to one sequence; give one");
  }
  if (several && !options.evaluation.tracking.init.empty()) {
    throw ConfigError("--init belongs to one sequence; give one");
  }
  if (several && options.evaluation.outputs.any()) {
    throw ConfigError(
        "--poses, --overlay and --edge-pictures belong to one sequence; give one, or --out");
  }
  return names;
}

nlohmann::ordered_json options_json(const EvaluationOptions& options) {
  const TrackingOptions& tracking = options.tracking;
  nlohmann::ordered_json json = {{"tracker", tracking.tracker},
                                 {"protocol", to_string(options.protocol)},
                                 {"stride", tracking.stride},
                                 {"start", tracking.start},
                                 {"jobs", options.jobs}};
  if (tracking.frames) json["frames"] = *tracking.frames;
  for (const auto& [name, text] : {std::pair{"model", &tracking.model},
                                   {"camera", &tracking.camera},
                                   {"init", &tracking.init},
                                   {"plugin", &tracking.plugin},
                                   {"reference", &options.reference}}) {
    if (!text->empty()) json[name] = *text;
  }
  if (tracking.model_unit != "mm") json["model-unit"] = tracking.model_unit;
  for (const auto& [name, value] : tracking.settings) {
    if (name != "seed") json[name] = value;
  }
  return json;
}

nlohmann::ordered_json summary_json(const std::vector<SequenceEvaluation>& evaluations,
                                    const EvaluationOptions& options) {
  nlohmann::ordered_json sequences = nlohmann::ordered_json::array();
  std::vector<Summary> summaries;
  for (const SequenceEvaluation& evaluation : evaluations) {
    nlohmann::ordered_json entry = to_json(evaluation.summary);
    entry["seed"] = options.tracking.settings.text("seed").value_or("");
    entry["options"] = options_json(options);
    sequences.push_back(std::move(entry));
    summaries.push_back(evaluation.summary);
  }
  return {{"sequences", std::move(sequences)}, {"mean", to_json(mean_of(summaries))}};
}

/// The options as summary.json has them, and the seed, for people.
std::map<std::string, std::string> options_text(const EvaluationOptions& options) {
  std::map<std::string, std::string> text;
  text["seed"] = options.tracking.settings.text("seed").value_or("");
  const nlohmann::ordered_json json = options_json(options);
  for (const auto& [name, value] : json.items()) {
    text[name] = value.is_string() ? value.get<std::string>() : as_text(value);
  }
  return text;
}

void write_results(const std::vector<SequenceEvaluation>& evaluations,
                   const EvaluationOptions& options, StagedFolder& folder) {
  for (const SequenceEvaluation& evaluation : evaluations) {
    const std::filesystem::path place = folder.path() / evaluation.summary.name;
    std::filesystem::create_directories(place);
    PoseWriter poses(place / "poses.csv");
    for (const PoseRow& row : evaluation.rows) poses.write(row);
    poses.commit();
  }
  write_file_atomically(folder.path() / "report.html",
                        html_report(evaluations, options_text(options)));
  write_file_atomically(folder.path() / kSummaryFile,
                        as_text(summary_json(evaluations, options), 2) + "\n");
  folder.commit(kSummaryFile);
}

int evaluate(EvaluateOptions options) {
  options.evaluation.protocol = parse_protocol(options.protocol);
  const std::vector<std::string> names = names_of(options);
  catch_interrupt();
  std::optional<StagedFolder> folder;  // made first: an unwritable one is found out before the work
  if (!options.out.empty()) folder.emplace(options.out);
  options.evaluation.pictures = folder.has_value();
  const std::vector<SequenceEvaluation> evaluations =
      evaluate_sequences(options.sequences, names, options.evaluation);
  if (folder) {
    write_results(evaluations, options.evaluation, *folder);
    log(LogLevel::info, "results are in " + options.out);
  }
  std::vector<Summary> summaries;
  for (const SequenceEvaluation& evaluation : evaluations) {
    summaries.push_back(evaluation.summary);
  }
  std::fputs(to_table(summaries).c_str(), stdout);
  return 0;
}

}  // namespace

Command add_evaluate_command(CLI::App& tool) {
  CLI::App* app =
      tool.add_subcommand("evaluate", "Tracks sequences and compares with their ground truth");
  auto options = std::make_shared<EvaluateOptions>();
  app->add_option("SEQUENCE", options->sequences, "Sequence folders")->required();
  add_tracking_options(*app, options->evaluation.tracking);
  add_output_options(*app, options->evaluation.outputs);
  app->add_option("--protocol", options->protocol,
                  "free: never reset; rbot: reset to the ground truth after a frame that is 50 mm "
                  "or 5 degrees off; default free")
      ->type_name("free|rbot");
  app->add_option("--reference", options->evaluation.reference,
                  "Poses to judge against instead of groundtruth.csv")
      ->type_name("FILE");
  app->add_option("--jobs", options->evaluation.jobs,
                  "Sequences tracked at the same time, default 1; more make the times longer")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  app->add_option(
         "--out", options->out,
         "Folder for summary.json, report.html and, for each sequence, poses.csv; default: none")
      ->type_name("DIR");
  app->footer(
      "The pose of the first frame is given, so that frame is not judged; neither are frames "
      "without "
      "ground truth.\nThe mean of several sequences counts each of them alike.");
  return {app, [options] { return evaluate(*options); }};
}

}  // namespace anneal6d
