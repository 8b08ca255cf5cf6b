// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "view_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "fnv_hash.h"

namespace anneal6d {
namespace {

constexpr std::uint32_t kMagic = 0x66763941;  // "A9vf", lowest byte first
constexpr double kSpan = 1.25;                // of the radius: where points can lie
constexpr double kUnit = 32767.0;

/// Fixed-size numbers, one after the other.
class Writer {
 public:
  template <class Number>
  void put(Number number) {
    static_assert(std::is_trivially_copyable_v<Number>);
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    bytes_.append(raw, sizeof number);
  }
  void put_fraction(double value) {
    put(static_cast<std::int16_t>(std::lround(std::clamp(value, -1.0, 1.0) * kUnit)));
  }
  void put_byte(double value) {
    put(static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255.0)));
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  /// Zero behind the end.
  template <class Number>
  Number get() {
    Number number{};
    const std::size_t size = std::min(bytes_.size(), sizeof number);
    std::memcpy(&number, bytes_.data(), size);
    bytes_.remove_prefix(size);
    return number;
  }
  double get_fraction() { return get<std::int16_t>() / kUnit; }
  double get_byte() { return get<std::uint8_t>() / 255.0; }
  std::string_view left() const { return bytes_; }

 private:
  std::string_view bytes_;
};

std::uint64_t hash_of(std::string_view bytes) {
  FnvHash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.value();
}

/// Around the object: what places and lengths are fractions of.
struct Ball {
  Eigen::Vector3d center_mm;
  double radius_mm;

  double span_mm() const { return kSpan * radius_mm; }
  double farthest_mm() const { return 0.5 * radius_mm; }  // of inside and outside
};

void put_sample(Writer& writer, const ContourSample& sample, const Ball& ball) {
  const Eigen::Vector3d place = (sample.object_mm.cast<double>() - ball.center_mm) / ball.span_mm();
  for (const double value : {place.x(), place.y(), place.z()}) writer.put_fraction(value);
  for (int i = 0; i < 3; ++i) writer.put_fraction(sample.normal[i]);
  writer.put_fraction(sample.curve_mm / ball.radius_mm);
  writer.put_byte(sample.inside_mm / ball.farthest_mm());
  writer.put_byte(sample.outside_mm / ball.farthest_mm());
  writer.put_fraction(sample.shift_px / 4.0);
  writer.put_byte(sample.trust);
  writer.put(static_cast<std::uint8_t>((sample.polarity + 1) * 2 + (sample.silhouette ? 1 : 0)));
}

ContourSample get_sample(Reader& reader, const Ball& ball) {
  ContourSample sample;
  for (int i = 0; i < 3; ++i) {
    sample.object_mm[i] =
        static_cast<float>(ball.center_mm[i] + reader.get_fraction() * ball.span_mm());
  }
  for (int i = 0; i < 3; ++i) sample.normal[i] = static_cast<float>(reader.get_fraction());
  sample.normal.normalize();
  sample.curve_mm = static_cast<float>(reader.get_fraction() * ball.radius_mm);
  sample.inside_mm = static_cast<float>(reader.get_byte() * ball.farthest_mm());
  sample.outside_mm = static_cast<float>(reader.get_byte() * ball.farthest_mm());
  sample.shift_px = static_cast<float>(reader.get_fraction() * 4.0);
  sample.trust = static_cast<float>(reader.get_byte());
  const int flags = reader.get<std::uint8_t>();
  sample.silhouette = flags % 2 != 0;
  sample.polarity = flags / 2 - 1;
  return sample;
}

}  // namespace

std::string pack_views(const std::vector<ModelView>& views, ViewKey key,
                       const Eigen::Vector3d& center_mm, double radius_mm) {
  const Ball ball{center_mm, radius_mm};
  Writer writer;
  for (const ModelView& view : views) {
    writer.put(static_cast<std::uint16_t>(view.contour.size()));
    writer.put(static_cast<std::uint16_t>(view.edges));
    writer.put(view.edge_px);
    for (const ContourSample& sample : view.contour) put_sample(writer, sample, ball);
    for (std::size_t i = 0; i < static_cast<std::size_t>(view.edges); ++i) {
      writer.put_fraction((view.edge_x[i] - center_mm.x()) / ball.span_mm());
      writer.put_fraction((view.edge_y[i] - center_mm.y()) / ball.span_mm());
      writer.put_fraction((view.edge_z[i] - center_mm.z()) / ball.span_mm());
    }
  }
  const std::string body = writer.take();
  Writer whole;
  whole.put(kMagic);
  whole.put(key);
  whole.put(hash_of(body));
  return whole.take() + body;
}

std::optional<std::vector<ModelView>> unpack_views(std::string_view bytes, ViewKey key,
                                                   const Eigen::Vector3d& center_mm,
                                                   double radius_mm) {
  const Ball ball{center_mm, radius_mm};
  Reader reader(bytes);
  if (reader.get<std::uint32_t>() != kMagic || reader.get<ViewKey>() != key ||
      reader.get<std::uint64_t>() != hash_of(reader.left())) {
    return std::nullopt;
  }
  std::vector<ModelView> views(ViewModel::kViews);
  for (ModelView& view : views) {
    const std::size_t samples = reader.get<std::uint16_t>();
    const std::size_t edges = reader.get<std::uint16_t>();
    view.edge_px = reader.get<float>();
    for (std::size_t i = 0; i < samples; ++i) view.contour.push_back(get_sample(reader, ball));
    for (std::size_t i = 0; i < edges; ++i) {
      const auto coordinate = [&](double center) {
        return static_cast<float>(center + reader.get_fraction() * ball.span_mm());
      };
      view.edge_x.push_back(coordinate(center_mm.x()));
      view.edge_y.push_back(coordinate(center_mm.y()));
      view.edge_z.push_back(coordinate(center_mm.z()));
    }
    view.pad_edges();
  }
  return views;
}

}  // namespace anneal6d
