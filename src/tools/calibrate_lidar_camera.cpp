// A bag in which a checkerboard rests in many poses before camera and LiDAR -> where the LiDAR stands to the camera
// (paper 004, section 2.3).
#include <CLI/CLI.hpp>

#include <iostream>

#include "calibration_bag.h"
#include "calibration_output.h"
#include "field_fusion/core/calib/board_returns.h"
#include "field_fusion/core/calib/rest.h"
#include "progress.h"
#include "within.h"

namespace {

using namespace field_fusion;

struct Options {
  std::string bag, board, image, camera_info, lidar, out = "calibration";
  bool ignore_tf = false;
  std::size_t every = 1, scans = 10;
  core::RestParams rest;
  core::ReturnSearch search;
  core::CalibrationOptions noise;
};

/// A pose of the board and the scans that were taken meanwhile.
struct Resting {
  core::Rest rest;
  core::BoardView view;
  std::vector<core::Cloud> scans;
  std::string name;
};

class Calibrator {
 public:
  explicit Calibrator(const Options& options)
      : options_(options), board_(core::parseBoard(options.board)), bag_(options.bag) {
    lidar_ = bag_.topic(options.lidar, "--lidar", {"sensor_msgs/PointCloud2", "sensor_msgs/LaserScan"});
    camera_ = cameraOf(bag_, options.image, options.camera_info);
    frames_.camera = camera_.frame;
  }

  void run() {
    findPoses();
    readScans();
    const core::Calibration found = solve();
    printTable(found);  // first: it stays where nothing can be written
    printSize(found);
    write(found);
  }

 private:
  void findPoses() {
    std::size_t seen = 0;
    const auto sightings = sightingsOf(bag_, camera_, board_, options_.every, seen);
    for (const core::Rest& rest : core::findRests(sightings, options_.rest)) {
      const auto view = core::locateBoard(rest.corners, board_, camera_.lens);
      if (view) poses_.push_back({rest, *view, {}, "pose_" + std::to_string(poses_.size() + 1)});
    }
    std::cout << seen << " pictures, the whole board in " << sightings.size() << ", at rest in " << poses_.size()
              << " poses\n";
    if (poses_.empty())
      throw std::runtime_error(sightings.empty() ? "no picture shows the whole board " + options_.board
                                                 : "the board rests nowhere for --rest seconds");
  }

  void readScans() {
    bag_.frames(lidar_, [&](const LaserFrame& frame) {
      frames_.lidar = frame.frame;
      for (Resting& pose : poses_)
        if (frame.begin >= pose.rest.begin && frame.end <= pose.rest.end && pose.scans.size() < options_.scans)
          pose.scans.push_back(frame.cloud);
    });
    if (frames_.lidar.empty()) throw std::runtime_error(lidar_ + " has no messages");
  }

  using Choice = std::function<std::vector<std::uint32_t>(const Resting&, const core::Cloud&)>;

  /// The poses with the returns that `choose` takes from their scans; those without are left out.
  std::vector<core::CalibrationPose> withReturns(const Choice& choose, bool say) const {
    std::vector<core::CalibrationPose> out;
    for (const Resting& pose : poses_) {
      core::ReturnMeans means;
      for (const core::Cloud& cloud : pose.scans) means.add(cloud, choose(pose, cloud));
      core::CalibrationPose with{pose.name, pose.view, means.means()};
      if (!with.returns.empty())
        out.push_back(with);
      else if (say)
        std::cout << pose.name << " at " << std::fixed << pose.rest.begin << " s: "
                  << (pose.scans.empty() ? "no scan while the board rests" : "no returns of the board") << ", left out\n";
    }
    return out;
  }

  core::Calibration solve() {
    const auto tf = options_.ignore_tf ? std::nullopt : bag_.staticTransform(frames_.camera, frames_.lidar);
    core::Transform T_camera_lidar;
    if (tf) {
      T_camera_lidar = *tf;
    } else {
      std::cout << "no transform to start from: the board is searched as a piece of its size\n";
      T_camera_lidar = fromNothing();
    }
    const Choice near = [&](const Resting& pose, const core::Cloud& cloud) {
      return core::returnsNear(cloud, board_, T_camera_lidar.inverse() * pose.view.T_camera_board, options_.search);
    };
    const auto first = core::calibrate(board_, camera_.lens, withReturns(near, true), T_camera_lidar, options_.noise);
    const Choice on = [&](const Resting& pose, const core::Cloud& cloud) {
      return core::returnsOn(cloud, board_, first.T_camera_lidar.inverse() * pose.view.T_camera_board, options_.search);
    };
    measured_ = withReturns(on, false);
    return core::calibrate(board_, camera_.lens, measured_, first.T_camera_lidar, options_.noise);
  }

  /// The size of the squares is what all lengths hang on, and nothing else would tell that it is wrong.
  void printSize(const core::Calibration& found) const {
    constexpr double kAnyScanner = 0.01, kSure = 5.0;  // no scanner's ranges are off by so large a factor; sigmas
    const auto [factor, sigma] = core::rangeFactor(board_, camera_.lens, measured_, found, options_.noise);
    if (!(options_.noise.offset_sigma > 0.0 || options_.noise.scale_sigma > 0.0))
      std::printf("the ranges were taken as they are: what is wrong with all of them alike is not in these deviations (see "
                  "--range-offset, --range-scale)\n");
    std::printf("ranges over the board's distances: %.4f +- %.4f\n", factor, sigma);
    if (std::abs(factor - 1.0) > std::max(kAnyScanner, kSure * sigma))
      std::printf("WARNING: squares of %.4g m, not of %.4g as --board says, would fit the ranges: measure them\n",
                  factor * board_.square, board_.square);
  }

  /// From the poses in which one piece alone may be the board.
  core::Transform fromNothing() const {
    const Choice only = [&](const Resting&, const core::Cloud& cloud) {
      const auto pieces = core::boardCandidates(cloud, board_, options_.search);
      return pieces.size() == 1 ? pieces[0] : std::vector<std::uint32_t>();
    };
    const auto poses = withReturns(only, false);
    if (poses.size() < 3)
      throw std::runtime_error("the board stands out alone in " + std::to_string(poses.size()) +
                               " poses of three at least: give the LiDAR's place by /tf_static in the bag");
    return core::calibrateFromAnywhere(board_, camera_.lens, poses, options_.noise).T_camera_lidar;
  }

  void write(const core::Calibration& found) {
    const std::filesystem::path out = options_.out;
    std::filesystem::create_directories(out);
    writeLaunch(out / "static_transform.launch", "calibrate_lidar_camera", found.T_camera_lidar.inverse(), frames_.lidar,
                frames_.camera);
    writeYaml(out / "calibration.yaml", found, frames_);
    const Choice on = [&](const Resting& pose, const core::Cloud& cloud) {
      return core::returnsOn(cloud, board_, found.T_camera_lidar.inverse() * pose.view.T_camera_board, options_.search);
    };
    const auto marked = withReturns(on, false);
    bag_.pictures(camera_.image, [&](double stamp, const cv::Mat& image, std::size_t, std::size_t) {
      for (const Resting& pose : poses_) {
        if (stamp != pose.rest.end) continue;
        cv::Mat picture = image.clone();
        const auto own = std::find_if(marked.begin(), marked.end(), [&](auto& m) { return m.name == pose.name; });
        drawOverlay(picture, pose.scans.empty() ? core::Cloud() : pose.scans[0],
                    own != marked.end() ? own->returns : std::vector<core::BoardReturn>(), camera_.lens, found.T_camera_lidar);
        cv::imwrite((out / (pose.name + ".png")).string(), picture);
      }
    });
    std::cout << "written to " << out.string() << ": calibration.yaml, static_transform.launch, " << poses_.size()
              << " pictures\n";
  }

  const Options& options_;
  const core::Board board_;
  mutable CalibrationBag bag_;
  std::string lidar_;
  BagCamera camera_;
  CalibrationFrames frames_;
  std::vector<Resting> poses_;
  std::vector<core::CalibrationPose> measured_;  // with the returns of the last step
};

void declare(CLI::App& app, Options& options) {
  app.add_option("bag", options.bag, "camera, its camera_info, and cloud or scan")->required()->check(CLI::ExistingFile);
  app.add_option("--board", options.board, "COLUMNSxROWSxSQUARE: inner corners, and metres")->required();
  app.add_option("--lidar", options.lidar, "PointCloud2 or LaserScan (default: the only one)");
  app.add_option("--image", options.image, "Image or CompressedImage (default: the only one)");
  app.add_option("--camera-info", options.camera_info, "of these pictures (default: the only one)");
  app.add_option("--out", options.out, "folder to write to")->capture_default_str();
  app.add_flag("--ignore-tf", options.ignore_tf, "does not start from /tf_static");
  app.add_option("--every", options.every, "looks at one of so many pictures")
      ->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--scans", options.scans, "of each pose, at most")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--rest", options.rest.duration, "for which the board rests at least [s]")
      ->capture_default_str()->check(within(0.0, 60.0));
  app.add_option("--reach", options.search.reach, "by which the start may be wrong at the board [m]")
      ->capture_default_str()->check(within(0.01, 2.0));
  app.add_option("--range-offset", options.noise.offset_sigma,
                 "finds each laser's range offset too; how large to expect it [m] (0.01 where no number follows)")
      ->expected(0, 1)->default_str("0.01")->check(within(0.0, 1.0));
  app.add_option("--range-scale", options.noise.scale_sigma,
                 "finds a scale error of the ranges too; how large to expect it (0.003 where no number follows)")
      ->expected(0, 1)->default_str("0.003")->check(within(0.0, 0.1));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Finds where a LiDAR or 2-D scanner stands to a camera, from a checkerboard at rest in some 30 poses.");
  declare(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    Calibrator(options).run();
  } catch (const std::exception& e) {
    std::cerr << "calibrate_lidar_camera: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
