// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "stl_file.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"
#include "little_endian.h"
#include "text_tokens.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

// A header of 80 bytes that means nothing, the number of triangles, then 50 bytes for each: normal
// and three corners, 4-byte floats, and two bytes that mean nothing.
constexpr std::size_t kCountAt = 80;
constexpr std::size_t kTrianglesAt = 84;
constexpr std::size_t kTriangleSize = 50;
constexpr std::size_t kNormalSize = 12;

void add_triangle(MeshData& mesh, const std::array<Eigen::Vector3f, 3>& corners,
                  const fs::path& path) {
  if (mesh.triangles.size() >= kMaxTriangles) {
    throw FileError(
        path, "",
        "has more than " + std::to_string(kMaxTriangles) + " triangles; simplify the model");
  }
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Eigen::Vector3f& corner : corners) mesh.vertices.emplace_back().position_mm = corner;
  mesh.triangles.push_back({first, first + 1, first + 2});
}

MeshData parse_binary(const fs::path& path, const std::string& content) {
  MeshData mesh;
  for (std::size_t at = kTrianglesAt; at < content.size(); at += kTriangleSize) {
    std::array<Eigen::Vector3f, 3> corners;
    const char* bytes = content.data() + at + kNormalSize;
    for (Eigen::Vector3f& corner : corners) {
      for (float& coordinate : corner) {
        coordinate = decode_little_endian<float>(bytes);
        bytes += sizeof(float);
      }
      if (!corner.allFinite()) {
        throw FileError(path, "byte " + std::to_string(at), "a coordinate is not finite");
      }
    }
    add_triangle(mesh, corners, path);
  }
  return mesh;
}

void expect_word(TextTokens& tokens, std::string_view word) {
  std::string found(tokens.peek());
  std::transform(found.begin(), found.end(), found.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::string expected = "'" + std::string(word) + "'";
  if (!tokens.at_end() && found != word) {
    tokens.fail_at_next(excerpt(tokens.peek()) + " should be " + expected);
  }
  tokens.take(expected);
}

void skip_name(TextTokens& tokens) {
  if (!tokens.at_end() && tokens.line() == tokens.taken_line()) tokens.rest_of_line();
}

void parse_facet(TextTokens& tokens, MeshData& mesh, const fs::path& path) {
  expect_word(tokens, "facet");
  expect_word(tokens, "normal");
  for (int i = 0; i < 3; ++i) tokens.take("a normal");  // whatever it is: some write nan
  expect_word(tokens, "outer");
  expect_word(tokens, "loop");
  std::array<Eigen::Vector3f, 3> corners;
  for (Eigen::Vector3f& corner : corners) {
    expect_word(tokens, "vertex");
    for (float& coordinate : corner) {
      coordinate = static_cast<float>(tokens.number("a coordinate"));
    }
  }
  expect_word(tokens, "endloop");
  expect_word(tokens, "endfacet");
  add_triangle(mesh, corners, path);
}

MeshData parse_text(const fs::path& path, const std::string& content) {
  MeshData mesh;
  TextTokens tokens(path, content);
  do {
    expect_word(tokens, "solid");
    skip_name(tokens);
    while (tokens.peek().starts_with('f') || tokens.peek().starts_with('F')) {
      parse_facet(tokens, mesh, path);
    }
    expect_word(tokens, "endsolid");
    skip_name(tokens);
  } while (!tokens.at_end());
  return mesh;
}

}  // namespace

MeshData load_stl(const fs::path& path) {
  const std::string content = read_file(path);
  // Binary files may begin with "solid", too: their size tells.
  if (content.size() >= kTrianglesAt) {
    const auto count = decode_little_endian<std::uint32_t>(content.data() + kCountAt);
    if (content.size() == kTrianglesAt + kTriangleSize * count) return parse_binary(path, content);
  }
  const TextTokens tokens(path, content);
  if (!tokens.peek().starts_with("solid") && !tokens.peek().starts_with("SOLID")) {
    throw FileError(
        path, "",
        "is no STL model: it does not begin with 'solid', and its size does not fit the "
        "number of triangles at byte 80");
  }
  return parse_text(path, content);
}

}  // namespace anneal6d
