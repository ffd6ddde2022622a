#include "field_fusion/core/base/params.h"

#include <gtest/gtest.h>

#include <cmath>

#include "field_fusion/core/base/params_text.h"

namespace field_fusion::core {
namespace {

enum class Method { kPaper, kOptimal };

struct AllTypes {
  bool flag = true;
  int count = 3;
  double radius = 1.0;
  std::string frame = "lidar";
  Method method = Method::kOptimal;
  std::vector<double> box{-1.0, 2.5};
  std::vector<std::string> classes{"car", "8"};
  Table heights{{"car", 1.5}};
  double low = 0.0, high = 1.0;

  void declare(Params& p) {
    p.flag("flag", flag, When::kLive, "A flag.");
    p.number("count", count, {1, 9}, "points", When::kLive, "A count.");
    p.number("radius", radius, {0.0, 1e5}, "m", When::kStart, "A radius.");
    p.text("frame", frame, When::kStart, "A frame.");
    p.choice("method", method, {"paper", "optimal"}, When::kStart, "A method.");
    p.number("box", box, {-10.0, 10.0}, "m", When::kStart, "A list.");
    p.texts("classes", classes, When::kStart, "Names.");
    p.number("heights", heights, {0.1, 5.0}, "m", When::kStart, "A table.");
    p.number("low", low, {0.0, 10.0}, "", When::kLive, "Lower.");
    p.number("high", high, {0.0, 10.0}, "", When::kLive, "Upper.");
    p.rule([this] { return low < high; }, "low must be below high");
  }
};

TEST(Params, DefaultsAreValid) {
  AllTypes all;
  EXPECT_TRUE(declarationOf(all).faults().empty());
}

TEST(Params, EveryFaultIsReportedAtOnce) {
  AllTypes all;
  const auto params = declarationOf(all);
  all.count = 10;
  all.radius = std::nan("");
  all.box = {0.0, 11.0};
  all.heights["bus"] = 9.0;
  all.low = 2.0;
  const std::vector<std::string> expected{
      "count = 10.0 is outside [1, 9] points", "radius = .nan is outside [0.0, 100000.0] m",
      "box[1] = 11.0 is outside [-10.0, 10.0] m", "heights[bus] = 9.0 is outside [0.1, 5.0] m",
      "low must be below high"};
  EXPECT_EQ(params.faults(), expected);
}

TEST(Params, BoundsBelongToTheRange) {
  AllTypes all;
  const auto params = declarationOf(all);
  EXPECT_EQ(faultOf(*params.find("count"), Value(1)), "");
  EXPECT_EQ(faultOf(*params.find("count"), Value(9)), "");
  EXPECT_NE(faultOf(*params.find("count"), Value(0)), "");
}

TEST(Params, EnumIsReadAndSetByItsChoice) {
  AllTypes all;
  const auto params = declarationOf(all);
  const auto& method = *params.find("method");
  EXPECT_EQ(std::get<std::string>(method.get()), "optimal");
  method.set(Value(std::string("paper")));
  EXPECT_EQ(all.method, Method::kPaper);
  EXPECT_EQ(faultOf(method, Value(std::string("best"))), "method = 'best' is none of paper | optimal");
}

TEST(Params, DeclaringTwiceIsAProgrammingError) {
  Params params;
  bool field = false;
  params.flag("twice", field, When::kLive, "");
  EXPECT_THROW(params.flag("twice", field, When::kLive, ""), std::logic_error);
}

TEST(Params, ListsAndTablesCannotBeLive) {
  Params params;
  std::vector<double> list;
  EXPECT_THROW(params.number("list", list, {0.0, 1.0}, "", When::kLive, ""), std::logic_error);
}

TEST(FloatText, YamlReadsItAsAFloat) {
  EXPECT_EQ(floatText(1.0), "1.0");
  EXPECT_EQ(floatText(-0.25), "-0.25");
  EXPECT_EQ(floatText(1e-5), "1.0e-05");
  EXPECT_EQ(floatText(0.1), "0.1");
  EXPECT_EQ(floatText(INFINITY), ".inf");
  EXPECT_EQ(std::stod(floatText(1.0 / 3.0)), 1.0 / 3.0);
}

TEST(ParamsText, YamlHoldsDefaultUnitMeaningAndRange) {
  AllTypes all;
  const auto yaml = toYaml(declarationOf(all));
  EXPECT_NE(yaml.find("count: 3  # A count. [1, 9] points, live\n"), std::string::npos) << yaml;
  EXPECT_NE(yaml.find("method: optimal  # A method. paper | optimal, at start\n"), std::string::npos) << yaml;
  EXPECT_NE(yaml.find("classes: [car, \"8\"]"), std::string::npos) << yaml;
  EXPECT_NE(yaml.find("heights: {car: 1.5}"), std::string::npos) << yaml;
}

TEST(ParamsText, MarkdownKeepsTheColumnsOfAnEnum) {
  AllTypes all;
  EXPECT_NE(toMarkdown(declarationOf(all)).find("| `method` | enum | `optimal` | paper \\| optimal |"),
            std::string::npos);
}

}  // namespace
}  // namespace field_fusion::core
