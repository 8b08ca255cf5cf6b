// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/capture/camera_source.h"

#include <algorithm>
#include <fstream>
#include <opencv2/videoio.hpp>
#include <system_error>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/number.h"
#include "size_text.h"

namespace anneal6d {
namespace {

#ifdef __linux__
constexpr bool kHasDeviceFiles = true;
constexpr int kBackend = cv::CAP_V4L2;
#else
constexpr bool kHasDeviceFiles = false;
constexpr int kBackend = cv::CAP_ANY;
#endif

std::string driver_name(const std::string& device) {
  std::ifstream file("/sys/class/video4linux/" + device + "/name");
  std::string name;
  std::getline(file, name);
  return name;
}

std::string existing_cameras(const std::vector<CameraDevice>& cameras) {
  if (cameras.empty()) {
    return "there is no /dev/video* at all; plug the camera in and see with 'dmesg' whether its "
           "driver finds it";
  }
  std::string text = "there are: ";
  for (const CameraDevice& camera : cameras) {
    if (&camera != &cameras.front()) text += ", ";
    text += camera.path.string();
    if (!camera.name.empty()) text += " (" + camera.name + ")";
  }
  return text;
}

std::unique_ptr<cv::VideoCapture> open_device(int number) {
  const std::string name = "camera " + std::to_string(number);
  if (kHasDeviceFiles) {
    const std::vector<CameraDevice> cameras = list_cameras();
    const auto camera =
        std::find_if(cameras.begin(), cameras.end(),
                     [number](const CameraDevice& device) { return device.number == number; });
    if (camera == cameras.end()) {
      throw BackendUnavailable("no " + name + ": " + existing_cameras(cameras));
    }
    if (!camera->accessible) {
      throw BackendUnavailable(name + ": this user may not open " + camera->path.string() +
                               "; add the user to the group video (sudo usermod -aG video USER) "
                               "and log in again");
    }
  }
  auto device = std::make_unique<cv::VideoCapture>();
  if (!device->open(number, kBackend)) {
    throw BackendUnavailable(
        name + " exists but gives no pictures: another program may be using it, or it is not a " +
        "picture device (cameras often have a second entry for metadata); " +
        (kHasDeviceFiles ? existing_cameras(list_cameras()) : "try another number"));
  }
  return device;
}

cv::Size calibrated_size(const CameraModel& camera) { return {camera.width_px, camera.height_px}; }

}  // namespace

std::vector<CameraDevice> list_cameras(const std::filesystem::path& device_folder) {
  std::vector<CameraDevice> cameras;
  std::error_code ignored;
  constexpr std::string_view prefix = "video";
  for (std::filesystem::directory_iterator entry(device_folder, ignored), end; entry != end;
       entry.increment(ignored)) {
    const std::string file = entry->path().filename().string();
    if (file.substr(0, prefix.size()) != prefix) continue;
    const std::optional<long long> number = parse_integer(file.substr(prefix.size()));
    if (!number || *number < 0 || *number > 9999) continue;
    cameras.push_back({static_cast<int>(*number), entry->path(), driver_name(file),
                       std::ifstream(entry->path()).is_open()});
  }
  std::sort(cameras.begin(), cameras.end(),
            [](const CameraDevice& a, const CameraDevice& b) { return a.number < b.number; });
  return cameras;
}

CameraSource::CameraSource(int number, std::optional<CameraModel> camera)
    : CameraSource(open_device(number), "camera " + std::to_string(number), std::move(camera)) {}

CameraSource::CameraSource(std::unique_ptr<cv::VideoCapture> device, std::string name,
                           std::optional<CameraModel> camera)
    : device_(std::move(device)), name_(std::move(name)), camera_(std::move(camera)) {
  if (!camera_) return;
  const cv::Size wanted = calibrated_size(*camera_);
  device_->set(cv::CAP_PROP_FRAME_WIDTH, wanted.width);
  device_->set(cv::CAP_PROP_FRAME_HEIGHT, wanted.height);
  const cv::Size got(static_cast<int>(device_->get(cv::CAP_PROP_FRAME_WIDTH)),
                     static_cast<int>(device_->get(cv::CAP_PROP_FRAME_HEIGHT)));
  if (got != wanted) {
    throw ConfigError(name_ + " has no picture size of " + size_text(wanted) +
                      " as in the calibration; it offers " + size_text(got) +
                      "; calibrate it at a size that it has");
  }
}

void CameraSource::grab() {
  if (device_->grab()) return;
  throw CaptureError(name_ + " stopped giving pictures after " + std::to_string(position_) +
                     " frames: it stalled or was unplugged; check the cable, plug it in again and "
                     "restart");
}

std::optional<Frame> CameraSource::next() {
  grab();
  const auto now = std::chrono::steady_clock::now();
  if (!first_time_) first_time_ = now;
  // Retrieved into fresh memory: the driver's buffer is reused for the next frame.
  Frame frame;
  if (!device_->retrieve(frame.image) || frame.image.empty()) {
    throw CaptureError(name_ + " gave a picture that can't be decoded (frame " +
                       std::to_string(position_) + "); check the cable");
  }
  if (camera_ && frame.image.size() != calibrated_size(*camera_)) {
    throw CaptureError(name_ + " gives pictures of " + size_text(frame.image.size()) +
                       ", but the calibration is for " + size_text(calibrated_size(*camera_)));
  }
  frame.index = position_++;
  frame.timestamp_s = std::chrono::duration<double>(now - *first_time_).count();
  return frame;
}

std::int64_t CameraSource::skip(std::int64_t count) {
  for (std::int64_t i = 0; i < count; ++i) {
    grab();
    ++position_;
  }
  return std::max<std::int64_t>(count, 0);
}

std::string CameraSource::description() const {
  const cv::Size size(static_cast<int>(device_->get(cv::CAP_PROP_FRAME_WIDTH)),
                      static_cast<int>(device_->get(cv::CAP_PROP_FRAME_HEIGHT)));
  return name_ + ", frames of " + size_text(size);
}

}  // namespace anneal6d
