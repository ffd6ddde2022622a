// People and dummies. Body proportions of a standing adult after Drillis and Contini (1966), as shares of the
// height: hip 0.53, knee 0.285, shoulder 0.818, elbow 0.63.
#include <algorithm>
#include <cmath>

#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

constexpr float kHip = 0.53f, kKnee = 0.285f, kShoulder = 0.818f, kElbow = 0.63f, kHand = 0.485f;

/// How legs and arms swing so that a foot steps as far as the body goes: the step grows with the square root
/// of the speed, and a leg of length L reaches asin(step / 2 L) to both sides.
struct Gait {
  double swing = 0.0, period = 1.0;  ///< [rad], [s] of two steps

  Gait(double height, double speed) {
    if (speed <= 0.0) return;
    const double step = std::min(0.42 * height * std::sqrt(speed / 1.35), 0.8 * height * kHip);
    swing = std::asin(step / (2.0 * height * kHip));
    period = 2.0 * step / speed;
  }
};

struct Dress {
  Material skin, shirt, trousers, shoes;
};

struct Figure {
  Builder builder;
  float h, breadth;
  Gait gait;
  Dress dress;

  Joint swinging(const Vector3f& pivot, double amplitude, double phase, double bias) const {
    Joint joint;  // forwards is positive: about -y
    joint.pivot = pivot.cast<double>(), joint.axis = -Eigen::Vector3d::UnitY();
    joint.amplitude = amplitude, joint.period = gait.period, joint.phase = phase, joint.bias = bias;
    return joint;
  }
  void rounded(const Vector3f& from, const Vector3f& to, float radius) {
    builder.rod(from, to, radius).ball(from, radius).ball(to, radius);
  }
  void trunk() {
    const float deep = 0.065f * h, wide = breadth - 0.06f * h;
    Mesh torso = lathe({{0.8f, kHip * h - 0.03f * h},
                        {0.95f, kHip * h},
                        {0.8f, 0.64f * h},
                        {1.f, 0.76f * h},
                        {0.75f, kShoulder * h},
                        {0.25f, 0.84f * h}});
    for (Vector3f& v : torso.vertices) v.x() *= deep, v.y() *= wide;
    const float head = 0.065f * h;
    builder.use(dress.shirt).mesh(torso).use(dress.skin);
    builder.rod({0, 0, 0.83f * h}, {0, 0, h - head}, 0.035f * h);
    builder.ball({0, 0, h - head}, head).ball({0.02f * h, 0, h - 1.4f * head}, 0.7f * head);
  }
  /// `side` is -1 or 1; the phases of the two sides are half a period apart.
  void leg(float side) {
    const float y = side * 0.052f * h, ankle = 0.04f * h;
    const double phase = side > 0 ? 0.0 : radians(180.0), bend = gait.swing * 0.9;
    const Vector3f hip(0, y, kHip * h), knee(0, y, kKnee * h);
    const int thigh = builder.link(swinging(hip, gait.swing, phase, 0.0));
    builder.use(dress.trousers);
    rounded(hip, knee, 0.048f * h);
    // the knee is straight while the foot stands and bent most while the thigh swings forwards
    builder.link(swinging(knee, -bend, phase + radians(90.0), -bend), thigh);
    builder.use(dress.trousers).rod(knee, {0, y, ankle}, 0.036f * h);
    builder.use(dress.shoes).box({-0.04f * h, y - 0.028f * h, 0}, {0.11f * h, y + 0.028f * h, ankle});
  }
  void arm(float side) {
    const float y = side * (breadth - 0.03f * h);
    const double phase = side > 0 ? radians(180.0) : 0.0;  // against the leg
    const Vector3f shoulder(0, y, kShoulder * h - 0.03f * h), elbow(0, y, kElbow * h), hand(0, y, kHand * h);
    const int upper = builder.link(swinging(shoulder, 0.8 * gait.swing, phase, 0.0));
    builder.use(dress.shirt);
    rounded(shoulder, elbow, 0.028f * h);
    builder.link(swinging(elbow, 0.3 * gait.swing, phase, 0.3 * gait.swing), upper);
    builder.use(dress.skin).rod(elbow, hand, 0.024f * h).ball(hand, 0.03f * h);
  }
};

Model person(const ShapeParams& p) {
  const float h = of(p, "height");
  Figure figure{{},
                h,
                0.5f * of(p, "width"),
                Gait(h, p.at("speed")),
                {skin(), cloth(kRed), cloth(kBlue), matt(kBlack, 0.1f)}};
  figure.trunk();
  for (const float side : {-1.f, 1.f}) figure.leg(side), figure.arm(side);
  return figure.builder.build();
}

/// A dummy that stands for a pedestrian, of one fabric.
Model puppet(const ShapeParams& p) {
  const Material fabric = cloth(kGrey);
  Figure figure{{}, of(p, "height"), 0.5f * of(p, "width"), Gait(1.0, 0.0), {fabric, fabric, fabric, fabric}};
  figure.trunk();
  for (const float side : {-1.f, 1.f}) figure.leg(side), figure.arm(side);
  return figure.builder.build();
}

}  // namespace

ShapeKinds personShapes() {
  return {
      {"person",
       {"a person who walks at `speed` [m/s]; 0: stands",
        {{"height", 1.75}, {"width", 0.5}, {"speed", 0}},
        person}},
      {"puppet",
       {"a dummy pedestrian (Fig. 5 of the off-road paper)", {{"height", 1.154}, {"width", 0.298}}, puppet}},
  };
}

}  // namespace field_fusion::core::sim
