#include "field_fusion/core/sim/colour_camera.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <opencv2/core.hpp>

#include "blur.h"
#include "field_fusion/core/base/workers.h"
#include "film.h"
#include "random.h"
#include "shading.h"

namespace field_fusion::core::sim {
namespace {

const CameraParams& checked(const CameraParams& params) {
  CameraParams copy = params;
  const std::vector<std::string> faults = declarationOf(copy).faults();
  if (!faults.empty()) throw std::invalid_argument("camera: " + faults.front());
  return params;
}

/// Of one thread: a row of rays and what they hit.
struct Row {
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  std::vector<Eigen::Vector3f> light;
  Shader::Scratch shader;

  explicit Row(std::size_t width) : rays(width), hits(width), light(width) {}
};

/// Of one picture.
struct Shot {
  const Caster& caster;
  Eigen::Isometry3f T_world_optical;
  double stamp;
};

}  // namespace

struct ColourCamera::State {
  CameraParams params;
  std::uint64_t seed;
  Lens lens;
  Shader shader;
  Film film;
  Exposure exposure;
  Workers workers;
  ImageTruth truth;
  std::vector<Row> rows;
  cv::Mat light, blurred;  // CV_32FC3, radiance
  std::vector<double> meter;
  bool first = true;
  double mean = 0.0;  // brightness of the last picture
  ColourFrame frame;

  State(const CameraParams& p, const World& w, std::uint64_t s)
      : params(checked(p)),
        seed(s),
        lens(p),
        shader(w, static_cast<float>(lens.pixelAngle()), p.reflections),
        film(p),
        exposure(p),
        workers(p.threads),
        truth(w, lens),
        light(p.height, p.width, CV_32FC3),
        blurred(p.height, p.width, CV_32FC3),
        meter(static_cast<std::size_t>(p.height)) {
    for (int i = 0; i < workers.number(); ++i) rows.emplace_back(static_cast<std::size_t>(p.width));
    frame.image.create(p.height, p.width, CV_8UC3);
    frame.bodies.create(p.height, p.width, CV_32S);
    frame.ranges.create(p.height, p.width, CV_32F);
  }

  template <class Job>
  void over(const Job& job) {
    workers.share(static_cast<std::size_t>(params.height),
                  [&](std::size_t v, int worker) { job(static_cast<int>(v), worker); });
  }

  void castRow(const Shot& shot, int v, float right, float down, Row& row) const {
    const bool middle = right == 0.f && down == 0.f;
    for (int u = 0; u < params.width; ++u) {
      const Eigen::Vector3f ray = middle ? lens.ray(u, v) : lens.ray(u, v, right, down);
      row.rays[u] = {shot.T_world_optical.translation(), shot.T_world_optical.linear() * ray, 0.f};
    }
    shot.caster.cast(row.rays.data(), row.hits.data(), row.rays.size());
  }

  void keepTruth(const Row& row, int v) {
    for (int u = 0; u < params.width; ++u) {
      frame.bodies.at<int>(v, u) = row.hits[u].body;
      frame.ranges.at<float>(v, u) = row.hits[u].range;
    }
  }

  void lightRow(const Shot& shot, int v, Row& row) {
    const int n = params.samples;
    castRow(shot, v, 0.f, 0.f, row);
    keepTruth(row, v);
    float* to = light.ptr<float>(v);
    std::fill(to, to + 3 * params.width, 0.f);
    for (int s = 0; s < n * n; ++s) {
      if (n > 1) castRow(shot, v, (s % n + 0.5f) / n - 0.5f, (s / n + 0.5f) / n - 0.5f, row);
      shader.shade(shot.caster, row.rays.data(), row.hits.data(), row.rays.size(), shot.stamp, row.shader,
                   row.light.data());
      for (int u = 0; u < params.width; ++u)
        Eigen::Map<Eigen::Vector3f>(to + 3 * u) += row.light[u] / static_cast<float>(n * n);
    }
  }

  /// 0..1, share of the sun's disc that is in the picture and that nothing hides.
  float sunInView(const Shot& shot) const {
    constexpr float kRadius = 0.004f;  // [rad]
    const Eigen::Vector3f sun = shader.sky().toSun(), side = sun.unitOrthogonal(), up = sun.cross(side);
    int seen = 0, all = 0;
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j, ++all) {
        const Eigen::Vector3f d = (sun + kRadius / 2 * (i * side + j * up)).normalized();
        const Eigen::Vector3f in_camera = shot.T_world_optical.linear().transpose() * d;
        const Eigen::Vector2d pixel = lens.project(in_camera.cast<double>());
        if (!(pixel.x() > -0.5 && pixel.x() < params.width - 0.5 && pixel.y() > -0.5 &&
              pixel.y() < params.height - 0.5))
          continue;
        const Ray ray{shot.T_world_optical.translation(), d, 0.f};
        seen += !shot.caster.blocked(ray, std::numeric_limits<float>::infinity());
      }
    return static_cast<float>(seen) / static_cast<float>(all);
  }

  void addGlare(const Shot& shot) {
    const float strength = static_cast<float>(params.glare) * (params.glare > 0.0 ? sunInView(shot) : 0.f);
    if (strength == 0.f) return;
    const Eigen::Vector3f sun = shot.T_world_optical.linear().transpose() * shader.sky().toSun();
    over([&](int v, int) {
      float* to = light.ptr<float>(v);
      for (int u = 0; u < params.width; ++u)
        Eigen::Map<Eigen::Vector3f>(to + 3 * u) +=
            strength * scattered(lens.ray(u, v), sun) * shader.sky().sun();
    });
  }

  double meanBrightness(const cv::Mat& of) {
    over([&](int v, int) { meter[static_cast<std::size_t>(v)] = film.meter(of, v, exposure.scale()); });
    double sum = 0.0;
    for (const double row : meter) sum += row;
    return sum / params.height;
  }

  /// The first picture is exposed as if the camera had looked there for long.
  void expose(double stamp) {
    if (!exposure.automatic()) return;
    constexpr double kLong = 1e9;  // [s]
    if (first)
      for (int i = 0; i < 12; ++i) exposure.follow(meanBrightness(light), kLong);
    else
      exposure.follow(mean, stamp - frame.stamp);
    first = false;
  }

  const cv::Mat& blur(const std::function<Transform(double)>& pose, double stamp) {
    const double half = 0.5 * exposure.time();
    const Transform middle = pose(stamp) * sensorToOptical();
    const Blur motion(lens, (pose(stamp - half) * sensorToOptical()).inverse() * middle,
                      (pose(stamp + half) * sensorToOptical()).inverse() * middle);
    double nearest = 0.0;
    cv::minMaxLoc(frame.ranges, &nearest);
    if (!motion.seen(static_cast<float>(nearest))) return light;
    over([&](int v, int) { motion.row(light, frame.ranges, v, blurred); });
    return blurred;
  }

  void develop(const cv::Mat& from, double stamp) {
    std::uint64_t bits;
    std::memcpy(&bits, &stamp, sizeof bits);
    const std::uint64_t frame_seed = mixed(mixed(seed) ^ bits);
    over([&](int v, int) {
      film.develop(from, v, exposure, mixed(frame_seed + static_cast<std::uint64_t>(v)), frame.image);
    });
  }
};

ColourCamera::ColourCamera(const CameraParams& params, const World& world, std::uint64_t seed)
    : state_(std::make_unique<State>(params, world, seed)) {}

ColourCamera::~ColourCamera() = default;

const Lens& ColourCamera::lens() const { return state_->lens; }

const ColourFrame& ColourCamera::run(Caster& caster,
                                     const std::function<Transform(double time)>& T_world_sensor,
                                     double stamp) {
  State& s = *state_;
  const Transform T_world_optical = T_world_sensor(stamp) * sensorToOptical();
  if (!std::isfinite(stamp) || !T_world_optical.matrix().allFinite())
    throw std::invalid_argument("a camera's pose and time must be finite");
  caster.setWindow(stamp, stamp);
  const Shot shot{caster, T_world_optical.cast<float>(), stamp};
  s.over([&](int v, int worker) { s.lightRow(shot, v, s.rows[static_cast<std::size_t>(worker)]); });
  s.addGlare(shot);
  s.expose(stamp);
  const cv::Mat& seen = s.blur(T_world_sensor, stamp);
  if (s.exposure.automatic()) s.mean = s.meanBrightness(seen);
  s.develop(seen, stamp);
  s.frame.stamp = stamp;
  s.frame.exposure_time = s.exposure.time();
  s.frame.gain = 20.0 * std::log10(s.exposure.gain());
  s.frame.views = s.truth.views(caster, T_world_optical, stamp, s.frame.bodies, s.workers);
  return s.frame;
}

}  // namespace field_fusion::core::sim
