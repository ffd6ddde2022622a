#include "cylinder_cast.h"

#include <algorithm>

namespace field_fusion::core::sim {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

void bounds(const RTCBoundsFunctionArguments* a) {
  Model model;
  model.links.push_back({{*static_cast<const Part*>(a->geometryUserPtr)}, {}, -1});
  const Eigen::AlignedBox3f box = model.box().cast<float>();
  const float more = 1e-6f * box.sizes().maxCoeff() + 4e-7f * box.max().cwiseAbs().maxCoeff();
  const Eigen::Vector3f low = box.min().array() - more, high = box.max().array() + more;
  *a->bounds_o = {low.x(), low.y(), low.z(), 0.f, high.x(), high.y(), high.z(), 0.f};
}

/// Eight of Embree's rays; those beyond its last are that one again.
struct Rays {
  Lanes<double> x, y, z, dx, dy, dz, near, far;

  Rays(RTCRayN* r, unsigned n, unsigned from) {
    for (unsigned lane = 0; lane < kLanes; ++lane) {
      const unsigned i = std::min(from + lane, n - 1);
      x[lane] = RTCRayN_org_x(r, n, i), y[lane] = RTCRayN_org_y(r, n, i), z[lane] = RTCRayN_org_z(r, n, i);
      dx[lane] = RTCRayN_dir_x(r, n, i), dy[lane] = RTCRayN_dir_y(r, n, i), dz[lane] = RTCRayN_dir_z(r, n, i);
      near[lane] = RTCRayN_tnear(r, n, i), far[lane] = RTCRayN_tfar(r, n, i);
    }
  }
};

/// Where each ray meets the cylinder between its ends; infinite: nowhere.
FIELD_FUSION_LANES void meet(const Cylinder& c, const Rays& r, Lanes<double>& out) {
  const Eigen::Vector3d foot = c.foot.cast<double>(), axis = c.axis.cast<double>();
  const double length = axis.norm(), ux = axis.x() / length, uy = axis.y() / length, uz = axis.z() / length;
  const double square = static_cast<double>(c.radius) * c.radius;
  Lanes<double> t;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double fx = r.x[i] - foot.x(), fy = r.y[i] - foot.y(), fz = r.z[i] - foot.z();
    const double up = ux * fx + uy * fy + uz * fz, rise = ux * r.dx[i] + uy * r.dy[i] + uz * r.dz[i];
    const double px = fx - up * ux, py = fy - up * uy, pz = fz - up * uz;  // across the axis
    const double qx = r.dx[i] - rise * ux, qy = r.dy[i] - rise * uy, qz = r.dz[i] - rise * uz;
    const double a = qx * qx + qy * qy + qz * qz, nearest = -(px * qx + py * qy + pz * qz) / a;
    const double nx = px + nearest * qx, ny = py + nearest * qy, nz = pz + nearest * qz;
    const double half = std::sqrt((square - nx * nx - ny * ny - nz * nz) / a);  // NaN: passes by
    const double always = px * px + py * py + pz * pz <= square ? kFar : kNaN;
    const double side_half = a < 1e-24 ? always : half, side = a < 1e-24 ? 0.0 : nearest;
    const double one = -up / rise, other = (length - up) / rise;
    const double within = (up >= 0.0) & (up <= length) ? kFar : kNaN;
    const double low = rise == 0.0 ? -within : lesser(one, other);
    const double high = rise == 0.0 ? within : greater(one, other);
    const double enter = greater(low, side - side_half), leave = lesser(high, side + side_half);
    const double last = (leave > r.near[i]) & (leave < r.far[i]) ? leave : kFar;
    const double first = (enter > r.near[i]) & (enter < r.far[i]) ? enter : last;
    t[i] = enter <= leave ? first : kFar;
  }
  out = t;
}

/// Calls hit(i, t) for all valid rays that meet the cylinder and do not pass it by chance.
template <class OnHit>
void forHits(const Part& part, const int* valid, RTCRayN* rays, unsigned n, unsigned instance,
             unsigned geometry, unsigned primitive, const OnHit& hit) {
  for (unsigned from = 0; from < n; from += kLanes) {
    Lanes<double> t;
    meet(std::get<Cylinder>(part.shape), Rays(rays, n, from), t);
    for (unsigned i = from; i < n && i < from + kLanes; ++i)
      if (valid[i] && t[i - from] < kFar &&
          !passes(part, RTCRayN_id(rays, n, i), instance, geometry, primitive))
        hit(i, static_cast<float>(t[i - from]));
  }
}

void intersect(const RTCIntersectFunctionNArguments* a) {
  RTCRayN* rays = RTCRayHitN_RayN(a->rayhit, a->N);
  RTCHitN* hits = RTCRayHitN_HitN(a->rayhit, a->N);
  const unsigned instance = a->context->instID[0];
  forHits(*static_cast<const Part*>(a->geometryUserPtr), a->valid, rays, a->N, instance, a->geomID, a->primID,
          [&](unsigned i, float t) {
            RTCRayN_tfar(rays, a->N, i) = t;
            RTCHitN_primID(hits, a->N, i) = a->primID;
            RTCHitN_geomID(hits, a->N, i) = a->geomID;
            RTCHitN_instID(hits, a->N, i, 0) = instance;
          });
}

void occlude(const RTCOccludedFunctionNArguments* a) {
  forHits(*static_cast<const Part*>(a->geometryUserPtr), a->valid, a->ray, a->N, a->context->instID[0],
          a->geomID, a->primID, [&](unsigned i, float) {
            RTCRayN_tfar(a->ray, a->N, i) = -std::numeric_limits<float>::infinity();
          });
}

}  // namespace

void castAsCylinder(RTCGeometry geometry) {
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect);
  rtcSetGeometryOccludedFunction(geometry, occlude);
}

}  // namespace field_fusion::core::sim
