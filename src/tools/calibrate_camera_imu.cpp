// A bag in which camera and inertial unit are moved before a checkerboard at rest -> where they stand to one
// another, and by how much their clocks differ (paper 004, section 2.3, uses Kalibr for it).
#include <yaml-cpp/yaml.h>
#include <CLI/CLI.hpp>

#include <iostream>

#include "calibration_bag.h"
#include "calibration_output.h"
#include "field_fusion/core/calib/camera_imu.h"
#include "within.h"

namespace {

using namespace field_fusion;

struct Options {
  std::string bag, board, image, camera_info, imu, imu_noise, out = "calibration";
  std::size_t every = 1;
  core::CameraImuOptions solver;
};

/// Random walks as calibrate_imu writes them; what it left out stays.
void readNoise(const std::string& file, core::CameraImuOptions& out) try {
  const YAML::Node noise = YAML::LoadFile(file);
  const auto read = [&](const char* key, double& value) {
    if (noise[key]) value = noise[key].as<double>();
  };
  read("gyroscope_random_walk", out.gyro_walk);
  read("accelerometer_random_walk", out.accel_walk);
} catch (const YAML::Exception& e) {
  throw std::runtime_error(file + ": " + e.what());
}

void print(const core::CameraImuCalibration& found) {
  std::printf("%zu pictures, %zu readings of the inertial unit\n", found.frames, found.readings);
  std::printf("reprojection %.2f px; left of the gyroscope %.2f mrad/s, of the accelerometer %.3f m/s^2\n",
              found.reprojection, 1e3 * found.gyro_sigma, found.accel_sigma);
  printTransform("T_camera_imu", found.T_camera_imu);
  std::printf("time offset: %.3f ms, the unit's stamp less the camera's\n", 1e3 * found.time_offset);
  std::printf("standard deviations: %.3f deg, %.1f mm, %.3f ms\n", core::degrees(found.rotationSigma()),
              1e3 * found.translationSigma(), 1e3 * found.offsetSigma());
}

void writeYaml(const std::filesystem::path& file, const core::CameraImuCalibration& found,
               const std::string& camera, const std::string& imu) {
  std::ofstream out = opened(file);
  out << "camera_frame: " << camera << "\nimu_frame: " << imu << "\n";
  writeMatrix(out, "T_camera_imu", found.T_camera_imu.matrix());
  out << "time_offset: " << found.time_offset << "  # s, stamp of the unit less that of the camera\n"
      << "# of turns [rad] about and shifts [m] along the unit's axes, then the offset [s]\n";
  writeMatrix(out, "covariance", found.covariance);
  const auto vector = [&](const char* name, const Eigen::Vector3d& v, const char* what) {
    out << name << ": [" << v.x() << ", " << v.y() << ", " << v.z() << "]  # " << what << "\n";
  };
  vector("gravity", found.gravity, "m/s^2 in the board's frame");
  vector("gyroscope_bias", found.gyro_bias, "rad/s");
  vector("accelerometer_bias", found.accel_bias, "m/s^2");
  out << "corner_noise: " << found.pixel_sigma << "  # px\ngyroscope_noise: " << found.gyro_sigma
      << "  # rad/s of a reading\naccelerometer_noise: " << found.accel_sigma << "  # m/s^2 of a reading\n"
      << "pictures: " << found.frames << "\nreprojection: " << found.reprojection << "  # px\n";
}

void run(Options& options) {
  const core::Board board = core::parseBoard(options.board);
  if (!options.imu_noise.empty()) readNoise(options.imu_noise, options.solver);
  CalibrationBag bag(options.bag);
  const std::string topic = bag.topic(options.imu, "--imu", {"sensor_msgs/Imu"});
  const BagCamera camera = cameraOf(bag, options.image, options.camera_info);
  std::string frame;
  const auto readings = bag.readings(topic, frame);
  std::size_t seen = 0;
  const auto sightings = sightingsOf(bag, camera, board, options.every, seen);
  std::cout << seen << " pictures, the whole board in " << sightings.size() << "\n";
  if (sightings.empty()) throw std::runtime_error("no picture shows the whole board " + options.board);
  const auto found = core::calibrateCameraImu(board, camera.lens, sightings, readings, options.solver);
  print(found);
  const std::filesystem::path out = options.out;
  std::filesystem::create_directories(out);
  writeLaunch(out / "static_transform.launch", "calibrate_camera_imu", found.T_camera_imu.inverse(), frame,
              camera.frame);
  writeYaml(out / "calibration.yaml", found, camera.frame, frame);
  std::cout << "written to " << out.string() << ": calibration.yaml, static_transform.launch\n";
}

void declare(CLI::App& app, Options& options) {
  app.add_option("bag", options.bag, "camera, its camera_info, and inertial unit")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--board", options.board, "COLUMNSxROWSxSQUARE: inner corners, and metres")->required();
  app.add_option("--imu", options.imu, "sensor_msgs/Imu (default: the only one)");
  app.add_option("--image", options.image, "Image or CompressedImage (default: the only one)");
  app.add_option("--camera-info", options.camera_info, "of these pictures (default: the only one)");
  app.add_option("--imu-noise", options.imu_noise, "imu.yaml of calibrate_imu: random walks of the biases")
      ->check(CLI::ExistingFile);
  app.add_option("--max-offset", options.solver.max_offset, "by which the clocks differ at most [s]")
      ->capture_default_str()
      ->check(within(0.0, 10.0));
  app.add_option("--every", options.every, "looks at one of so many pictures")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--out", options.out, "folder to write to")->capture_default_str();
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Finds where an inertial unit stands to a camera and by how much their clocks differ, from a recording "
      "in which both "
      "are moved before a checkerboard at rest.");
  declare(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
  } catch (const std::exception& e) {
    std::cerr << "calibrate_camera_imu: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
