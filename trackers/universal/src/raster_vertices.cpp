// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "raster_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster_vertices.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using VF = hn::Vec<F>;
constexpr F f;

/// a x + b y + c z + d, for whole vectors of x, y, z.
VF Affine(const float* abc, VF x, VF y, VF z, float d) {
  return hn::MulAdd(
      hn::Set(f, abc[0]), x,
      hn::MulAdd(hn::Set(f, abc[1]), y, hn::MulAdd(hn::Set(f, abc[2]), z, hn::Set(f, d))));
}

void ProjectVertices(VertexJob& job) {
  const RasterModel& m = *job.model;
  const std::size_t lanes = hn::Lanes(f);
  const bool textured = !m.u.empty();
  VF min_x = hn::Set(f, 1e30F), max_x = hn::Set(f, -1e30F);
  VF min_y = min_x, max_y = max_x;
  const VF one = hn::Set(f, 1.0F);
  for (std::size_t i = 0; i < m.vertex_count; i += lanes) {
    const VF x = hn::LoadU(f, &m.x[i]), y = hn::LoadU(f, &m.y[i]), z = hn::LoadU(f, &m.z[i]);
    const VF cam_x = Affine(job.rotation, x, y, z, job.translation_mm[0]);
    const VF cam_y = Affine(job.rotation + 3, x, y, z, job.translation_mm[1]);
    const VF cam_z = Affine(job.rotation + 6, x, y, z, job.translation_mm[2]);
    const VF inv_z = hn::Div(one, cam_z);
    const VF image_x = hn::MulAdd(hn::Mul(cam_x, hn::Set(f, job.fx)), inv_z, hn::Set(f, job.cx));
    const VF image_y = hn::MulAdd(hn::Mul(cam_y, hn::Set(f, job.fy)), inv_z, hn::Set(f, job.cy));
    min_x = hn::Min(min_x, image_x);
    max_x = hn::Max(max_x, image_x);
    min_y = hn::Min(min_y, image_y);
    max_y = hn::Max(max_y, image_y);
    const VF depth = hn::MulAdd(hn::Sub(inv_z, hn::Set(f, job.inv_far)),
                                hn::Set(f, job.depth_scale), hn::Set(f, kFarDepth));

    const VF cosine = Affine(job.to_light, hn::LoadU(f, &m.nx[i]), hn::LoadU(f, &m.ny[i]),
                             hn::LoadU(f, &m.nz[i]), 0.0F);
    const VF light =
        hn::Min(one, hn::MulAdd(hn::Abs(cosine), hn::Set(f, job.diffuse), hn::Set(f, job.ambient)));
    const VF grey = hn::Mul(light, hn::LoadU(f, &m.luma[i]));

    hn::StoreInterleaved4(image_x, image_y, depth, grey, f, &job.vertices[i].x);
    hn::StoreU(cam_z, f, job.camera_z + i);
    if (textured) {
      hn::StoreInterleaved2(hn::Mul(hn::LoadU(f, &m.u[i]), inv_z),
                            hn::Mul(hn::LoadU(f, &m.v[i]), inv_z), f,
                            &job.texture_points[i].u_over_z);
    }
  }
  job.min_x = hn::GetLane(hn::MinOfLanes(f, min_x));
  job.max_x = hn::GetLane(hn::MaxOfLanes(f, max_x));
  job.min_y = hn::GetLane(hn::MinOfLanes(f, min_y));
  job.max_y = hn::GetLane(hn::MaxOfLanes(f, max_y));
}

}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace anneal6d {

HWY_EXPORT(ProjectVertices);
void project_vertices(VertexJob& job) { HWY_DYNAMIC_DISPATCH(ProjectVertices)(job); }

}  // namespace anneal6d
#endif
