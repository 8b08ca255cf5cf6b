// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "cao_file.h"

#include <Eigen/Geometry>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"
#include "polygon.h"
#include "text_tokens.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxCaoFileSize = std::size_t{4} << 20;
constexpr int kMaxFileDepth = 8;               // of files that load files
constexpr int kMaxFiles = 256;                 // in all
constexpr std::size_t kMaxRoundParts = 10000;  // cylinders and circles of one file
constexpr std::uint32_t kSegments = 48;        // of a circle

/// Reads one file and, through `load`, the files it names into one mesh.
class CaoReader {
 public:
  explicit CaoReader(MeshData& mesh) : mesh_(mesh) {}

  void read(const fs::path& path, int depth);

 private:
  /// What one file's entries refer to by number.
  struct Part {
    std::vector<Eigen::Vector3d> points;
    std::vector<std::array<std::size_t, 2>> lines;
  };

  void read_loads(TextTokens& tokens, const fs::path& path, int depth);
  void read_points(TextTokens& tokens, Part& part);
  void read_lines(TextTokens& tokens, Part& part);
  void read_faces_from_lines(TextTokens& tokens, const Part& part);
  void read_faces_from_points(TextTokens& tokens, const Part& part);
  void read_cylinders(TextTokens& tokens, const Part& part);
  void read_circles(TextTokens& tokens, const Part& part);

  void add_face(TextTokens& tokens, const Part& part, const std::vector<std::size_t>& corners);
  std::uint32_t add_ring(const Eigen::Vector3d& center, const Eigen::Vector3d& axis, double radius);
  std::uint32_t add_vertex(const Eigen::Vector3d& position);
  void add_triangle(TextTokens& tokens, const Triangle& triangle);

  MeshData& mesh_;
  int files_ = 0;
};

std::size_t take_index(TextTokens& tokens, std::size_t size, const std::string& what) {
  const std::size_t index = tokens.count("the number of a " + what);
  if (index >= size) {
    tokens.fail_at_taken("there is no " + what + " " + std::to_string(index) + "; there are " +
                         std::to_string(size) + ", counted from 0");
  }
  return index;
}

double take_radius(TextTokens& tokens) {
  const double radius = tokens.number("the radius");
  if (!(radius > 0)) tokens.fail_at_taken("the radius should be positive");
  return radius;
}

/// Skips `name="left door" useLod=true` behind an entry.
void skip_options(TextTokens& tokens, int line) {
  if (!tokens.at_end() && tokens.line() == line &&
      std::isalpha(static_cast<unsigned char>(tokens.peek().front())) != 0) {
    tokens.rest_of_line();
  }
}

void CaoReader::read(const fs::path& path, int depth) {
  if (depth > kMaxFileDepth || ++files_ > kMaxFiles) {
    throw FileError(path, "", "is loaded too deep or too often; does a file load itself?");
  }
  const std::string content = read_file(path, kMaxCaoFileSize);
  TextTokens tokens(path, content, '#');
  if (tokens.peek() != "V1") {
    tokens.fail_at_next(excerpt(tokens.peek()) +
                        " should be V1: only .cao models of version 1 are read");
  }
  tokens.take("V1");
  read_loads(tokens, path, depth);
  Part part;
  read_points(tokens, part);
  read_lines(tokens, part);
  read_faces_from_lines(tokens, part);
  read_faces_from_points(tokens, part);
  // Files from before cylinders and circles were added to the format end here.
  if (!tokens.at_end()) read_cylinders(tokens, part);
  if (!tokens.at_end()) read_circles(tokens, part);
  if (!tokens.at_end()) tokens.fail_at_next(excerpt(tokens.peek()) + " after the end of the model");
}

void CaoReader::read_loads(TextTokens& tokens, const fs::path& path, int depth) {
  while (tokens.peek().starts_with("load")) {
    const std::string_view text = tokens.rest_of_line();
    const std::size_t open = text.find('"');
    const std::size_t close = text.find('"', std::min(open, text.size() - 1) + 1);
    if (close == std::string_view::npos || text.find(')', close) == std::string_view::npos) {
      tokens.fail_at_taken(excerpt(text) + " should have the form load(\"part.cao\")");
    }
    if (text.substr(close + 1, text.find(')', close) - close - 1).find('=') !=
        std::string_view::npos) {
      tokens.fail_at_taken(excerpt(text) +
                           " moves the part it loads, which is not supported; "
                           "move its points instead");
    }
    read(path.parent_path() / std::string(text.substr(open + 1, close - open - 1)), depth + 1);
  }
}

void CaoReader::read_points(TextTokens& tokens, Part& part) {
  for (std::size_t left = tokens.count("the number of points"); left > 0; --left) {
    const int line = tokens.line();
    Eigen::Vector3d point;
    for (double& coordinate : point) coordinate = tokens.number("a coordinate of a point");
    part.points.push_back(point);
    skip_options(tokens, line);
  }
}

void CaoReader::read_lines(TextTokens& tokens, Part& part) {
  for (std::size_t left = tokens.count("the number of lines"); left > 0; --left) {
    const int line = tokens.line();
    std::array<std::size_t, 2> ends;
    for (std::size_t& end : ends) end = take_index(tokens, part.points.size(), "point");
    part.lines.push_back(ends);
    skip_options(tokens, line);
  }
}

std::size_t take_corner_count(TextTokens& tokens, const std::string& what) {
  const std::size_t count = tokens.count("the number of " + what + " of a face");
  if (count < 3 || count > kMaxCorners) {
    tokens.fail_at_taken("the face has " + std::to_string(count) + " " + what +
                         "; 3 to 512 are accepted");
  }
  return count;
}

void CaoReader::read_faces_from_lines(TextTokens& tokens, const Part& part) {
  for (std::size_t left = tokens.count("the number of faces from lines"); left > 0; --left) {
    const int line = tokens.line();
    const std::size_t count = take_corner_count(tokens, "lines");
    std::vector<std::array<std::size_t, 2>> sides(count);
    for (auto& side : sides) side = part.lines[take_index(tokens, part.lines.size(), "line")];
    // A line may run either way; each one's end that the next line shares is a corner.
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < count; ++i) {
      const auto& next = sides[(i + 1) % count];
      const bool first_is_shared = sides[i][0] == next[0] || sides[i][0] == next[1];
      const bool second_is_shared = sides[i][1] == next[0] || sides[i][1] == next[1];
      if (first_is_shared == second_is_shared) {
        tokens.fail_at_taken("the lines of the face do not make an outline, end to end");
      }
      corners.push_back(first_is_shared ? sides[i][0] : sides[i][1]);
    }
    skip_options(tokens, line);
    add_face(tokens, part, corners);
  }
}

void CaoReader::read_faces_from_points(TextTokens& tokens, const Part& part) {
  for (std::size_t left = tokens.count("the number of faces from points"); left > 0; --left) {
    const int line = tokens.line();
    std::vector<std::size_t> corners(take_corner_count(tokens, "points"));
    for (std::size_t& corner : corners) corner = take_index(tokens, part.points.size(), "point");
    skip_options(tokens, line);
    add_face(tokens, part, corners);
  }
}

void CaoReader::read_cylinders(TextTokens& tokens, const Part& part) {
  std::size_t left = tokens.count("the number of cylinders");
  if (left > kMaxRoundParts) tokens.fail_at_taken("the number of cylinders is absurd");
  for (; left > 0; --left) {
    const int line = tokens.line();
    const Eigen::Vector3d begin = part.points[take_index(tokens, part.points.size(), "point")];
    const Eigen::Vector3d end = part.points[take_index(tokens, part.points.size(), "point")];
    const double radius = take_radius(tokens);
    const Eigen::Vector3d axis = end - begin;
    if (!(axis.norm() > 0)) tokens.fail_at_taken("the cylinder has no length");
    const std::uint32_t low = add_ring(begin, axis, radius);
    const std::uint32_t high = add_ring(end, axis, radius);
    for (std::uint32_t i = 0; i < kSegments; ++i) {
      const std::uint32_t j = (i + 1) % kSegments;
      add_triangle(tokens, {low + i, low + j, high + j});
      add_triangle(tokens, {low + i, high + j, high + i});
    }
    skip_options(tokens, line);
  }
}

void CaoReader::read_circles(TextTokens& tokens, const Part& part) {
  std::size_t left = tokens.count("the number of circles");
  if (left > kMaxRoundParts) tokens.fail_at_taken("the number of circles is absurd");
  for (; left > 0; --left) {
    const int line = tokens.line();
    const double radius = take_radius(tokens);
    // The centre and two more points span the circle's plane.
    std::array<Eigen::Vector3d, 3> points;
    for (auto& point : points) point = part.points[take_index(tokens, part.points.size(), "point")];
    const Eigen::Vector3d axis = (points[1] - points[0]).cross(points[2] - points[0]);
    if (!(axis.norm() > 0)) tokens.fail_at_taken("the points of the circle lie on a line");
    const std::uint32_t ring = add_ring(points[0], axis, radius);
    const std::uint32_t center = add_vertex(points[0]);
    for (std::uint32_t i = 0; i < kSegments; ++i) {
      add_triangle(tokens, {center, ring + i, ring + (i + 1) % kSegments});
    }
    skip_options(tokens, line);
  }
}

void CaoReader::add_face(TextTokens& tokens, const Part& part,
                         const std::vector<std::size_t>& corners) {
  std::vector<Eigen::Vector3d> outline;
  for (const std::size_t corner : corners) outline.push_back(part.points[corner]);
  const auto triangles = triangulate(outline);
  if (!triangles) tokens.fail_at_taken("the face has no area, or its outline crosses itself");
  const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
  for (const Eigen::Vector3d& point : outline) add_vertex(point);
  for (const auto& t : *triangles) add_triangle(tokens, {first + t[0], first + t[1], first + t[2]});
}

std::uint32_t CaoReader::add_ring(const Eigen::Vector3d& center, const Eigen::Vector3d& axis,
                                  double radius) {
  const Eigen::Vector3d x = axis.unitOrthogonal();
  const Eigen::Vector3d y = axis.normalized().cross(x);
  const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    const double angle_rad = 2 * std::numbers::pi * i / kSegments;
    add_vertex(center + radius * (std::cos(angle_rad) * x + std::sin(angle_rad) * y));
  }
  return first;
}

std::uint32_t CaoReader::add_vertex(const Eigen::Vector3d& position) {
  mesh_.vertices.emplace_back().position_mm = position.cast<float>();
  return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
}

void CaoReader::add_triangle(TextTokens& tokens, const Triangle& triangle) {
  if (mesh_.triangles.size() >= kMaxTriangles)
    tokens.fail_at_taken("the model has too many triangles");
  mesh_.triangles.push_back(triangle);
}

}  // namespace

MeshData load_cao(const fs::path& path) {
  MeshData mesh;
  CaoReader(mesh).read(path, 0);
  return mesh;
}

}  // namespace anneal6d
