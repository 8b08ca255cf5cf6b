// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "raster_kernels.h"

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
HWY_INLINE void Append(Batch& batch, const Corner& a, const Corner& b, const Corner& c,
                       const Corner& d) {
  int k = 0;
  for (const Corner* corner : {&a, &b, &c, &d}) {
    batch.vertex[k][batch.count] = corner->vertex;
    if constexpr (kTextured) batch.texture[k][batch.count] = corner->texture;
    ++k;
  }
  ++batch.count;
}

template <bool kTextured>
HWY_INLINE void AppendWhole(const TriangleJob& job, const Face& face, Batch& batch) {
  const auto& [a, b, c, d] = face.corners;
  Append<kTextured>(batch, CornerOf<kTextured>(job, a), CornerOf<kTextured>(job, b),
                    CornerOf<kTextured>(job, c), CornerOf<kTextured>(job, d));
}

/// Entries of a batch that a face may take where the near plane cuts it: two a triangle.
constexpr std::size_t kMostOfAFace = 4;

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
    Append<kTextured>(batch, polygon[0], polygon[i - 1], polygon[i], polygon[i]);
  }
}

/// Appends what is before the near plane of a face, if anything.
template <bool kTextured>
void AppendBeforeNearPlane(const TriangleJob& job, const Face& face, Batch& batch) {
  const auto& [a, b, c, d] = face.corners;
  int before = 0;
  for (const std::uint32_t corner : face.corners) {
    before += job.camera_z[corner] >= static_cast<float>(kNearPlane_mm);
  }
  if (before == 4) {
    AppendWhole<kTextured>(job, face, batch);
  } else if (before > 0) {
    AppendClipped<kTextured>(job, {a, b, c}, batch);
    if (face.is_pair()) AppendClipped<kTextured>(job, {a, c, d}, batch);
  }
}

template <bool kTextured>
void DrawAll(const TriangleJob& job) {
  const RasterModel& m = *job.model;
  // Where the near plane cuts a closed surface open, one looks at its inner side.
  const bool cull = !job.clip;
  const std::size_t lanes = hn::Lanes(f);
  const std::size_t most = (job.clip ? kMostOfAFace : 1) * lanes;  // that a vector of faces appends
  Batch batch;
  for (std::size_t first = 0; first < m.faces.size(); first += lanes) {
    auto facing = hn::FirstN(f, m.faces.size() - first);
    if (cull) {
      // In the object frame, where planes lie in sequence: no corner needs to be fetched.
      const VF height = hn::MulAdd(
          hn::LoadU(f, &m.plane_x[first]), hn::Set(f, job.eye_mm[0]),
          hn::MulAdd(hn::LoadU(f, &m.plane_y[first]), hn::Set(f, job.eye_mm[1]),
                     hn::Mul(hn::LoadU(f, &m.plane_z[first]), hn::Set(f, job.eye_mm[2]))));
      facing = hn::And(facing, hn::Gt(height, hn::LoadU(f, &m.plane_mm[first])));
    }
    for (std::uint64_t bits = BitsOf(facing); bits; bits &= bits - 1) {
      const Face& face = m.faces[first + static_cast<std::size_t>(std::countr_zero(bits))];
      if (job.clip) {
        AppendBeforeNearPlane<kTextured>(job, face, batch);
      } else {
        AppendWhole<kTextured>(job, face, batch);
      }
    }
    if (batch.count + most > Batch::kCapacity) DrawBatch<kTextured>(job, batch);
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
