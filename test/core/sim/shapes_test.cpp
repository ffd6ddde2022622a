#include "field_fusion/core/sim/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <random>

#include "field_fusion/core/sim/caster.h"
#include "test_world.h"

namespace field_fusion::core::sim {
namespace {

class EveryShape : public testing::TestWithParam<std::string> {
 protected:
  const ShapeKind& kind_ = shapeKinds().at(GetParam());
  const Model model_ = makeShape(GetParam());

  double size(const char* name) const {
    const auto found = kind_.defaults.find(name);
    return found == kind_.defaults.end() ? kNaN : found->second;
  }
};

TEST_P(EveryShape, FillsItsStatedSize) {
  const Eigen::AlignedBox3d box = model_.box();
  ASSERT_TRUE(box.min().allFinite() && box.max().allFinite());
  const auto fills = [](double extent, double stated) {
    if (std::isnan(stated)) return;
    EXPECT_LE(extent, stated * (1 + 1e-5));
    EXPECT_GE(extent, stated * 0.95);
  };
  fills(box.sizes().x(), size("length"));
  fills(box.sizes().y(), size("width"));
  fills(box.max().z(), size("height"));
  fills(box.sizes().x(), size("diameter"));
  fills(box.sizes().y(), size("diameter"));
}

TEST_P(EveryShape, StandsOnTheGroundOrReachesItsDraught) {
  const double deep = size("draught");
  EXPECT_NEAR(model_.box().min().z(), std::isnan(deep) ? 0.0 : -deep, 1e-5);
}

TEST_P(EveryShape, MeshesAreSoundAndFaceOutwards) {
  for (const Link& link : model_.links)
    for (const Part& part : link.parts) {
      if (!std::holds_alternative<Mesh>(part.shape)) continue;
      const Mesh& mesh = std::get<Mesh>(part.shape);
      double volume = 0.0;
      for (const auto& [a, b, c] : mesh.triangles) {
        ASSERT_LT(std::max({a, b, c}), mesh.vertices.size());
        volume += mesh.vertices[a]
                      .cast<double>()
                      .cross(mesh.vertices[b].cast<double>())
                      .dot(mesh.vertices[c].cast<double>()) /
                  6;
      }
      if (part.material.transparency == 0.f) {
        EXPECT_GT(volume, 0.0);
      }
    }
}

TEST_P(EveryShape, MaterialsArePossible) {
  for (const Link& link : model_.links)
    for (const Part& part : link.parts) {
      const Material& m = part.material;
      for (const float share : {m.reflectivity, m.gloss, m.transparency, m.colour.minCoeff(),
                                m.colour.maxCoeff(), m.colour2.minCoeff(), m.colour2.maxCoeff()}) {
        EXPECT_GE(share, 0.f);
        EXPECT_LE(share, 1.f);
      }
      EXPECT_GT(m.texture_size, 0.f);
    }
}

TEST_P(EveryShape, IsHitFromAllAround) {
  World world;
  world.ground.kind = Ground::Kind::kNone;
  world.bodies.push_back(test::bodyOf(Sphere{{0, 0, 0}, 1}));
  world.bodies[0].model = model_;
  const Caster caster(world);
  const Eigen::AlignedBox3f box = model_.box().cast<float>();
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.f, 1.f);
  for (int i = 0; i < 36; ++i) {
    const double angle = radians(10.0 * i);
    int hits = 0;
    for (int n = 0; n < 300; ++n) {
      const Eigen::Vector3f to =
          box.min() + box.sizes().cwiseProduct(Eigen::Vector3f(unit(random), unit(random), unit(random)));
      const Eigen::Vector3f from = to + 30.f * Eigen::Vector3f(std::cos(angle), std::sin(angle), 0.1f);
      const Hit hit = caster.cast({from, (to - from).normalized()});
      if (hit.body != 0) continue;
      ++hits;
      EXPECT_LE(box.exteriorDistance(from + hit.range * (to - from).normalized()), 1e-3f);
    }
    EXPECT_GE(hits, 3) << "from " << 10 * i << " degrees";
  }
}

TEST_P(EveryShape, RefusesASizeThatIsNotAboveZero) {
  for (const auto& [name, value] : kind_.defaults) {
    EXPECT_THROW(makeShape(GetParam(), {{name, -1.0}}), std::invalid_argument) << name;
    EXPECT_THROW(makeShape(GetParam(), {{name, NAN}}), std::invalid_argument) << name;
    if (value > 0.0 && name != "transparency") {
      EXPECT_THROW(makeShape(GetParam(), {{name, 0.0}}), std::invalid_argument) << name;
    }
  }
}

TEST_P(EveryShape, TwiceTheSizesFillTwiceTheBox) {
  ShapeParams twice;
  for (const auto& [name, value] : kind_.defaults)
    if (name == "length" || name == "width" || name == "height" || name == "diameter" || name == "draught")
      twice[name] = 2 * value;
  const Eigen::AlignedBox3d box = makeShape(GetParam(), twice).box();
  EXPECT_TRUE(box.sizes().isApprox(2 * model_.box().sizes(), 0.1)) << box.sizes().transpose();
}

std::vector<std::string> allNames() {
  std::vector<std::string> out;
  for (const auto& entry : shapeKinds()) out.push_back(entry.first);
  return out;
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryShape, testing::ValuesIn(allNames()),
                         [](const auto& info) { return info.param; });

std::string faultOf(const std::string& name, const ShapeParams& params) {
  try {
    makeShape(name, params);
  } catch (const std::invalid_argument& fault) {
    return fault.what();
  }
  return "";
}

TEST(Shapes, TheirDocumentIsWhatTheyAre) {
  std::ifstream file(PROJECT_DIR "/docs/shapes.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, shapesDocument()) << "docs/shapes.md is stale: run rosrun field_fusion write_params";
}

TEST(Shapes, FaultsNameWhatIsWrong) {
  EXPECT_NE(faultOf("bxo", {}).find("'bxo'"), std::string::npos);
  EXPECT_NE(faultOf("bxo", {}).find("bollard, box, brick_wall"), std::string::npos);
  EXPECT_NE(faultOf("box", {{"size", 1}}).find("'size'"), std::string::npos);
  EXPECT_NE(faultOf("box", {{"size", 1}}).find("height, length, width"), std::string::npos);
  EXPECT_NE(faultOf("box", {{"height", -2}}).find("box: height must be above 0"), std::string::npos);
  EXPECT_NE(faultOf("net", {{"transparency", 1.5}}).find("0..1"), std::string::npos);
}

}  // namespace
}  // namespace field_fusion::core::sim
