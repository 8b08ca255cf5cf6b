// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "raster_kernels.h"

// Vectors are members of structs here, which those without a fixed size can't be.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster_triangles.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

#include <bit>
#include <cmath>

#include "anneal6d/framework/shading.h"
#include "raster_fill-inl.h"

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

struct Corner {
  ImageVertex vertex;
  TexturePoint texture;
};

template <bool kTextured>
HWY_INLINE Corner CornerOf(const TriangleJob& job, std::uint32_t vertex) {
  return {job.vertices[vertex], kTextured ? job.texture_points[vertex] : TexturePoint{}};
}

template <bool kTextured>
HWY_INLINE void Append(Batch& batch, const Corner& a, const Corner& b, const Corner& c) {
  int k = 0;
  for (const Corner* corner : {&a, &b, &c}) {
    batch.vertex[k][batch.count] = corner->vertex;
    if constexpr (kTextured) batch.texture[k][batch.count] = corner->texture;
    ++k;
  }
  ++batch.count;
}

/// Cuts the part of a triangle before the near plane out and appends what remains of it.
template <bool kTextured>
void AppendClipped(const TriangleJob& job, const Triangle& t, Batch& batch) {
  constexpr float near = static_cast<float>(kNearPlane_mm);
  // Everything but x and y is carried in camera space, where it is linear along an edge.
  Corner polygon[4];
  int count = 0;
  for (int c = 0; c < 3; ++c) {
    const std::uint32_t p = t[c], q = t[(c + 1) % 3];
    const float zp = job.camera_z[p], zq = job.camera_z[q];
    if (zp >= near) polygon[count++] = CornerOf<kTextured>(job, p);
    if ((zp >= near) == (zq >= near)) continue;
    const float s = (near - zp) / (zq - zp);
    const Corner cp = CornerOf<kTextured>(job, p), cq = CornerOf<kTextured>(job, q);
    // Undo the projection of both ends (z may be negative, but not zero: it is then no finite pixel
    // and the triangle is thin air), cut, and project again.
    const auto mixed = [&](float vp, float vq) { return vp + s * (vq - vp); };
    const auto lateral = [&](float pixel, float centre, float z) { return (pixel - centre) * z; };
    Corner cut;
    cut.vertex.x =
        mixed(lateral(cp.vertex.x, job.cx, zp), lateral(cq.vertex.x, job.cx, zq)) / near + job.cx;
    cut.vertex.y =
        mixed(lateral(cp.vertex.y, job.cy, zp), lateral(cq.vertex.y, job.cy, zq)) / near + job.cy;
    cut.vertex.depth = (1.0F / near - job.inv_far) * job.depth_scale + kFarDepth;
    cut.vertex.grey = mixed(cp.vertex.grey, cq.vertex.grey);
    cut.texture.u_over_z = mixed(cp.texture.u_over_z * zp, cq.texture.u_over_z * zq) / near;
    cut.texture.v_over_z = mixed(cp.texture.v_over_z * zp, cq.texture.v_over_z * zq) / near;
    if (!std::isfinite(cut.vertex.x) || !std::isfinite(cut.vertex.y)) return;
    polygon[count++] = cut;
  }
  for (int i = 2; i < count; ++i) {
    Append<kTextured>(batch, polygon[0], polygon[i - 1], polygon[i]);
  }
}

template <bool kTextured>
void DrawAll(const TriangleJob& job) {
  const RasterModel& m = *job.model;
  // Where the near plane cuts a closed surface open, one looks at its inner side.
  const bool cull = !job.clip;
  const std::size_t lanes = hn::Lanes(f);
  Batch batch;
  for (std::size_t first = 0; first < m.triangles.size(); first += lanes) {
    auto facing = hn::FirstN(f, m.triangles.size() - first);
    if (cull) {
      // In the object frame, where planes lie in sequence: no corner needs to be fetched.
      const VF height = hn::MulAdd(
          hn::LoadU(f, &m.plane_x[first]), hn::Set(f, job.eye_mm[0]),
          hn::MulAdd(hn::LoadU(f, &m.plane_y[first]), hn::Set(f, job.eye_mm[1]),
                     hn::Mul(hn::LoadU(f, &m.plane_z[first]), hn::Set(f, job.eye_mm[2]))));
      facing = hn::And(facing, hn::Gt(height, hn::LoadU(f, &m.plane_mm[first])));
    }
    for (std::uint64_t bits = BitsOf(facing); bits; bits &= bits - 1) {
      const Triangle& t = m.triangles[first + static_cast<std::size_t>(std::countr_zero(bits))];
      if (job.clip) {
        constexpr float near = static_cast<float>(kNearPlane_mm);
        const bool behind[] = {job.camera_z[t[0]] < near, job.camera_z[t[1]] < near,
                               job.camera_z[t[2]] < near};
        if (behind[0] && behind[1] && behind[2]) continue;
        if (behind[0] || behind[1] || behind[2]) {
          AppendClipped<kTextured>(job, t, batch);
          continue;
        }
      }
      Append<kTextured>(batch, CornerOf<kTextured>(job, t[0]), CornerOf<kTextured>(job, t[1]),
                        CornerOf<kTextured>(job, t[2]));
    }
    if (batch.count + 2 * lanes > Batch::kCapacity) DrawBatch<kTextured>(job, batch);
  }
  DrawBatch<kTextured>(job, batch);
}

void DrawTriangles(const TriangleJob& job) {
  if (job.texture) {
    DrawAll<true>(job);
  } else {
    DrawAll<false>(job);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace anneal6d {

HWY_EXPORT(DrawTriangles);
void draw_triangles(const TriangleJob& job) { HWY_DYNAMIC_DISPATCH(DrawTriangles)(job); }

}  // namespace anneal6d
#endif
