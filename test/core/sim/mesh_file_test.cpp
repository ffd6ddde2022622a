#include <gtest/gtest.h>

#include "field_fusion/core/sim/shapes.h"
#include "support/temp_folder.h"

namespace field_fusion::core::sim {
namespace {

const char* const kTetrahedron = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST(MeshFile, ObjIsReadAndScaled) {
  const field_fusion::test::TempFolder folder;
  const Mesh mesh = loadMesh(folder.write("a.obj", kTetrahedron).string(), 2.0);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  Model model;
  model.links.push_back({{{mesh, {}}}, {}, -1});
  EXPECT_TRUE(model.box().sizes().isApprox(Eigen::Vector3d(2, 4, 6)));
}

TEST(MeshFile, PlyIsRead) {
  const field_fusion::test::TempFolder folder;
  const auto file =
      folder.write("a.ply",
                   "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                   "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                   "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
  EXPECT_EQ(loadMesh(file.string()).triangles.size(), 2u) << "a square is two triangles";
}

/// A triangle of 100, 200 and 300 cm along x, y and z, moved by 1000 cm along x.
const char* const kCollada = R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="pa" count="9">100 0 0 0 200 0 0 0 300</float_array><technique_common>
      <accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
      <param name="Z" type="float"/></accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s"><node id="n"><translate>1000 0 0</translate>
    <instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>)";

TEST(MeshFile, ColladaIsReadInMetresWithItsAxes) {
  const field_fusion::test::TempFolder folder;
  const Mesh mesh = loadMesh(folder.write("a.dae", kCollada).string());
  ASSERT_EQ(mesh.triangles.size(), 1u);
  Eigen::AlignedBox3f box;
  for (const auto& vertex : mesh.vertices) box.extend(vertex);
  EXPECT_TRUE(box.min().isApprox(Eigen::Vector3f(10, 0, 0), 1e-5f)) << box.min().transpose();
  EXPECT_TRUE(box.max().isApprox(Eigen::Vector3f(11, 2, 3), 1e-5f)) << box.max().transpose();
}

std::string faultOf(const std::string& file) {
  try {
    loadMesh(file);
  } catch (const std::runtime_error& fault) {
    return fault.what();
  }
  return "";
}

TEST(MeshFile, FaultsNameTheFile) {
  const field_fusion::test::TempFolder folder;
  EXPECT_NE(faultOf("/nowhere/cage.obj").find("/nowhere/cage.obj"), std::string::npos);
  for (const char* text : {"", "v 0 0 0\nv 1 0 0\nl 1 2\n", "this is no mesh\n",
                           "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}) {
    const std::string file = folder.write("bad.obj", text).string();
    EXPECT_NE(faultOf(file).find(file), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace field_fusion::core::sim
