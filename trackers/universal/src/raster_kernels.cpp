// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "raster_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "anneal6d/framework/shading.h"

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using I = hn::RebindToSigned<F>;
using U = hn::RebindToUnsigned<F>;
using VF = hn::Vec<F>;
constexpr F f;
constexpr I si;
constexpr U ui;

void ProjectVertices(VertexJob& job) {
  const RasterModel& m = *job.model;
  const std::size_t lanes = hn::Lanes(f);
  const float* const r = job.rotation;
  VF min_x = hn::Set(f, 1e30F), max_x = hn::Set(f, -1e30F);
  VF min_y = min_x, max_y = max_x;
  const VF one = hn::Set(f, 1.0F);
  for (std::size_t i = 0; i < m.vertex_count; i += lanes) {
    const VF x = hn::LoadU(f, &m.x[i]), y = hn::LoadU(f, &m.y[i]), z = hn::LoadU(f, &m.z[i]);
    const auto row = [&](int k, VF a, VF b, VF c, VF offset) {
      return hn::MulAdd(
          hn::Set(f, r[k]), a,
          hn::MulAdd(hn::Set(f, r[k + 1]), b, hn::MulAdd(hn::Set(f, r[k + 2]), c, offset)));
    };
    const VF cam_x = row(0, x, y, z, hn::Set(f, job.translation_mm[0]));
    const VF cam_y = row(3, x, y, z, hn::Set(f, job.translation_mm[1]));
    const VF cam_z = row(6, x, y, z, hn::Set(f, job.translation_mm[2]));
    const VF inv_z = hn::Div(one, cam_z);
    const VF image_x = hn::MulAdd(hn::Mul(cam_x, hn::Set(f, job.fx)), inv_z, hn::Set(f, job.cx));
    const VF image_y = hn::MulAdd(hn::Mul(cam_y, hn::Set(f, job.fy)), inv_z, hn::Set(f, job.cy));
    min_x = hn::Min(min_x, image_x);
    max_x = hn::Max(max_x, image_x);
    min_y = hn::Min(min_y, image_y);
    max_y = hn::Max(max_y, image_y);
    hn::StoreU(image_x, f, job.image_x + i);
    hn::StoreU(image_y, f, job.image_y + i);
    hn::StoreU(cam_z, f, job.camera_z + i);
    hn::StoreU(
        hn::MulAdd(hn::Sub(inv_z, hn::Set(f, job.inv_far)), hn::Set(f, job.depth_scale), one), f,
        job.depth + i);

    // The light in object coordinates would save the rotation of normals, but the normals' products
    // are as cheap.
    const VF nx = hn::LoadU(f, &m.nx[i]), ny = hn::LoadU(f, &m.ny[i]), nz = hn::LoadU(f, &m.nz[i]);
    const VF zero = hn::Zero(f);
    const VF cosine =
        hn::MulAdd(hn::Set(f, job.to_light[0]), row(0, nx, ny, nz, zero),
                   hn::MulAdd(hn::Set(f, job.to_light[1]), row(3, nx, ny, nz, zero),
                              hn::Mul(hn::Set(f, job.to_light[2]), row(6, nx, ny, nz, zero))));
    const VF light =
        hn::Min(one, hn::MulAdd(hn::Abs(cosine), hn::Set(f, job.diffuse), hn::Set(f, job.ambient)));
    hn::StoreU(hn::Mul(light, hn::LoadU(f, &m.luma[i])), f, job.grey + i);
    if (!m.u.empty()) {
      hn::StoreU(hn::Mul(hn::LoadU(f, &m.u[i]), inv_z), f, job.u_over_z + i);
      hn::StoreU(hn::Mul(hn::LoadU(f, &m.v[i]), inv_z), f, job.v_over_z + i);
    }
  }
  job.min_x = hn::GetLane(hn::MinOfLanes(f, min_x));
  job.max_x = hn::GetLane(hn::MaxOfLanes(f, max_x));
  job.min_y = hn::GetLane(hn::MinOfLanes(f, min_y));
  job.max_y = hn::GetLane(hn::MaxOfLanes(f, max_y));
}

struct Corner {
  float x, y, depth, grey, u_over_z, v_over_z;
};

/// A quantity that is linear in the image: value at the first corner and its slopes.
struct Plane {
  float value, dx, dy;

  Plane(float a, float b, float c, const Corner& pa, const Corner& pb, const Corner& pc,
        float inv_area)
      : value(a),
        dx(((b - a) * (pc.y - pa.y) - (c - a) * (pb.y - pa.y)) * inv_area),
        dy(((c - a) * (pb.x - pa.x) - (b - a) * (pc.x - pa.x)) * inv_area) {}
};

/// Bilinear texture brightness at texture coordinates u, v with repeat.
VF SampleTexture(const QuadTexture& texture, VF u, VF v) {
  const auto wrap = [](VF t, int size, hn::Vec<I>& cell, VF& fraction) {
    const VF extent = hn::Set(f, static_cast<float>(size));
    const VF position = hn::MulSub(hn::Sub(t, hn::Floor(t)), extent, hn::Set(f, 0.5F));
    const VF floor = hn::Floor(position);
    fraction = hn::Sub(position, floor);
    const auto index = hn::ConvertTo(si, floor);
    const auto wrapped = hn::IfThenElse(hn::Lt(index, hn::Zero(si)), hn::Set(si, size - 1), index);
    cell = hn::Min(wrapped, hn::Set(si, size - 1));
  };
  hn::Vec<I> column, row;
  VF across, down;
  wrap(u, texture.width, column, across);
  wrap(v, texture.height, row, down);
  const auto index = hn::Add(hn::Mul(row, hn::Set(si, texture.width)), column);
  const auto quad = hn::GatherIndex(ui, texture.quads.data(), index);
  const auto byte = hn::Set(ui, 0xFF);
  const auto texel = [&](auto bits) {
    return hn::ConvertTo(f, hn::BitCast(si, hn::And(bits, byte)));
  };
  const VF t00 = texel(quad), t10 = texel(hn::ShiftRight<8>(quad));
  const VF t01 = texel(hn::ShiftRight<16>(quad)), t11 = texel(hn::ShiftRight<24>(quad));
  const VF upper = hn::MulAdd(hn::Sub(t10, t00), across, t00);
  const VF lower = hn::MulAdd(hn::Sub(t11, t01), across, t01);
  return hn::MulAdd(hn::Sub(lower, upper), down, upper);
}

template <bool kTextured>
void DrawTriangle(const DrawJob& job, const Corner& a, const Corner& b, const Corner& c) {
  const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (!(std::abs(area) > 1e-12F)) return;

  // Scan conversion: a pixel is drawn if its centre is inside, or on a left or upper border. An
  // edge is always followed from its upper end, so that neighbours agree on it to the last bit.
  const Corner *top = &a, *middle = &b, *bottom = &c;
  if (top->y > middle->y) std::swap(top, middle);
  if (middle->y > bottom->y) std::swap(middle, bottom);
  if (top->y > middle->y) std::swap(top, middle);
  const int y_begin = static_cast<int>(std::ceil(std::max(top->y, static_cast<float>(job.y0))));
  const int y_end = static_cast<int>(std::ceil(std::min(bottom->y, static_cast<float>(job.y1))));
  if (y_begin >= y_end) return;
  const float left_limit = static_cast<float>(job.x0), right_limit = static_cast<float>(job.x1);
  const auto slope = [](const Corner& p, const Corner& q) { return (q.x - p.x) / (q.y - p.y); };
  const float long_slope = slope(*top, *bottom);
  const float upper_slope = middle->y > top->y ? slope(*top, *middle) : 0.0F;
  const float lower_slope = bottom->y > middle->y ? slope(*middle, *bottom) : 0.0F;

  const float inv_area = 1.0F / area;
  const Plane depth(a.depth, b.depth, c.depth, a, b, c, inv_area);
  const Plane grey(a.grey, b.grey, c.grey, a, b, c, inv_area);
  const Plane u(a.u_over_z, b.u_over_z, c.u_over_z, a, b, c, inv_area);
  const Plane v(a.v_over_z, b.v_over_z, c.v_over_z, a, b, c, inv_area);

  const int lanes = static_cast<int>(hn::Lanes(f));
  const VF ramp = hn::Iota(f, 0.0F);
  for (int y = y_begin; y < y_end; ++y) {
    const float row = static_cast<float>(y);
    const float long_x = top->x + (row - top->y) * long_slope;
    const float short_x = row < middle->y ? top->x + (row - top->y) * upper_slope
                                          : middle->x + (row - middle->y) * lower_slope;
    const int begin = static_cast<int>(std::ceil(std::max(std::min(long_x, short_x), left_limit)));
    const int end = static_cast<int>(std::ceil(std::min(std::max(long_x, short_x), right_limit)));
    if (begin >= end) continue;

    const float dy = row - a.y;
    std::uint32_t* const line =
        job.pixels + static_cast<std::ptrdiff_t>(y - job.y0) * job.stride - job.x0;
    for (int x = begin; x < end; x += lanes) {
      const VF dx = hn::Add(ramp, hn::Set(f, static_cast<float>(x) - a.x));
      const auto at = [&](const Plane& plane) {
        return hn::MulAdd(dx, hn::Set(f, plane.dx), hn::Set(f, plane.value + dy * plane.dy));
      };
      const VF stored = at(depth);
      VF brightness = at(grey);
      if constexpr (kTextured) {
        const VF inv_z = hn::MulAdd(hn::Sub(stored, hn::Set(f, 1.0F)),
                                    hn::Set(f, 1.0F / job.depth_scale), hn::Set(f, job.inv_far));
        const VF z_mm = hn::Div(hn::Set(f, 1.0F), inv_z);
        brightness = hn::Mul(
            brightness, SampleTexture(*job.texture, hn::Mul(at(u), z_mm), hn::Mul(at(v), z_mm)));
      }
      const auto clamped = [&](VF value, float low, float high) {
        return hn::BitCast(
            ui, hn::ConvertTo(si, hn::Min(hn::Max(value, hn::Set(f, low)), hn::Set(f, high))));
      };
      const auto packed = hn::Or(hn::ShiftLeft<8>(clamped(stored, 1.0F, kMaxDepth)),
                                 clamped(hn::Add(brightness, hn::Set(f, 0.5F)), 0.0F, 255.0F));
      const auto inside = hn::FirstN(ui, static_cast<std::size_t>(end - x));
      hn::StoreU(hn::Max(hn::LoadU(ui, line + x), hn::IfThenElseZero(inside, packed)), ui,
                 line + x);
    }
  }
}

/// Cuts the part of a triangle before the near plane out and draws what remains of it.
template <bool kTextured>
void DrawClipped(const DrawJob& job, const Triangle& t) {
  constexpr float near = static_cast<float>(kNearPlane_mm);
  const auto corner = [&](std::uint32_t i) {
    return Corner{job.image_x[i],
                  job.image_y[i],
                  job.depth[i],
                  job.grey[i],
                  kTextured ? job.u_over_z[i] : 0.0F,
                  kTextured ? job.v_over_z[i] : 0.0F};
  };
  // Everything but x and y is carried in camera space, where it is linear along an edge.
  Corner polygon[4];
  int count = 0;
  for (int c = 0; c < 3; ++c) {
    const std::uint32_t p = t[c], q = t[(c + 1) % 3];
    const float zp = job.camera_z[p], zq = job.camera_z[q];
    if (zp >= near) polygon[count++] = corner(p);
    if ((zp >= near) == (zq >= near)) continue;
    const float s = (near - zp) / (zq - zp);
    const Corner cp = corner(p), cq = corner(q);
    // Undo the projection of both ends (z may be negative, but not zero: it is then no finite pixel
    // and the triangle is thin air), cut, and project again.
    const auto mixed = [&](float vp, float vq) { return vp + s * (vq - vp); };
    const auto lateral = [&](float pixel, float centre, float z) { return (pixel - centre) * z; };
    Corner cut;
    cut.x = mixed(lateral(cp.x, job.cx, zp), lateral(cq.x, job.cx, zq)) / near + job.cx;
    cut.y = mixed(lateral(cp.y, job.cy, zp), lateral(cq.y, job.cy, zq)) / near + job.cy;
    cut.depth = (1.0F / near - job.inv_far) * job.depth_scale + 1.0F;
    cut.grey = mixed(cp.grey, cq.grey);
    cut.u_over_z = mixed(cp.u_over_z * zp, cq.u_over_z * zq) / near;
    cut.v_over_z = mixed(cp.v_over_z * zp, cq.v_over_z * zq) / near;
    if (!std::isfinite(cut.x) || !std::isfinite(cut.y)) return;
    polygon[count++] = cut;
  }
  for (int i = 2; i < count; ++i)
    DrawTriangle<kTextured>(job, polygon[0], polygon[i - 1], polygon[i]);
}

template <bool kTextured>
void DrawAll(const DrawJob& job) {
  const RasterModel& m = *job.model;
  const float right = static_cast<float>(job.x1 - 1), below = static_cast<float>(job.y1 - 1);
  const float left = static_cast<float>(job.x0), above = static_cast<float>(job.y0);
  const bool cull = m.closed && !job.clip;
  for (const Triangle& t : m.triangles) {
    const std::uint32_t i = t[0], j = t[1], k = t[2];
    if (job.clip) {
      constexpr float near = static_cast<float>(kNearPlane_mm);
      const int behind =
          (job.camera_z[i] < near) + (job.camera_z[j] < near) + (job.camera_z[k] < near);
      if (behind == 3) continue;
      if (behind > 0) {
        DrawClipped<kTextured>(job, t);
        continue;
      }
    }
    const float xi = job.image_x[i], xj = job.image_x[j], xk = job.image_x[k];
    const float yi = job.image_y[i], yj = job.image_y[j], yk = job.image_y[k];
    if (cull) {
      // Seen from outside, with y down, outward faces run clockwise: their area is negative.
      const float area = (xj - xi) * (yk - yi) - (xk - xi) * (yj - yi);
      if (area * static_cast<float>(m.winding) >= 0.0F) continue;
    }
    const float min_x = std::min({xi, xj, xk}), max_x = std::max({xi, xj, xk});
    const float min_y = std::min({yi, yj, yk}), max_y = std::max({yi, yj, yk});
    if (max_x < left || min_x > right || max_y < above || min_y > below) continue;
    // Small triangles often lie between the pixels' centres.
    if (std::ceil(min_x) >= max_x || std::ceil(min_y) >= max_y) continue;
    const auto corner = [&](std::uint32_t n) {
      return Corner{job.image_x[n],
                    job.image_y[n],
                    job.depth[n],
                    job.grey[n],
                    kTextured ? job.u_over_z[n] : 0.0F,
                    kTextured ? job.v_over_z[n] : 0.0F};
    };
    DrawTriangle<kTextured>(job, corner(i), corner(j), corner(k));
  }
}

void DrawTriangles(const DrawJob& job) {
  if (job.texture) {
    DrawAll<true>(job);
  } else {
    DrawAll<false>(job);
  }
}

void TakeRow(std::uint32_t* pixels, int width, std::uint16_t* row) {
  const hn::Rebind<std::uint16_t, I> narrow;
  const auto byte = hn::Set(ui, 0xFF);
  const int lanes = static_cast<int>(hn::Lanes(ui));
  for (int x = 0; x < width; x += lanes) {
    const auto brightness = hn::And(hn::LoadU(ui, pixels + x), byte);
    hn::StoreU(hn::DemoteTo(narrow, hn::BitCast(si, brightness)), narrow, row + x);
    hn::StoreU(hn::Zero(ui), ui, pixels + x);
  }
}

void FindEdgeRow(const EdgeRowJob& job) {
  const hn::ScalableTag<std::int16_t> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto load = [&](const std::uint16_t* p) {
    return hn::LoadU(d, reinterpret_cast<const std::int16_t*>(p));
  };
  const auto threshold = hn::Set(d, static_cast<std::int16_t>(job.threshold));
  const bool sobel = job.center_weight == 2;
  const auto weighted = [&](auto side1, auto centre, auto side2) {
    const auto middle = sobel ? hn::Add(centre, centre) : centre;
    return hn::Add(hn::Add(side1, side2), middle);
  };
  auto* const bytes = reinterpret_cast<std::uint8_t*>(job.bits);
  const int words = (job.width + 63) / 64;
  for (int x = 0; x < words * 64; x += lanes) {
    const auto a0 = load(job.above + x - 1), a1 = load(job.above + x), a2 = load(job.above + x + 1);
    const auto h0 = load(job.here + x - 1), h2 = load(job.here + x + 1);
    const auto b0 = load(job.below + x - 1), b1 = load(job.below + x), b2 = load(job.below + x + 1);
    const auto gx = hn::Sub(weighted(a2, h2, b2), weighted(a0, h0, b0));
    const auto gy = hn::Sub(weighted(b0, b1, b2), weighted(a0, a1, a2));
    const auto edge = hn::Gt(hn::Max(hn::Abs(gx), hn::Abs(gy)), threshold);
    if (lanes >= 8) {
      hn::StoreMaskBits(d, edge, bytes + x / 8);
    } else {
      std::uint8_t few = 0;
      hn::StoreMaskBits(d, edge, &few);
      std::uint8_t& byte = bytes[x / 8];
      byte = static_cast<std::uint8_t>((x % 8 ? byte : 0) | few << (x % 8));
    }
  }
  if (job.width % 64) job.bits[words - 1] &= ~std::uint64_t{0} >> (64 - job.width % 64);
}

}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace anneal6d {

HWY_EXPORT(ProjectVertices);
HWY_EXPORT(DrawTriangles);
HWY_EXPORT(TakeRow);
HWY_EXPORT(FindEdgeRow);

void project_vertices(VertexJob& job) { HWY_DYNAMIC_DISPATCH(ProjectVertices)(job); }
void draw_triangles(const DrawJob& job) { HWY_DYNAMIC_DISPATCH(DrawTriangles)(job); }
void take_row(std::uint32_t* pixels, int width, std::uint16_t* row) {
  HWY_DYNAMIC_DISPATCH(TakeRow)(pixels, width, row);
}
void find_edge_row(const EdgeRowJob& job) { HWY_DYNAMIC_DISPATCH(FindEdgeRow)(job); }

}  // namespace anneal6d
#endif
