// The depth camera of the simulator.
#include <boost/make_shared.hpp>

#include <cstring>

#include "field_fusion/ros/recording.h"
#include "field_fusion/ros/sim_image.h"
#include "field_fusion/ros/sim_sensor.h"

namespace field_fusion {
namespace {

namespace sim = core::sim;

/// Every pixel with a depth, in the optical frame.
boost::shared_ptr<CloudMessage> pointsOf(const std_msgs::Header& header, const sim::DepthImage& image) {
  auto cloud = boost::make_shared<CloudMessage>();
  cloud->header = header;
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u) {
      const float z = image.metres[static_cast<std::size_t>(v * image.width + u)];
      if (!std::isfinite(z)) continue;
      core::Point point;
      point.x = static_cast<float>((u - image.centre_x) / image.focal_length) * z;
      point.y = static_cast<float>((v - image.centre_y) / image.focal_length) * z;
      point.z = z;
      point.time = 0.f;
      cloud->points.push_back(point);
    }
  return cloud;
}

class DepthSource : public SimSource {
 public:
  DepthSource(const SimSetup& setup, const sim::Mount& mount, const sim::DepthCameraParams& params)
      : SimSource(params.rate),
        setup_(setup),
        mount_(setup, mount),
        camera_(params, setup.seedOf(mount.name)) {}

 private:
  void measure(double time, const ros::Time& ready, const SimSink& sink) override {
    const sim::DepthImage& image = camera_.frame(setup_.caster, mount_.pose(), time);
    const std_msgs::Header header = mount_.header(time, "_optical");
    const core::Pinhole pinhole{image.focal_length, image.focal_length, image.centre_x, image.centre_y};
    send(sink, mount_.topic("depth/camera_info"), ready,
         boost::make_shared<sensor_msgs::CameraInfo>(
             cameraInfo(header, pinhole, {image.width, image.height})));
    const cv::Size size(image.width, image.height);
    send(sink, mount_.topic("depth/image_raw"), ready,
         imageMessage(header, "16UC1", size, image.millimetres));
    if (setup_.params.depth_metres)
      send(sink, mount_.topic("depth/image_rect"), ready, imageMessage(header, "32FC1", size, image.metres));
    if (setup_.params.depth_points) send(sink, mount_.topic("depth/points"), ready, pointsOf(header, image));
    if (!setup_.params.truth || !setup_.params.labels) return;
    const auto& bodies = camera_.truth().bodies;
    send(sink, mount_.truthTopic("labels"), ready,
         imageMessage(header, "mono16", size, labelsOf(bodies.data(), bodies.size())));
  }

  SimSetup setup_;
  SimMount mount_;
  sim::DepthCamera camera_;
};

}  // namespace

std::unique_ptr<SimSource> simSensor(const SimSetup& setup, Mounted mount,
                                     const sim::DepthCameraParams& params) {
  return std::make_unique<DepthSource>(setup, mount, params);
}

}  // namespace field_fusion
