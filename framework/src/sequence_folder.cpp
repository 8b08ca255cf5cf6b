// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/sequence_folder.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"
#include "anneal6d/framework/number.h"
#include "anneal6d/framework/pose_file.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool is_image(const fs::path& file) {
  constexpr std::array<std::string_view, 8> kExtensions = {".png", ".jpg", ".jpeg", ".bmp",
                                                           ".pgm", ".ppm", ".tif",  ".tiff"};
  return std::find(kExtensions.begin(), kExtensions.end(), lower_case(file.extension().string())) !=
         kExtensions.end();
}

/// N of `frame_N.png|jpg` with at least four digits; empty for another name.
std::optional<long long> frame_number(const fs::path& file) {
  constexpr std::string_view kPrefix = "frame_";
  constexpr std::size_t kDigits = 4;
  const std::string extension = file.extension().string();
  const std::string stem = file.stem().string();
  if ((extension != ".png" && extension != ".jpg") || !stem.starts_with(kPrefix)) return {};
  const std::string_view digits = std::string_view(stem).substr(kPrefix.size());
  if (digits.size() < kDigits || digits.find_first_not_of("0123456789") != std::string_view::npos) {
    return {};
  }
  return parse_integer(digits);
}

/// "image2" before "image10": runs of digits compare as numbers.
bool natural_less(const fs::path& left, const fs::path& right) {
  const std::string a = left.filename().string(), b = right.filename().string();
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto take_number = [&](const std::string& text, std::size_t& at) {
    while (at < text.size() && text[at] == '0') ++at;  // leading zeros say nothing
    const std::size_t begin = at;
    while (at < text.size() && is_digit(text[at])) ++at;
    return std::string_view(text).substr(begin, at - begin);
  };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::string_view m = take_number(a, i), n = take_number(b, j);
      if (m != n) return m.size() != n.size() ? m.size() < n.size() : m < n;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i, ++j;
    }
  }
  const bool a_ends = i == a.size(), b_ends = j == b.size();
  return a_ends != b_ends ? a_ends : a < b;
}

std::vector<fs::path> list_files(const fs::path& folder) {
  std::error_code failure;
  const fs::file_status status = fs::status(folder, failure);
  if (status.type() == fs::file_type::not_found) {
    throw FileError(folder, "", "does not exist; a folder of images is expected");
  }
  if (!failure && !fs::is_directory(status)) {
    throw FileError(folder, "", "is no folder; a folder of images is expected");
  }
  std::vector<fs::path> files;
  fs::directory_iterator entry(folder, failure);
  while (!failure && entry != fs::directory_iterator()) {
    std::error_code ignored;
    const bool is_hidden = entry->path().filename().string().starts_with('.');
    if (!is_hidden && entry->is_regular_file(ignored)) files.push_back(entry->path());
    entry.increment(failure);
  }
  if (failure) throw FileError(folder, "", "cannot be read: " + failure.message());
  return files;
}

std::vector<fs::path> find_images(const fs::path& folder) {
  const std::vector<fs::path> files = list_files(folder);
  std::map<long long, fs::path> numbered;
  for (const fs::path& file : files) {
    const auto number = frame_number(file);
    if (!number) continue;
    const auto [entry, is_new] = numbered.emplace(*number, file);
    if (!is_new) {
      throw FileError(folder, "frame " + std::to_string(*number),
                      "there are two images of it: " + entry->second.filename().string() + " and " +
                          file.filename().string());
    }
  }
  std::vector<fs::path> images;
  if (!numbered.empty()) {
    for (const auto& [number, file] : numbered) images.push_back(file);
    const auto span = numbered.rbegin()->first - numbered.begin()->first + 1;
    if (static_cast<std::size_t>(span) != images.size()) {
      log(LogLevel::warning, folder.string() +
                                 ": the numbers of the images have gaps; a frame's "
                                 "index is its position, not its number");
    }
    return images;
  }
  std::copy_if(files.begin(), files.end(), std::back_inserter(images), is_image);
  if (images.empty()) {
    throw FileError(folder, "",
                    "holds no image; frame_0000.png, ... or other png, jpg, bmp, pgm, ppm or tif "
                    "files are expected");
  }
  std::sort(images.begin(), images.end(), natural_less);
  return images;
}

std::optional<fs::path> if_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored) ? std::optional(file) : std::nullopt;
}

}  // namespace

SequenceFolder open_sequence_folder(const fs::path& folder) {
  SequenceFolder sequence;
  sequence.folder = folder;
  sequence.images = find_images(folder);
  sequence.camera_file = if_there(folder / "camera.yml");
  sequence.model_file = if_there(folder / "model.obj");
  if (const auto truth = if_there(folder / "groundtruth.csv")) {
    sequence.ground_truth = load_poses(*truth);
    const auto count = static_cast<std::int64_t>(sequence.images.size());
    if (!sequence.ground_truth.empty() && sequence.ground_truth.rbegin()->first >= count) {
      throw FileError(*truth, "frame " + std::to_string(sequence.ground_truth.rbegin()->first),
                      "is no frame of the sequence, whose " + std::to_string(count) +
                          " images are frames 0 to " + std::to_string(count - 1));
    }
  }
  if (const auto meta = if_there(folder / "meta.json")) sequence.symmetry = load_symmetry(*meta);
  return sequence;
}

}  // namespace anneal6d
