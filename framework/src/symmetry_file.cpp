// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/framework/sequence_folder.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t kMaxSymmetryFileSize = std::size_t{16} << 20;
constexpr double kTolerance = 1e-3;  // of a unit length, of an orthonormal matrix

[[noreturn]] void fail(const fs::path& path, const std::string& place, const std::string& what) {
  throw FileError(path, place, what);
}

bool is_list_of_numbers(const Json& json) {
  return json.is_array() && !json.empty() &&
         std::all_of(json.begin(), json.end(), [](const Json& j) { return j.is_number(); });
}

/// The numbers of [a, b, ...] or [[a, b, ...], ...], row by row; empty for anything else.
std::vector<double> flattened(const Json& json) {
  if (is_list_of_numbers(json)) return json.get<std::vector<double>>();
  if (!json.is_array()) return {};
  std::vector<double> values;
  for (const Json& row : json) {
    if (!is_list_of_numbers(row) || row.size() != json.size()) return {};
    for (const Json& value : row) values.push_back(value.get<double>());
  }
  return values;
}

Eigen::Quaterniond rotation_from(const Json& json, const fs::path& path, const std::string& place) {
  const std::vector<double> values = flattened(json);
  if (values.size() == 4 && json.size() == 4) {
    const Eigen::Quaterniond q(values[0], values[1], values[2], values[3]);
    if (!(std::abs(q.norm() - 1) <= kTolerance)) {
      fail(path, place, "the quaternion [w, x, y, z] should have unit length");
    }
    return q.normalized();
  }
  if (values.size() == 9) {
    const Eigen::Matrix3d r =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values.data());
    if (!((r * r.transpose()).isIdentity(kTolerance) && r.determinant() > 0)) {
      fail(path, place, "the matrix should be a rotation: orthonormal, with determinant 1");
    }
    return Eigen::Quaterniond(r).normalized();
  }
  fail(path, place, "should be a quaternion [w, x, y, z] or a 3x3 matrix");
}

Symmetry symmetry_from(const Json& json, const fs::path& path) {
  const std::string place = "symmetry";
  Symmetry symmetry;
  if (json.is_string() && json == "none") return symmetry;
  if (is_list_of_numbers(json) && json.size() == 3) {
    const std::vector<double> axis = flattened(json);
    symmetry.axis = {axis[0], axis[1], axis[2]};
    const double largest = symmetry.axis.cwiseAbs().maxCoeff();
    if (!(largest > 0)) fail(path, place, "the axis should not be zero");
    symmetry.axis = (symmetry.axis / largest).normalized();
    return symmetry;
  }
  if (!json.is_array() || is_list_of_numbers(json)) {
    fail(path, place, "should be \"none\", an axis [x, y, z] or a list of rotations");
  }
  for (std::size_t i = 0; i < json.size(); ++i) {
    const Eigen::Quaterniond rotation =
        rotation_from(json[i], path, place + "[" + std::to_string(i) + "]");
    // The identity leaves every object as it is: it goes without saying.
    if (std::abs(rotation.w()) < 1 - 1e-9) symmetry.rotations.push_back(rotation);
  }
  return symmetry;
}

}  // namespace

Symmetry load_symmetry(const fs::path& meta_json) {
  const std::string content = read_file(meta_json, kMaxSymmetryFileSize);
  Json meta;
  try {
    meta = Json::parse(content);
  } catch (const Json::parse_error& error) {
    fail(meta_json, "byte " + std::to_string(error.byte), "is no valid JSON");
  } catch (const Json::exception&) {
    fail(meta_json, "", "is no valid JSON: a number is out of range");
  }
  if (!meta.is_object()) fail(meta_json, "", "should be a JSON object, {...}");
  return meta.contains("symmetry") ? symmetry_from(meta["symmetry"], meta_json) : Symmetry{};
}

}  // namespace anneal6d
