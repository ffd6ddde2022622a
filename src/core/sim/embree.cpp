#include "embree.h"

#include <cstring>
#include <stdexcept>

#include "packet.h"
#include "ray_cut.h"

namespace field_fusion::core::sim {
namespace {

bool passes(const Part& part, unsigned ray, unsigned instance, unsigned geometry, unsigned primitive) {
  const unsigned drawn = mix(ray ^ mix(instance + mix(geometry + mix(primitive))));
  return static_cast<float>(drawn >> 8) < part.material.transparency * 16777216.f;
}

void letSomePass(const RTCFilterFunctionNArguments* a) {
  const Part& part = *static_cast<const Part*>(a->geometryUserPtr);
  for (unsigned i = 0; i < a->N; ++i)
    if (a->valid[i] && passes(part, RTCRayN_id(a->ray, a->N, i), RTCHitN_instID(a->hit, a->N, i, 0),
                              RTCHitN_geomID(a->hit, a->N, i), RTCHitN_primID(a->hit, a->N, i)))
      a->valid[i] = 0;
}

void cylinderBounds(const RTCBoundsFunctionArguments* a) {
  Model model;
  model.links.push_back({{*static_cast<const Part*>(a->geometryUserPtr)}, {}, -1});
  const Eigen::AlignedBox3f box = model.box().cast<float>();
  const float more = 1e-6f * box.sizes().maxCoeff() + 4e-7f * box.max().cwiseAbs().maxCoeff();
  const Eigen::Vector3f low = box.min().array() - more, high = box.max().array() + more;
  *a->bounds_o = {low.x(), low.y(), low.z(), 0.f, high.x(), high.y(), high.z(), 0.f};
}

Line lineOf(RTCRayN* r, unsigned n, unsigned i) {
  return {{RTCRayN_org_x(r, n, i), RTCRayN_org_y(r, n, i), RTCRayN_org_z(r, n, i)},
          {RTCRayN_dir_x(r, n, i), RTCRayN_dir_y(r, n, i), RTCRayN_dir_z(r, n, i)}};
}

/// Where ray i meets the cylinder before its end; NaN: nowhere.
double meets(const Part& part, RTCRayN* r, unsigned n, unsigned i) {
  const Span s = span(lineOf(r, n, i), std::get<Cylinder>(part.shape));
  const double from = RTCRayN_tnear(r, n, i), to = RTCRayN_tfar(r, n, i);
  if (!(s.enter <= s.leave)) return kNaN;
  if (s.enter > from && s.enter < to) return s.enter;
  return s.leave > from && s.leave < to ? s.leave : kNaN;
}

void cylinderHit(const RTCIntersectFunctionNArguments* a) {
  const Part& part = *static_cast<const Part*>(a->geometryUserPtr);
  RTCRayN* ray = RTCRayHitN_RayN(a->rayhit, a->N);
  RTCHitN* hit = RTCRayHitN_HitN(a->rayhit, a->N);
  const unsigned instance = a->context->instID[0];
  for (unsigned i = 0; i < a->N; ++i) {
    if (!a->valid[i] || passes(part, RTCRayN_id(ray, a->N, i), instance, a->geomID, a->primID)) continue;
    const double t = meets(part, ray, a->N, i);
    if (std::isnan(t)) continue;
    RTCRayN_tfar(ray, a->N, i) = static_cast<float>(t);
    RTCHitN_primID(hit, a->N, i) = a->primID;
    RTCHitN_geomID(hit, a->N, i) = a->geomID;
    RTCHitN_instID(hit, a->N, i, 0) = instance;
  }
}

void cylinderBlocks(const RTCOccludedFunctionNArguments* a) {
  const Part& part = *static_cast<const Part*>(a->geometryUserPtr);
  const unsigned instance = a->context->instID[0];
  for (unsigned i = 0; i < a->N; ++i) {
    if (!a->valid[i] || passes(part, RTCRayN_id(a->ray, a->N, i), instance, a->geomID, a->primID)) continue;
    if (!std::isnan(meets(part, a->ray, a->N, i)))
      RTCRayN_tfar(a->ray, a->N, i) = -std::numeric_limits<float>::infinity();
  }
}

struct Maker {
  RTCDevice device;
  const Part& part;

  Geometry make(RTCGeometryType type) const {
    RTCGeometry g = rtcNewGeometry(device, type);
    rtcSetGeometryUserData(g, const_cast<Part*>(&part));
    return Geometry(g);
  }
  Geometry operator()(const Mesh& mesh) const {
    Geometry g = make(RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(g.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(mesh.vertices[0]), mesh.vertices.size());
    void* triangles = rtcSetNewGeometryBuffer(g.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof(mesh.triangles[0]), mesh.triangles.size());
    checkDevice(device, "making a mesh");
    std::memcpy(vertices, mesh.vertices.data(), mesh.vertices.size() * sizeof(mesh.vertices[0]));
    std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof(mesh.triangles[0]));
    return g;
  }
  Geometry operator()(const Sphere& s) const {
    Geometry g = make(RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* vertex = static_cast<float*>(
        rtcSetNewGeometryBuffer(g.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 1));
    checkDevice(device, "making a sphere");
    Eigen::Map<Eigen::Vector4f>(vertex) << s.centre, s.radius;
    return g;
  }
  Geometry operator()(const Cylinder&) const {
    Geometry g = make(RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(g.get(), 1);
    rtcSetGeometryBoundsFunction(g.get(), cylinderBounds, nullptr);
    rtcSetGeometryIntersectFunction(g.get(), cylinderHit);
    rtcSetGeometryOccludedFunction(g.get(), cylinderBlocks);
    return g;
  }
};

}  // namespace

Device newDevice() {
  // one thread: a tree built by several may differ from run to run, and with it the winner of a tie
  Device device(rtcNewDevice("threads=1"));
  if (!device) throw std::runtime_error("Embree does not start on this machine");
  return device;
}

void checkDevice(RTCDevice device, const char* doing) {
  static constexpr const char* kText[] = {"no error",          "unknown error", "invalid argument",
                                          "invalid operation", "out of memory", "this CPU is not supported",
                                          "cancelled"};
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE)
    throw std::runtime_error(std::string("Embree: ") + doing + ": " + kText[static_cast<int>(error)]);
}

void attach(RTCDevice device, RTCScene scene, unsigned id, const Part& part) {
  const Geometry geometry = std::visit(Maker{device, part}, part.shape);
  if (part.material.transparency > 0.f && !std::holds_alternative<Cylinder>(part.shape)) {
    rtcSetGeometryIntersectFilterFunction(geometry.get(), letSomePass);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), letSomePass);
  }
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(scene, geometry.get(), id);
}

}  // namespace field_fusion::core::sim
