// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/pose_file.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/framework/number.h"
#include "text_tokens.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxPoseFileSize = std::size_t{256} << 20;
constexpr double kUnitTolerance = 1e-3;  // of a quaternion's length
constexpr std::string_view kPoseColumns = "frame,tx,ty,tz,qw,qx,qy,qz";
constexpr std::string_view kRowColumns =
    "frame,tx,ty,tz,qw,qx,qy,qz,quality,status,reset,milliseconds";
constexpr std::size_t kPoseColumnCount = 8;

/// Seven numbers tx ty tz qw qx qy qz to a pose; empty if the quaternion is not of unit length.
std::optional<Pose> pose_from(std::span<const double, 7> values) {
  Pose pose;
  pose.translation_mm = {values[0], values[1], values[2]};
  const Eigen::Quaterniond rotation(values[3], values[4], values[5], values[6]);
  if (!(std::abs(rotation.norm() - 1) <= kUnitTolerance)) return std::nullopt;
  pose.rotation = rotation.normalized();
  return pose;
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t comma; (comma = line.find(',')) != std::string_view::npos;) {
    cells.push_back(line.substr(0, comma));
    line.remove_prefix(comma + 1);
  }
  cells.push_back(line);
  return cells;
}

/// Cuts the first line off `rest`, without its end (LF or CRLF).
std::string_view take_line(std::string_view& rest) {
  const std::size_t length = std::min(rest.find('\n'), rest.size());
  std::string_view line = rest.substr(0, length);
  rest.remove_prefix(std::min(length + 1, rest.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

void append(std::string& row, double value, int decimals) {
  std::array<char, 400> buffer;  // the largest double has 309 digits before the point
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                    std::chars_format::fixed, decimals);
  row.append(1, ',').append(buffer.data(), result.ptr);
}

std::string pose_row(std::int64_t frame, const Pose& pose) {
  constexpr int kMillimetreDecimals = 6, kQuaternionDecimals = 9;
  std::string row = std::to_string(frame);
  for (const double value : pose.translation_mm) append(row, value, kMillimetreDecimals);
  const Eigen::Quaterniond& q = pose.rotation;
  for (const double value : {q.w(), q.x(), q.y(), q.z()}) append(row, value, kQuaternionDecimals);
  return row;
}

}  // namespace

std::map<std::int64_t, Pose> load_poses(const fs::path& path) {
  const std::string content = read_file(path, kMaxPoseFileSize);
  std::string_view rest = content;
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (rest.starts_with(kByteOrderMark)) rest.remove_prefix(kByteOrderMark.size());

  int number = 1;
  const auto fail = [&](const std::string& what) {
    throw FileError(path, "line " + std::to_string(number), what);
  };
  const std::string_view header = take_line(rest);
  const bool is_pose_table =
      header == kPoseColumns || header.starts_with(std::string(kPoseColumns) + ",");
  if (!is_pose_table) {
    fail("the columns should be " + std::string(kPoseColumns) + "[,...], but are " +
         excerpt(header));
  }
  const std::size_t columns = split(header).size();

  std::map<std::int64_t, Pose> poses;
  while (!rest.empty()) {
    ++number;
    const std::string_view line = take_line(rest);
    if (line.empty() && rest.empty()) break;
    const std::vector<std::string_view> cells = split(line);
    if (cells.size() != columns) {
      fail("has " + std::to_string(cells.size()) + " columns; the first line names " +
           std::to_string(columns));
    }
    const auto frame = parse_integer(cells[0]);
    if (!frame || *frame < 0) fail(excerpt(cells[0]) + " should be a frame, a whole number from 0");
    std::array<double, kPoseColumnCount - 1> values;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto value = parse_number(cells[i + 1]);
      if (!value) {
        fail(excerpt(cells[i + 1]) + " in column " + std::to_string(i + 2) +
             " should be a finite number");
      }
      values[i] = *value;
    }
    const std::optional<Pose> pose = pose_from(values);
    if (!pose) fail("the quaternion qw,qx,qy,qz should have unit length");
    if (!poses.emplace(*frame, *pose).second) {
      fail("frame " + std::to_string(*frame) + " is given a second time");
    }
  }
  return poses;
}

Pose parse_pose(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n,";
  std::vector<double> values;
  while (true) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) break;
    const std::size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
    const auto value = parse_number(text.substr(begin, end - begin));
    if (!value) {
      throw ConfigError("pose: " + excerpt(text.substr(begin, end - begin)) +
                        " should be a finite number");
    }
    values.push_back(*value);
    text.remove_prefix(end);
  }
  if (values.size() != 7) {
    throw ConfigError("pose: there are " + std::to_string(values.size()) +
                      " numbers; seven are needed: tx ty tz (mm) qw qx qy qz");
  }
  const std::optional<Pose> pose = pose_from(std::span<const double, 7>(values));
  if (!pose) throw ConfigError("pose: the quaternion qw qx qy qz should have unit length");
  return *pose;
}

std::string_view pose_row_header() { return kRowColumns; }

std::string to_csv(const PoseRow& row) {
  constexpr int kQualityDecimals = 4, kMillisecondDecimals = 3;
  std::string text = pose_row(row.frame, row.camera_from_object);
  append(text, row.quality, kQualityDecimals);
  text.append(1, ',').append(to_string(row.status)).append(row.reset ? ",1" : ",0");
  append(text, row.milliseconds, kMillisecondDecimals);
  return text;
}

PoseWriter::PoseWriter(fs::path path)
    : path_(std::move(path)), temporary_(temporary_beside(path_)) {
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  stream_ << kRowColumns << '\n';
  if (!stream_) {
    throw FileError(path_, "",
                    "cannot be written; check that the folder exists and that you may write there");
  }
}

PoseWriter::~PoseWriter() {
  if (!stream_.is_open()) return;
  stream_.close();
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void PoseWriter::write(const PoseRow& row) {
  stream_ << to_csv(row) << '\n';
  if (!stream_) throw FileError(path_, "", "cannot be written; is the disk full?");
}

void PoseWriter::commit() {
  stream_.flush();
  if (!stream_) throw FileError(path_, "", "cannot be written; is the disk full?");
  stream_.close();
  std::error_code failure;
  fs::rename(temporary_, path_, failure);
  if (failure) {
    std::error_code ignored;
    fs::remove(temporary_, ignored);
    throw FileError(path_, "", "cannot be written: " + failure.message());
  }
}

void save_poses(const std::map<std::int64_t, Pose>& poses, const fs::path& path) {
  std::string content = std::string(kPoseColumns) + "\n";
  for (const auto& [frame, pose] : poses) content += pose_row(frame, pose) + "\n";
  write_file_atomically(path, content);
}

}  // namespace anneal6d
