// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/capture/sequence_writer.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"
#include "anneal6d/framework/pose_file.h"
#include "image_file.h"
#include "obj_writer.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

constexpr int kMostFrames = 1'000'000;

// A folder that is filled under another name and takes its own at the end; unless that happens it
// is removed again.
class PendingFolder {
 public:
  explicit PendingFolder(const fs::path& folder)
      : folder_(folder), pending_(beside(folder, "partial")) {
    std::error_code error;
    fs::create_directories(pending_, error);
    if (error) throw FileError(pending_, "", "can't make this folder: " + error.message());
    if (!fs::exists(folder_, error)) return;
    // Found out before the work: a mount point, for one, does not give up its name.
    const fs::path aside = beside(folder_, "old");
    fs::rename(folder_, aside, error);
    if (!error) fs::rename(aside, folder_, error);
    if (error) {
      std::error_code ignored;
      fs::remove_all(pending_, ignored);
      throw FileError(folder_, "",
                      "can't be replaced: " + error.message() + "; name a folder inside it");
    }
  }
  ~PendingFolder() {
    std::error_code ignored;
    if (!pending_.empty()) fs::remove_all(pending_, ignored);
  }
  PendingFolder(const PendingFolder&) = delete;
  PendingFolder& operator=(const PendingFolder&) = delete;

  const fs::path& path() const { return pending_; }

  // Leaves what there is under its other name, which is returned.
  fs::path release() { return std::exchange(pending_, fs::path()); }

  void commit() {
    std::error_code error;
    const fs::path old = beside(folder_, "old");
    const bool replaces = fs::exists(folder_, error);
    if (replaces) fs::rename(folder_, old, error);
    if (error) throw FileError(folder_, "", "can't be replaced: " + error.message());
    fs::rename(pending_, folder_, error);
    if (error) {
      std::error_code ignored;
      if (replaces) fs::rename(old, folder_, ignored);
      throw FileError(folder_, "", "can't be given its name: " + error.message());
    }
    pending_.clear();
    if (replaces) fs::remove_all(old, error);
  }

 private:
  static fs::path beside(const fs::path& folder, const std::string& purpose) {
    const std::string unique = std::to_string(std::random_device{}());
    return folder.parent_path() / ("." + folder.filename().string() + "." + purpose + "-" + unique);
  }

  fs::path folder_, pending_;
};

// Whether `name` is that of a file which write_sequence writes.
bool is_sequence_file(const std::string& name) {
  constexpr std::array<std::string_view, 6> fixed = {"camera.yml", "model.obj",       "model.mtl",
                                                     "model.png",  "groundtruth.csv", "meta.json"};
  if (std::find(fixed.begin(), fixed.end(), name) != fixed.end()) return true;
  const std::size_t dot = name.find('.');
  constexpr std::string_view prefix = "frame_";
  if (name.substr(0, prefix.size()) != prefix || dot == std::string::npos) return false;
  const std::string_view digits = std::string_view(name).substr(prefix.size(), dot - prefix.size());
  const std::string_view extension = std::string_view(name).substr(dot);
  return !digits.empty() && (extension == ".png" || extension == ".jpg") &&
         std::all_of(digits.begin(), digits.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

// "out/" and "." have no name that a temporary folder beside them could be derived from.
fs::path with_name(const fs::path& folder) {
  const fs::path path = resolved(folder);  // a link stays, and what it leads to is written
  if (!path.has_filename()) throw FileError(folder, "", "is no folder to write a sequence to");
  return path;
}

void check_target(const fs::path& folder, bool force) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error)) {
    throw FileError(folder, "", "is a file; name a folder for the sequence");
  }
  if (fs::is_empty(folder, error)) return;
  if (!force) {
    throw FileError(folder, "",
                    "the folder is there already and not empty; name another one, or use --force "
                    "to replace the sequence in it");
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (!entry.is_regular_file(error) || !is_sequence_file(entry.path().filename().string())) {
      throw FileError(entry.path(), "",
                      "does not belong to a sequence, so the folder is not replaced, not even with "
                      "--force; name another folder or clear this one by hand");
    }
  }
  if (error) throw FileError(folder, "", "can't be looked at: " + error.message());
}

std::string frame_name(std::int64_t index, bool jpeg) {
  std::string digits = std::to_string(index);
  if (digits.size() < 4) digits.insert(0, 4 - digits.size(), '0');
  return "frame_" + digits + (jpeg ? ".jpg" : ".png");
}

std::string meta_json(const std::string& name, const std::string& description, std::int64_t frames,
                      const Settings& settings) {
  nlohmann::ordered_json meta;
  meta["name"] = name;
  meta["source"] = description;
  meta["frames"] = frames;
  meta["units"] =
      "millimetres; poses are camera_from_object (x right, y down, z forward), "
      "quaternions w x y z; pixel centres at integer coordinates";
  if (const auto seed = settings.text("seed")) meta["seed"] = *seed;
  meta["options"] = nlohmann::ordered_json::object();
  for (const auto& [key, value] : settings) meta["options"][key] = value;
  // Text that is not UTF-8 (a file's name) is replaced rather than refused.
  return meta.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

// What has been written so far, and the rest of a sequence folder.
class PendingSequence {
 public:
  PendingSequence(const fs::path& folder, const SequenceWriterOptions& options)
      : target_(checked_target(folder, options)), pending_(target_), options_(&options) {}

  std::int64_t count() const { return count_; }
  bool is_full() const { return count_ == kMostFrames; }

  void add(const Frame& frame, const std::optional<Pose>& truth) {
    if (is_full()) throw ConfigError("a sequence holds at most 1000000 frames");
    const fs::path file = pending_.path() / frame_name(count_, options_->jpeg_quality > 0);
    try {
      write_image(file, frame.image, options_->jpeg_quality);
    } catch (const FileError&) {  // the disk is full: what there is of the image must not stay
      std::error_code ignored;
      fs::remove(file, ignored);
      throw;
    }
    if (truth) ground_truth_[count_] = *truth;
    ++count_;
  }

  // Leaves the first `count` frames.
  void truncate(std::int64_t count) {
    for (; count_ > count; --count_) {
      std::error_code ignored;
      fs::remove(pending_.path() / frame_name(count_ - 1, options_->jpeg_quality > 0), ignored);
      ground_truth_.erase(count_ - 1);
    }
  }

  void commit(const std::string& description, const std::optional<CameraModel>& camera,
              const TriangleMesh* mesh) {
    if (count_ == 0) throw ConfigError(description + " gives no frame to write");
    try {
      write_rest(description, camera, mesh);
      check_target(target_, options_->force);  // again: somebody may have written there meanwhile
      pending_.commit();
    } catch (const FileError& error) {
      throw FileError(pending_.release(), "",
                      "the frames are kept here, since the sequence could not be finished: " +
                          std::string(error.what()));
    }
  }

 private:
  void write_rest(const std::string& description, const std::optional<CameraModel>& camera,
                  const TriangleMesh* mesh) const {
    if (camera) save_camera(*camera, pending_.path() / "camera.yml");
    if (mesh != nullptr) write_obj(*mesh, pending_.path() / "model.obj");
    if (!ground_truth_.empty()) save_poses(ground_truth_, pending_.path() / "groundtruth.csv");
    const std::string name = options_->name.empty() ? target_.filename().string() : options_->name;
    write_file_atomically(pending_.path() / "meta.json",
                          meta_json(name, description, count_, options_->settings));
  }

  static fs::path checked_target(const fs::path& folder, const SequenceWriterOptions& options) {
    if (options.jpeg_quality < 0 || options.jpeg_quality > 100) {
      throw ConfigError("jpeg-quality is " + std::to_string(options.jpeg_quality) +
                        ", it must lie within 0 (PNG) and 100");
    }
    const fs::path target = with_name(folder);
    check_target(target, options.force);
    return target;
  }

  fs::path target_;
  PendingFolder pending_;
  const SequenceWriterOptions* options_;
  std::map<std::int64_t, Pose> ground_truth_;
  std::int64_t count_ = 0;
};

// The next frame that can be read; empty at the end.
std::optional<Frame> next_readable(FrameSource& source, Recording& recording) {
  while (true) {
    try {
      return source.next();
    } catch (const FileError& error) {
      ++recording.broken;
      log(LogLevel::warning, std::string(error.what()) + "; the frame is left out");
    }
  }
}

// Has `step` write frames until it says that there are no more, then keeps them: also if the
// camera or the disk fails, whose error is thrown after that.
template <class Step, class Keep>
void record_until_done(const SequenceWriterOptions& options, const Step& step, const Keep& keep) {
  std::string failure;
  std::int64_t count = 0;
  try {
    while (step()) {
      ++count;
      if (options.progress) options.progress(count);
      if (options.stop && options.stop(count)) break;
    }
  } catch (const Error& error) {
    if (count == 0) throw;
    failure = error.what();
  }
  try {
    keep();
  } catch (const FileError& error) {
    if (failure.empty()) throw;
    throw CaptureError(failure + "; " + error.what());
  }
  if (!failure.empty()) throw CaptureError(failure + "; the frames before that are kept");
}

}  // namespace

std::int64_t write_sequence(FrameSource& source, const TriangleMesh& mesh, const fs::path& folder,
                            const SequenceWriterOptions& options) {
  const std::optional<CameraModel> camera = source.camera();
  if (!camera) {
    throw ConfigError("a sequence needs a calibration, and " + source.description() +
                      " has none (--camera FILE)");
  }
  PendingSequence sequence(folder, options);
  while (const std::optional<Frame> frame = source.next()) {
    sequence.add(*frame, source.ground_truth());
    if (options.progress) options.progress(sequence.count());
  }
  sequence.commit(source.description(), camera, &mesh);
  return sequence.count();
}

Recording record_sequence(FrameSource& source, const TriangleMesh* mesh, const fs::path& folder,
                          const SequenceWriterOptions& options) {
  PendingSequence sequence(folder, options);
  Recording recording;
  const auto step = [&] {
    const std::optional<Frame> frame = next_readable(source, recording);
    if (!frame) return false;
    sequence.add(*frame, source.ground_truth());
    ++recording.frames;
    recording.lost += frame->lost_before;
    return !sequence.is_full();
  };
  record_until_done(options, step,
                    [&] { sequence.commit(source.description(), source.camera(), mesh); });
  return recording;
}

Recording record_sequences(FrameSetSource& source, const fs::path& folder,
                           const SequenceWriterOptions& options) {
  std::vector<std::unique_ptr<PendingSequence>> sequences;
  for (std::size_t i = 0; i < source.size(); ++i) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw FileError(folder, "", "can't make this folder: " + error.message());
    sequences.push_back(
        std::make_unique<PendingSequence>(folder / ("camera_" + std::to_string(i)), options));
  }
  Recording recording;
  const auto step = [&] {
    const std::optional<FrameSet> set = source.next();
    if (!set) return false;
    for (std::size_t i = 0; i < set->frames.size(); ++i) {
      sequences[i]->add(set->frames[i], std::nullopt);
    }
    ++recording.frames;
    recording.lost += set->lost_before;
    return !sequences.front()->is_full();
  };
  record_until_done(options, step, [&] {
    std::optional<FileError> failure;  // of one must not cost the others
    for (const auto& sequence : sequences) {
      sequence->truncate(recording.frames);  // of a set that could not be written whole
      try {
        sequence->commit(source.description(), std::nullopt, nullptr);
      } catch (const FileError& error) {
        if (!failure) failure = error;
      }
    }
    if (failure) throw FileError(*failure);
  });
  return recording;
}

}  // namespace anneal6d
