#include "field_fusion/core/sim/lidar_noise.h"

#include <gtest/gtest.h>

#include "support/sim_worlds.h"

namespace field_fusion::core::sim {
namespace {

constexpr int kDraws = 20000;
constexpr float kInf = std::numeric_limits<float>::infinity();

/// No error at all, and every target is seen.
LidarParams perfect() {
  LidarParams p;
  p.min_range = 0.5, p.max_range = 40.0, p.ten_percent_range = 1000.0;
  p.energy_noise = p.range_noise = p.slant_noise = p.range_bias = p.range_step = 0.0;
  return p;
}

Glint target(float range, float reflectivity = 0.5f, int body = 0) {
  return {range, reflectivity / (range * range), body};
}

BeamReturn once(const LidarParams& params, std::vector<Glint> glints, std::uint64_t seed = 1) {
  BeamRandom random(seed, 7);
  return LidarNoise(params, 1, seed).measure(glints.data(), static_cast<int>(glints.size()), 0.f, 0, random);
}

std::vector<float> ranges(const LidarParams& params, const Glint& glint, float slope = 0.f) {
  const LidarNoise noise(params, 1, 1);
  std::vector<float> out;
  for (int i = 0; i < kDraws; ++i) {
    Glint same = glint;
    BeamRandom random(5, static_cast<std::uint64_t>(i));
    out.push_back(noise.measure(&same, 1, slope, 0, random).range);
  }
  return out;
}

/// Four standard errors of a mean and of a standard deviation.
void expectSpread(const std::vector<float>& values, double mean, double sigma) {
  const auto found = test::spreadOf(values);
  EXPECT_EQ(found.count, values.size());
  EXPECT_NEAR(found.mean, mean, 4.0 * sigma / std::sqrt(kDraws) + 1e-5);
  EXPECT_NEAR(found.sigma, sigma, 4.0 * sigma / std::sqrt(2.0 * kDraws) + 1e-5);
}

TEST(SpotSize, OfTheLms1xxIsFifteenMilliradPlusEightMillimetres) {
  const LidarParams lms;
  EXPECT_NEAR(spotSize(lms, 0.f).x(), 0.008, 1e-6);
  EXPECT_NEAR(spotSize(lms, 10.f).x(), 0.158, 1e-6);
  EXPECT_NEAR(spotSize(lms, 40.f).y(), 0.608, 1e-6);
}

TEST(EchoEnergy, FallsWithRangeIncidenceAndGloss) {
  Material material = test::matt(0.8f);
  Hit hit;
  hit.range = 4.f, hit.body = 0, hit.normal = {-1, 0, 0}, hit.material = &material;
  const Eigen::Vector3f oblique = Eigen::Vector3f(1, std::sqrt(3.f), 0).normalized();  // 60 deg
  EXPECT_NEAR(echoEnergy(hit, Eigen::Vector3f::UnitX()), 0.05, 1e-6);
  EXPECT_NEAR(echoEnergy(hit, oblique), 0.025, 1e-6);
  material.gloss = 0.75f;
  EXPECT_NEAR(echoEnergy(hit, oblique), 0.00625, 1e-6);
  EXPECT_EQ(echoEnergy(Hit{}, oblique), 0.f);
}

TEST(LidarNoise, IsNoneWithoutErrors) {
  const BeamReturn out = once(perfect(), {target(12.345f)});
  EXPECT_EQ(out.range, 12.345f);
  EXPECT_EQ(out.body, 0);
  EXPECT_FALSE(out.mixed);
}

TEST(LidarNoise, HasTheSigmasConfigured) {
  LidarParams p = perfect();
  p.range_noise = 0.012;
  expectSpread(ranges(p, target(10.f)), 10.0, 0.012);
  p.range_noise_square = 5e-4;
  expectSpread(ranges(p, target(10.f)), 10.0, std::hypot(0.012, 0.05));
}

TEST(LidarNoise, GrowsForWeakReturns) {
  LidarParams p = perfect();
  p.ten_percent_range = 10.0, p.range_noise_weak = 0.04;  // the threshold is 0.001
  expectSpread(ranges(p, target(10.f, 0.4f)), 10.0, 0.02);
}

TEST(LidarNoise, GrowsOnSlantingSurfaces) {
  LidarParams p = perfect();
  p.slant_noise = 0.2;  // of the spread of a spot of 0.158 m
  expectSpread(ranges(p, target(10.f), 3.f), 10.0, 0.2 * 0.158 / 4.0 * 3.0);
}

TEST(LidarNoise, LosesReturnsAsTheNormalDistributionOfTheirEnergySays) {
  LidarParams p = perfect();
  p.ten_percent_range = 20.0, p.energy_noise = 0.2;
  for (const double over : {0.7, 0.9, 1.0, 1.1, 1.5}) {  // energy over threshold
    const auto seen = test::spreadOf(ranges(p, target(20.f, static_cast<float>(0.1 * over)))).count;
    const double expected = 0.5 * std::erfc((1.0 / over - 1.0) / p.energy_noise / std::sqrt(2.0));
    const double error = std::sqrt(expected * (1.0 - expected) / kDraws);
    EXPECT_NEAR(static_cast<double>(seen) / kDraws, expected, 4.0 * error + 1e-3) << over;
  }
}

TEST(LidarNoise, DrawsBiasAndScaleOncePerSeedWithinTheirBounds) {
  LidarParams p = perfect();
  p.range_bias = 0.03, p.range_scale = 0.002;
  std::vector<double> biases, scales;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const LidarNoise noise(p, 2, seed);
    EXPECT_NE(noise.bias(0), noise.bias(1));
    EXPECT_FLOAT_EQ(once(p, {target(10.f)}, seed).range, 10.f * (1.f + noise.scale()) + noise.bias(0));
    biases.push_back(noise.bias(0)), scales.push_back(noise.scale());
  }
  EXPECT_LE(*std::max_element(biases.begin(), biases.end()), 0.03f);
  EXPECT_GE(*std::min_element(scales.begin(), scales.end()), -0.002f);
  EXPECT_NEAR(test::spreadOf(biases).sigma, 0.03 / std::sqrt(3.0), 0.001);
  EXPECT_NEAR(test::spreadOf(scales).mean, 0.0, 0.0002);
}

TEST(LidarNoise, AnswersAsRep117) {
  LidarParams p = perfect();
  EXPECT_EQ(once(p, {Glint{}}).range, kInf);
  EXPECT_EQ(once(p, {target(0.49f)}).range, -kInf);
  EXPECT_EQ(once(p, {target(0.5f)}).range, 0.5f);
  EXPECT_EQ(once(p, {target(40.f)}).range, 40.f);
  EXPECT_EQ(once(p, {target(40.01f)}).range, kInf);
  EXPECT_EQ(once(p, {target(5.f, 0.f)}).range, kInf);  // black
  p.fault_rate = 1.0;
  EXPECT_TRUE(std::isnan(once(p, {target(5.f)}).range));
}

TEST(LidarNoise, TellsTheTrueRangeOfTheBeamsMiddleWhateverItReports) {
  LidarParams p = perfect();
  p.echo = Echo::kLast;
  EXPECT_EQ(once(p, {target(5.f), target(9.f, 1.f, 3)}).true_range, 5.f);
  EXPECT_EQ(once(p, {target(5.f, 0.f)}).true_range, 5.f);
  EXPECT_EQ(once(p, {target(5.f, 0.f)}).body, Hit::kNothing);
}

TEST(LidarNoise, MeltsReturnsWithinThePulseAtTheirEnergysCentre) {
  LidarParams p = perfect();
  p.pulse_length = 0.5;
  const BeamReturn out = once(p, {{10.f, 3.f, 1}, {10.4f, 1.f, 2}, {10.4f, 1.f, 2}, {10.4f, 3.f, 2}});
  EXPECT_NEAR(out.range, 10.0 + 0.4 * 5.0 / 8.0, 1e-5);
  EXPECT_EQ(out.body, 2);
  EXPECT_TRUE(out.mixed);
}

TEST(LidarNoise, ChoosesBetweenReturnsFurtherApart) {
  LidarParams p = perfect();
  const std::vector<Glint> three = {{12.f, 2.f, 1}, {10.f, 1.f, 0}, {14.f, 1.f, 2}};
  EXPECT_EQ(once(p, three).range, 12.f);
  EXPECT_FALSE(once(p, three).mixed);
  p.echo = Echo::kFirst;
  EXPECT_EQ(once(p, three).range, 10.f);
  p.echo = Echo::kLast;
  EXPECT_EQ(once(p, three).range, 14.f);
  EXPECT_EQ(once(p, {{12.f, 2.f, 1}, {14.f, 0.f, 2}}).range, 12.f);  // the last one is too weak
}

TEST(LidarNoise, RoundsToItsStep) {
  LidarParams p = perfect();
  p.range_step = 0.0025;
  EXPECT_FLOAT_EQ(once(p, {target(10.0011f)}).range, 10.f);
  EXPECT_FLOAT_EQ(once(p, {target(10.0013f)}).range, 10.0025f);
}

TEST(LidarNoise, ReportsReflectivityOrDecibels) {
  LidarParams p = perfect();
  EXPECT_EQ(once(p, {target(3.f, 0.42f)}).intensity, 42.f);
  EXPECT_EQ(once(p, {target(30.f, 0.42f)}).intensity, 42.f);
  p.intensity = Intensity::kDecibel, p.intensity_scale = 2.0, p.ten_percent_range = 30.0;
  EXPECT_EQ(once(p, {target(3.f, 1.f)}).intensity, 60.f);  // 1000 times the threshold: 30 dB
}

}  // namespace
}  // namespace field_fusion::core::sim
