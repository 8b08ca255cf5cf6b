// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "mesh_edges.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "mesh_sides.h"

namespace anneal6d {
namespace {

const double kSharpCosine = std::cos(35.0 * (std::numbers::pi / 180.0));
const double kSmoothCosine = std::cos(30.0 * (std::numbers::pi / 180.0));
// Sharp edges that meet go on as one line if it turns by no more than this.
const double kOnwardCosine = std::cos(30.0 * (std::numbers::pi / 180.0));
// Of the diameter: a scan's noise makes neither edges nor lines of them as long as these.
constexpr double kCreaseLength = 0.03;
constexpr double kCreaseLineLength = 0.05;

using Ends = std::pair<std::uint32_t, std::uint32_t>;  // vertices, the lower one first

struct SharpEdge {
  std::size_t index;
  Ends ends;
};

/// For each sharp edge the length of the line that it is part of, mm.
std::vector<double> line_lengths_mm(const std::vector<SharpEdge>& sharp,
                                    const std::vector<MeshEdge>& edges) {
  // A forest of edges: the ones of a line have one root.
  std::vector<std::size_t> parent(sharp.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  struct Start {
    std::size_t edge;
    Eigen::Vector3d along;
  };
  std::map<std::uint32_t, std::vector<Start>> starts;  // by vertex
  std::vector<double> length_mm;
  for (std::size_t i = 0; i < sharp.size(); ++i) {
    const MeshEdge& edge = edges[sharp[i].index];
    const Eigen::Vector3d along = (edge.to_mm - edge.from_mm).cast<double>();
    length_mm.push_back(along.norm());
    starts[sharp[i].ends.first].push_back({i, along.normalized()});
    starts[sharp[i].ends.second].push_back({i, -along.normalized()});
  }
  for (const auto& [vertex, here] : starts) {
    for (const Start& a : here) {
      for (const Start& b : here) {
        if (a.along.dot(b.along) < -kOnwardCosine) parent[root(a.edge)] = root(b.edge);
      }
    }
  }
  std::vector<double> line_mm(sharp.size());
  for (std::size_t i = 0; i < sharp.size(); ++i) line_mm[root(i)] += length_mm[i];
  for (std::size_t i = 0; i < sharp.size(); ++i) length_mm[i] = line_mm[root(i)];
  return length_mm;
}

}  // namespace

std::vector<MeshEdge> mesh_edges(const TriangleMesh& mesh) {
  const auto position = [&](std::uint32_t i) -> const Eigen::Vector3f& {
    return mesh.vertices()[i].position_mm;
  };
  std::vector<Eigen::Vector3d> normals;
  for (const Triangle& triangle : mesh.triangles()) normals.push_back(normal_of(mesh, triangle));
  std::vector<MeshEdge> edges;
  std::vector<SharpEdge> sharp;
  for_each_edge(sides_of(mesh), [&](std::span<const MeshSide> sides) {
    const Ends& ends = sides.front().ends;
    MeshEdge edge;
    edge.from_mm = position(ends.first);
    edge.to_mm = position(ends.second);
    edge.border = sides.size() != 2;
    edge.triangle_a = sides.front().triangle;
    edge.triangle_b = edge.border ? edge.triangle_a : sides[1].triangle;
    // Triangles wound alike run through their edge in opposite directions.
    edge.turned = !edge.border && sides[0].forward == sides[1].forward;
    const Eigen::Vector3d& normal_a = normals[edge.triangle_a];
    const Eigen::Vector3d normal_b = (edge.turned ? -1.0 : 1.0) * normals[edge.triangle_b];
    edge.normal_a = normal_a.cast<float>();
    edge.normal_b = normal_b.cast<float>();
    const double cosine = normal_a.dot(normal_b);
    edge.smooth = !edge.border && cosine > kSmoothCosine;
    // Edges inside a flat face can never be seen.
    if (!edge.border && cosine > 1.0 - 1e-9) return;
    if (!edge.border && cosine < kSharpCosine) sharp.push_back({edges.size(), ends});
    edges.push_back(edge);
  });
  const std::vector<double> line_mm = line_lengths_mm(sharp, edges);
  for (std::size_t i = 0; i < sharp.size(); ++i) {
    MeshEdge& edge = edges[sharp[i].index];
    edge.crease = (edge.to_mm - edge.from_mm).norm() > kCreaseLength * mesh.diameter_mm() ||
                  line_mm[i] > kCreaseLineLength * mesh.diameter_mm();
  }
  return edges;
}

}  // namespace anneal6d
