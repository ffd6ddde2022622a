#include "embree.h"

#include <cstring>
#include <stdexcept>

#include "cylinder_cast.h"

namespace field_fusion::core::sim {
namespace {

void letSomePass(const RTCFilterFunctionNArguments* a) {
  const Part& part = *static_cast<const Part*>(a->geometryUserPtr);
  for (unsigned i = 0; i < a->N; ++i)
    if (a->valid[i] && passes(part, RTCRayN_id(a->ray, a->N, i), RTCHitN_instID(a->hit, a->N, i, 0),
                              RTCHitN_geomID(a->hit, a->N, i), RTCHitN_primID(a->hit, a->N, i)))
      a->valid[i] = 0;
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
    castAsCylinder(g.get());
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
