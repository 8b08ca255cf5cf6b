// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/visualizer/picture_writer.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"

namespace anneal6d {

namespace fs = std::filesystem;

namespace {

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return extension;
}

/// The codec that every OpenCV with FFmpeg has for the container; 0 if it is none of ours.
int codec_for(const std::string& extension) {
  if (extension == ".mp4" || extension == ".mkv") {
    return cv::VideoWriter::fourcc('m', 'p', '4', 'v');
  }
  if (extension == ".avi") return cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
  return 0;
}

bool is_foreign_file_type(const std::string& extension) {
  constexpr std::array<const char*, 8> kForeign = {".mov", ".webm", ".gif", ".mpg",
                                                   ".wmv", ".m4v",  ".png", ".jpg"};
  return std::find(kForeign.begin(), kForeign.end(), extension) != kForeign.end();
}

}  // namespace

class PictureWriter::Sink {
 public:
  virtual ~Sink() = default;
  virtual void write(const cv::Mat& picture_bgr, std::int64_t frame) = 0;
  virtual void commit() = 0;
};

class PictureWriter::FolderSink final : public Sink {
 public:
  explicit FolderSink(fs::path folder) : folder_(std::move(folder)) {
    std::error_code failure;
    fs::create_directories(folder_, failure);
    std::error_code ignored;
    if (failure || !fs::is_directory(folder_, ignored)) {
      throw FileError(folder_, "",
                      "cannot be made a folder for pictures" +
                          (failure ? ": " + failure.message() : std::string()));
    }
    // Finds out now, not after the first frame was tracked, that nothing can be written here.
    const fs::path probe = folder_ / "overlay.part";
    write_file_atomically(probe, "");
    fs::remove(probe, ignored);
  }

  void write(const cv::Mat& picture_bgr, std::int64_t frame) override {
    std::array<char, 48> name{};
    std::snprintf(name.data(), name.size(), "overlay_%04lld.png", static_cast<long long>(frame));
    const fs::path path = folder_ / name.data();
    if (!cv::imencode(".png", picture_bgr, encoded_)) {
      throw FileError(path, "", "the picture cannot be encoded as PNG");
    }
    write_file_atomically(path, {reinterpret_cast<const char*>(encoded_.data()), encoded_.size()});
  }

  void commit() override {}

 private:
  fs::path folder_;
  std::vector<unsigned char> encoded_;
};

class PictureWriter::VideoSink final : public Sink {
 public:
  VideoSink(fs::path path, int codec, double frames_per_second)
      : path_(std::move(path)),
        temporary_(path_.parent_path() /
                   (path_.stem().string() + ".part" + path_.extension().string())),
        codec_(codec),
        frames_per_second_(frames_per_second) {
    std::error_code ignored;
    if (fs::is_directory(path_, ignored)) {
      throw FileError(path_, "", "is a folder; a video needs a file name that is free");
    }
    // OpenCV opens the file when the size of the pictures is known; ask the system now.
    if (!std::ofstream(temporary_, std::ios::binary | std::ios::trunc)) {
      throw FileError(path_, "",
                      "cannot be written; check that the folder exists and that you may write "
                      "there");
    }
  }

  ~VideoSink() override {
    video_.release();
    std::error_code ignored;
    fs::remove(temporary_, ignored);
  }

  void write(const cv::Mat& picture_bgr, std::int64_t) override {
    if (!video_.isOpened() &&
        !video_.open(temporary_.string(), codec_, frames_per_second_, picture_bgr.size())) {
      throw FileError(
          path_, "",
          "OpenCV cannot write this kind of video of " + std::to_string(picture_bgr.cols) + "x" +
              std::to_string(picture_bgr.rows) + " here; try .avi, or a folder for PNG files");
    }
    video_.write(picture_bgr);
    ++pictures_;
  }

  void commit() override {
    if (pictures_ == 0) throw FileError(path_, "", "no picture was given for this video");
    video_.release();
    check_complete();
    std::error_code failure;
    fs::rename(temporary_, path_, failure);
    if (failure) throw FileError(path_, "", "cannot be written: " + failure.message());
  }

 private:
  /// OpenCV does not report failed writes, of a full disk for one: look whether the end is there.
  void check_complete() const {
    cv::VideoCapture video(temporary_.string());
    const int count = video.isOpened() ? cvRound(video.get(cv::CAP_PROP_FRAME_COUNT)) : 0;
    cv::Mat last;
    if (count >= pictures_) {
      video.set(cv::CAP_PROP_POS_FRAMES, pictures_ - 1);
      video.read(last);
    }
    if (last.empty()) {
      throw FileError(path_, "",
                      "the video is incomplete: its last picture cannot be read back; check that "
                      "the disk is not full");
    }
  }

  fs::path path_, temporary_;
  int codec_;
  double frames_per_second_;
  int pictures_ = 0;
  cv::VideoWriter video_;
};

PictureWriter::PictureWriter(fs::path path, double frames_per_second) {
  if (!(frames_per_second > 0 && frames_per_second <= 1000)) {
    throw ConfigError("a video cannot have " + std::to_string(frames_per_second) +
                      " pictures a second; 0 to 1000 are possible");
  }
  const std::string extension = lower_extension(path);
  if (const int codec = codec_for(extension); codec != 0) {
    sink_ = std::make_unique<VideoSink>(std::move(path), codec, frames_per_second);
  } else if (is_foreign_file_type(extension)) {
    throw FileError(path, "",
                    "pictures are written as a video (.mp4, .mkv, .avi) or into a folder; '" +
                        extension + "' is neither");
  } else {
    sink_ = std::make_unique<FolderSink>(std::move(path));
  }
}

PictureWriter::~PictureWriter() = default;

void PictureWriter::write(const cv::Mat& picture_bgr, std::int64_t frame) {
  if (size_px_.empty()) size_px_ = picture_bgr.size();
  if (picture_bgr.empty() || picture_bgr.type() != CV_8UC3 || picture_bgr.size() != size_px_) {
    throw ConfigError("picture " + std::to_string(frame) +
                      " differs from the others: 8-bit BGR of " + std::to_string(size_px_.width) +
                      "x" + std::to_string(size_px_.height) + " is expected");
  }
  if (frame < 0) throw ConfigError("picture number " + std::to_string(frame) + " is negative");
  sink_->write(picture_bgr, frame);
}

void PictureWriter::commit() { sink_->commit(); }

}  // namespace anneal6d
