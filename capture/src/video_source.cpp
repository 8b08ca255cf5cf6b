// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/capture/video_source.h"

#include <algorithm>
#include <cmath>
#include <opencv2/videoio/registry.hpp>
#include <system_error>

#include "anneal6d/framework/error.h"
#include "size_text.h"

namespace anneal6d {
namespace {

// A header may count a few frames that no decoder hands out (edit lists, a last incomplete group),
// and for some containers OpenCV estimates the count from the duration.
constexpr double kToleratedShare = 0.02;
constexpr double kToleratedFrames = 3;

// With FFmpeg there, the other backends would only retry a file that it has refused, noisily.
int preferred_backend() {
  return cv::videoio_registry::hasBackend(cv::CAP_FFMPEG) ? cv::CAP_FFMPEG : cv::CAP_ANY;
}

double finite_or_zero(double value) { return std::isfinite(value) && value > 0 ? value : 0; }

}  // namespace

VideoSource::VideoSource(const std::filesystem::path& path, std::optional<CameraModel> camera)
    : path_(path), camera_(std::move(camera)) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    throw FileError(path, "", "there is no such file");
  }
  if (!video_.open(path.string(), preferred_backend())) {
    throw FileError(path, "",
                    "not a video that can be opened: unknown or cut-off format; play it with "
                    "another program, or convert it (ffmpeg -i IN -c:v libx264 OUT.mp4)");
  }
  announced_frames_ = finite_or_zero(video_.get(cv::CAP_PROP_FRAME_COUNT));
  frames_per_second_ = finite_or_zero(video_.get(cv::CAP_PROP_FPS));
  if (!grab() || !video_.retrieve(first_) || first_.empty()) {
    throw FileError(path, "frame 0", "the video holds no picture that can be decoded");
  }
  size_ = first_.size();
  if (camera_ && size_ != cv::Size(camera_->width_px, camera_->height_px)) {
    throw ConfigError("the video " + path.string() + " has " + size_text(size_) +
                      " pixels, but the calibration is for " +
                      size_text({camera_->width_px, camera_->height_px}) +
                      "; give the calibration of the camera that recorded it");
  }
}

bool VideoSource::grab() {
  if (ended_) return false;
  if (!video_.grab()) {
    ended_ = true;
    return false;
  }
  position_ms_ = std::max(position_ms_, finite_or_zero(video_.get(cv::CAP_PROP_POS_MSEC)));
  return true;
}

void VideoSource::throw_if_cut_short() {
  const double tolerance = std::max(kToleratedFrames, kToleratedShare * announced_frames_);
  if (static_cast<double>(position_) + tolerance >= announced_frames_) return;
  // With a varying frame rate an estimated count is wrong, but the last picture's time is not.
  const double reached = position_ms_ * 1e-3 * frames_per_second_ + 1;
  if (reached + tolerance >= announced_frames_) return;
  throw FileError(path_, "frame " + std::to_string(position_),
                  "the video breaks off here, its header announces " +
                      std::to_string(std::llround(announced_frames_)) +
                      " frames: the file is truncated or damaged; copy or record it again");
}

std::optional<Frame> VideoSource::next() {
  Frame frame;
  if (!first_.empty()) {
    frame.image = std::move(first_);
    first_.release();
  } else {
    if (ended_) return std::nullopt;
    if (!grab()) {
      throw_if_cut_short();
      return std::nullopt;
    }
    if (!video_.retrieve(frame.image) || frame.image.size() != size_) {
      throw FileError(path_, "frame " + std::to_string(position_++),
                      "this frame can't be decoded or has another size");
    }
  }
  frame.index = position_++;
  const double rate = frames_per_second_ > 0 ? frames_per_second_ : 30;
  frame.timestamp_s = static_cast<double>(frame.index) / rate;
  return frame;
}

std::int64_t VideoSource::skip(std::int64_t count) {
  std::int64_t skipped = 0;
  if (count > 0 && !first_.empty()) {
    first_.release();
    ++skipped;
    ++position_;
  }
  while (skipped < count && !ended_) {
    if (!grab()) {
      throw_if_cut_short();
      break;
    }
    ++skipped;
    ++position_;
  }
  return skipped;
}

std::string VideoSource::description() const {
  std::string text = "video " + path_.string();
  if (announced_frames_ > 0) {
    text += ", " + std::to_string(std::llround(announced_frames_)) + " frames of ";
  } else {
    text += ", frames of ";
  }
  return text + size_text(size_);
}

}  // namespace anneal6d
