// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/capture/sequence_source.h"

#include <algorithm>

#include "anneal6d/framework/error.h"
#include "image_file.h"
#include "size_text.h"

namespace anneal6d {
namespace {

constexpr double kSequenceFramesPerSecond = 30;

}  // namespace

SequenceSource::SequenceSource(const std::filesystem::path& folder,
                               std::optional<CameraModel> camera)
    : folder_(open_sequence_folder(folder)), camera_(std::move(camera)) {
  if (!camera_ && folder_.camera_file) camera_ = load_camera(*folder_.camera_file);
  if (camera_) {
    frame_size_ = {camera_->width_px, camera_->height_px};
    size_origin_ = "the camera calibration";
  }
}

std::optional<Frame> SequenceSource::next() {
  if (position_ >= size()) return std::nullopt;
  // Moves on first: after a broken image the next call goes on with the next one.
  const std::int64_t index = position_++;
  const std::filesystem::path& path = folder_.images[static_cast<std::size_t>(index)];
  Frame frame;
  frame.image = read_image(path);
  check_size(path, frame.image);
  frame.index = index;
  frame.timestamp_s = static_cast<double>(index) / kSequenceFramesPerSecond;
  return frame;
}

void SequenceSource::check_size(const std::filesystem::path& path, const cv::Mat& image) {
  if (frame_size_.empty()) {
    frame_size_ = image.size();
    size_origin_ = path.filename().string();
  }
  if (image.size() != frame_size_) {
    throw FileError(path, "",
                    "the image has " + size_text(image.size()) + " pixels, but " + size_origin_ +
                        " has " + size_text(frame_size_) +
                        "; all images of a sequence must have the calibration's size");
  }
}

std::int64_t SequenceSource::skip(std::int64_t count) {
  const std::int64_t skipped = std::clamp<std::int64_t>(count, 0, size() - position_);
  position_ += skipped;
  return skipped;
}

std::string SequenceSource::description() const {
  return "sequence " + folder_.folder.string() + ", " + std::to_string(size()) + " frames" +
         (frame_size_.empty() ? "" : " of " + size_text(frame_size_));
}

std::optional<Pose> SequenceSource::ground_truth() const {
  const auto row = folder_.ground_truth.find(position_ - 1);
  if (row == folder_.ground_truth.end()) return std::nullopt;
  return row->second;
}

}  // namespace anneal6d
