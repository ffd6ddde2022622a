// How often the covariance of the joint calibration holds: drawn boards with noise of known size, solved, against truth.
#include <CLI/CLI.hpp>

#include <iostream>

#include "field_fusion/core/calib/board_draws.h"
#include "field_fusion/core/calib/chart.h"
#include "progress.h"

namespace {

using namespace field_fusion;

struct Options {
  std::size_t runs = 200;
  unsigned seed = 1;
  core::DrawParams draw;
};

void run(const Options& options) {
  const core::Board board{8, 6, 0.1};
  const core::CameraLens lens = core::usualLens();
  core::CalibrationOptions expected;  // an even draw up to a limit has that standard deviation
  expected.offset_sigma = options.draw.range_bias / std::sqrt(3.0);
  expected.scale_sigma = options.draw.range_scale / std::sqrt(3.0);
  std::cout << "run,rotation_deg,translation_m,mahalanobis2\n";
  for (std::size_t i = 0; i < options.runs; ++i) {
    std::mt19937 random(options.seed + static_cast<unsigned>(i));
    const core::DrawnBoards drawn = core::drawBoards(board, lens, options.draw, random);
    const core::Transform start = drawn.T_camera_lidar * core::motion({0.03, -0.04, 0.02, 0.03, 0.02, -0.03});
    const core::Calibration found = core::calibrate(board, lens, drawn.poses, start, expected);
    const auto off = core::chartOf(found.T_camera_lidar, drawn.T_camera_lidar);
    std::cout << i << ',' << core::degrees(off.head<3>().norm()) << ',' << off.tail<3>().norm() << ','
              << off.dot(found.covariance.ldlt().solve(off)) << '\n';
    showProgress(i + 1, options.runs, "runs");
  }
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Solves drawn calibrations, without pictures and rays, and prints errors and their squares in units of the "
               "stated covariance as CSV.");
  app.add_option("--runs", options.runs, "number of calibrations")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--seed", options.seed, "of the first")->capture_default_str();
  app.add_option("--poses", options.draw.poses, "of each")->capture_default_str()->check(CLI::Range(3, 1000));
  app.add_flag("--flat", options.draw.flat, "a 2-D scanner");
  app.add_option("--pixel-noise", options.draw.pixel_noise, "of a corner [px]")
      ->capture_default_str()->check(CLI::Range(0.0, 10.0));
  app.add_option("--range-noise", options.draw.range_noise, "of a return [m]")
      ->capture_default_str()->check(CLI::Range(0.0, 1.0));
  app.add_option("--range-bias", options.draw.range_bias, "of each laser, at most [m]")
      ->capture_default_str()->check(CLI::Range(0.0, 1.0));
  app.add_option("--range-scale", options.draw.range_scale, "at most")
      ->capture_default_str()->check(CLI::Range(0.0, 0.1));
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
  } catch (const std::exception& e) {
    std::cerr << "calibration_coverage: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
