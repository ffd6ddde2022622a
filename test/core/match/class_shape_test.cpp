#include "field_fusion/core/match/class_shape.h"

#include <gtest/gtest.h>

namespace field_fusion::core {
namespace {

TEST(ClassShape, IsRoundABoxOrNotKnown) {
  ShapeParams params;
  params.class_diameters = {{"cage", 2.0}};
  params.class_nets = {{"cage", 1.5}};
  params.class_lengths = {{"boat", 4.0}};
  params.class_widths = {{"boat", 3.0}};
  const ClassShape cage = shapeOf("cage", params), boat = shapeOf("boat", params);
  const ClassShape cow = shapeOf("cow", params);
  EXPECT_TRUE(cage.isRound() && cage.isKnown() && !cage.isBox());
  EXPECT_EQ(cage.extent(), 2.0);
  EXPECT_EQ(cage.net, 1.5);
  EXPECT_TRUE(boat.isBox() && boat.isKnown() && !boat.isRound());
  EXPECT_EQ(boat.extent(), 5.0);
  EXPECT_FALSE(cow.isKnown());
}

TEST(ClassShape, DefaultsAreSound) {
  ShapeParams params;
  EXPECT_TRUE(declarationOf(params).faults().empty());
}

TEST(ClassShape, FaultsAreNamed) {
  ShapeParams params;
  params.class_lengths["truck"] = 8.0;
  params.class_nets["cage"] = 5.0;
  params.class_diameters["buoy"] = -1.0;
  std::string all;
  for (const auto& fault : declarationOf(params).faults()) all += fault + "\n";
  EXPECT_NE(all.find("class_lengths and class_widths must name the same classes"), std::string::npos) << all;
  EXPECT_NE(all.find("class_nets must be smaller than class_diameters"), std::string::npos) << all;
  EXPECT_NE(all.find("class_diameters"), std::string::npos) << all;
}

TEST(ClassShape, ANetNeedsADiameter) {
  ShapeParams params;
  params.class_nets["pond"] = 1.0;
  EXPECT_EQ(declarationOf(params).faults().size(), 1u);
}

}  // namespace
}  // namespace field_fusion::core
