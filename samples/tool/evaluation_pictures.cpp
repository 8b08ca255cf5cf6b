// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "evaluation_pictures.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstddef>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "anneal6d/framework/error.h"
#include "anneal6d/visualizer/headless_context.h"
#include "anneal6d/visualizer/overlay.h"
#include "plugins.h"

namespace anneal6d {

namespace {

constexpr int kWidest_px = 640;
constexpr int kJpegQuality = 85;
const cv::Vec3b kTruthColor_bgr(255, 0, 255);

/// How far off a pose is, such that 1 is just not precise any more.
double badness(const PoseError& error) {
  return std::max(error.translation_mm.norm() / kPrecise_mm, error.rotation_deg / kPrecise_deg);
}

struct Choice {
  JudgedFrame frame;
  std::string why;
};

/// By frame; one that is chosen twice tells both reasons.
std::map<std::int64_t, Choice> choose(std::span<const JudgedFrame> judged) {
  std::map<std::int64_t, Choice> choices;
  const auto add = [&](const JudgedFrame& frame, const char* why) {
    Choice& choice = choices[frame.frame];
    choice.frame = frame;
    choice.why += (choice.why.empty() ? "" : " and ") + std::string(why);
  };
  add(judged.front(), "first");
  add(worst_of(judged), "worst");
  add(judged.back(), "last");
  return choices;
}

std::string to_jpeg(const cv::Mat& picture) {
  cv::Mat small = picture;
  if (picture.cols > kWidest_px) {
    const double scale = static_cast<double>(kWidest_px) / picture.cols;
    cv::resize(picture, small, {}, scale, scale, cv::INTER_AREA);
  }
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", small, jpeg, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  return {jpeg.begin(), jpeg.end()};
}

/// Draws both poses over frames.
class ComparisonPainter {
 public:
  explicit ComparisonPainter(const TrackingJob& job)
      : undistort_(job.camera),
        truth_(make_renderer(job.mesh, without_distortion(job.camera), true)),
        estimate_(make_renderer(job.mesh, without_distortion(job.camera), true), job.mesh,
                  without_distortion(job.camera)) {}

  /// The estimate goes over the truth: where both agree, only the estimate is to be seen.
  const cv::Mat& paint(const Frame& frame, const PoseRow& row, const Pose& true_pose) {
    Frame drawn = frame;
    const cv::Mat undistorted = undistort_(frame.image);
    if (undistorted.channels() == 1) {
      cv::cvtColor(undistorted, drawn.image, cv::COLOR_GRAY2BGR);
    } else {
      drawn.image = undistorted.clone();
    }
    draw_edges(drawn.image,
               rendered_edges(*truth_, true_pose, Shading{}, EdgeOptions{.threshold = 60}),
               kTruthColor_bgr);
    TrackResult result;
    result.camera_from_object = row.camera_from_object;
    result.quality = row.quality;
    result.status = row.status;
    return estimate_.paint(drawn, result);
  }

 private:
  static CameraModel without_distortion(CameraModel camera) {
    camera.distortion = {};
    return camera;
  }

  Undistorter undistort_;
  std::unique_ptr<ObjectRenderer> truth_;
  OverlayPainter estimate_;
};

}  // namespace

const JudgedFrame& worst_of(std::span<const JudgedFrame> frames) {
  return *std::max_element(frames.begin(), frames.end(), [](const auto& a, const auto& b) {
    return badness(a.error) < badness(b.error);
  });
}

std::vector<EvaluationPicture> paint_pictures(const TrackingJob& job, std::span<const PoseRow> rows,
                                              std::span<const JudgedFrame> judged,
                                              const std::map<std::int64_t, Pose>& truth) {
  if (!headless_opengl_unavailable_reason().empty()) return {};
  FrameSourceSetup setup;
  setup.input = job.input;
  setup.camera = job.camera;
  const std::unique_ptr<FrameSource> source = open_frame_source(all_frame_sources(), setup);
  ComparisonPainter painter(job);
  std::vector<EvaluationPicture> pictures;
  std::int64_t position = 0;
  for (const auto& [index, choice] : choose(judged)) {
    source->skip(index - position);
    const std::optional<Frame> frame = source->next();
    if (!frame) throw Error(job.input + " lost frames while it was evaluated");
    position = index + 1;
    const auto row = std::find_if(rows.begin(), rows.end(), [&, wanted = index](const PoseRow& r) {
      return r.frame == wanted;
    });
    pictures.push_back(
        {fmt::format("{}: frame {}, off by {:.1f} mm and {:.1f}\u00b0", choice.why, index,
                     choice.frame.error.translation_mm.norm(), choice.frame.error.rotation_deg),
         to_jpeg(painter.paint(*frame, *row, truth.at(index)))});
  }
  return pictures;
}

}  // namespace anneal6d
