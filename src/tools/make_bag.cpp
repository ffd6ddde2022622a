// A simulated world -> a bag of what its robot's sensors see, and of the truth.
#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <csignal>
#include <iostream>

#include "field_fusion/ros/recording.h"
#include "field_fusion/ros/sim_run.h"
#include "progress.h"

namespace {

using namespace field_fusion;

volatile std::sig_atomic_t g_interrupted = 0;

struct Options {
  SimParams sim;
  std::string bag;
  double seconds = 30.0;
  bool no_truth = false;
};

void make(const Options& options) {
  SimRun run(options.sim);
  Recording bag(options.bag);
  const SimSink sink = [&bag](const SimOutput& output) {
    const std::string topic = output.topic.front() == '/' ? output.topic : "/" + output.topic;
    std::visit([&](const auto& m) { bag.write(topic, output.time, *m, output.latched); }, output.message);
  };
  const auto began = std::chrono::steady_clock::now();
  run.begin(sink);
  constexpr double kPiece = 0.1;  // s, of the progress bar
  const auto pieces = static_cast<std::size_t>(std::ceil(options.seconds / kPiece));
  std::size_t done = 0;
  for (double due = run.due(); due <= options.seconds; due = run.due()) {
    if (g_interrupted) throw std::runtime_error("interrupted");
    run.step(sink);
    for (; done < pieces && static_cast<double>(done + 1) * kPiece <= due; ++done)
      showProgress(done + 1, pieces, "x 0.1 s");
  }
  bag.finish();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  std::cout << options.bag << ": " << options.seconds << " s of " << run.world().name << ", seed "
            << options.sim.seed << ", made " << options.seconds / took.count()
            << " times as fast as real time\n";
}

void declare(CLI::App& app, Options& options) {
  app.add_option("world", options.sim.world, "file, or name of a world that comes with the package")
      ->required();
  app.add_option("bag", options.bag, "file to write")->required();
  app.add_option("--seconds", options.seconds, "length")
      ->capture_default_str()
      ->check(CLI::Range(0.01, 1e5))
      ->check([](const std::string& text) {  // which lets nan through
        return std::isfinite(std::stod(text)) ? std::string() : text + " is no length";
      });
  app.add_option("--seed", options.sim.seed, "of the sensors' errors")
      ->capture_default_str()
      ->check(CLI::Range(0, 2147483647));
  app.add_option("--mounts", options.sim.mounts, "sensors that take part (default: all)");
  CLI::Option* no_truth = app.add_flag("--no-truth", options.no_truth, "without truth/...");
  app.add_flag("--depth-metres", options.sim.depth_metres, "depth images also as 32FC1");
  app.add_flag("--depth-points", options.sim.depth_points, "depth images also as clouds");
  app.add_flag("--labels", options.sim.labels, "which body each pixel of a camera shows")->excludes(no_truth);
  app.add_option("--grid-height", options.sim.grid_height, "of the slice in truth/grid [m] (default: the 2-D scanner's)")
      ->check(CLI::Range(0.0, 10000.0))
      ->excludes(no_truth);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Writes a bag of a simulated world: the robot's sensors, /tf_static, and the truth.");
  declare(app, options);
  CLI11_PARSE(app, argc, argv);
  options.sim.truth = !options.no_truth;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, [](int) { g_interrupted = 1; });
  try {
    make(options);
  } catch (const std::exception& e) {
    std::cerr << "make_bag: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
