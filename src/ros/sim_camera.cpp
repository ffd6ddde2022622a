// The colour camera of the simulator.
#include <boost/make_shared.hpp>

#include <algorithm>

#include "field_fusion/core/sim/colour_camera.h"
#include "field_fusion/core/sim/image_encoding.h"
#include "field_fusion/ros/detection.h"
#include "field_fusion/ros/recording.h"
#include "field_fusion/ros/sim_image.h"
#include "field_fusion/ros/sim_sensor.h"

namespace field_fusion {
namespace {

namespace sim = core::sim;

constexpr double kMinVisible = 0.01;  // share of a body that makes it worth a word

sensor_msgs::CameraInfo infoOf(const std_msgs::Header& header, const sim::CameraParams& p) {
  sensor_msgs::CameraInfo info = cameraInfo(header, {p.fx, p.fy, p.cx, p.cy}, {p.width, p.height});
  info.D = {p.k1, p.k2, p.p1, p.p2, p.k3};
  return info;
}

/// [s] from the stamp to the end of the longest exposure.
double halfExposure(const sim::CameraParams& p) {
  return 0.5e-3 * (p.auto_exposure ? p.max_exposure_time : p.exposure_time);
}

class CameraSource : public SimSource {
 public:
  CameraSource(const SimSetup& setup, const sim::Mount& mount, const sim::CameraParams& params)
      : SimSource(params.rate, halfExposure(params)),
        setup_(setup),
        mount_(setup, mount),
        params_(params),
        camera_(params, setup.world, setup.seedOf(mount.name)) {
    for (const sim::Body& body : setup.world.bodies)
      if (!body.label.empty() && std::find(classes_.begin(), classes_.end(), body.label) == classes_.end())
        classes_.push_back(body.label);
  }

 private:
  void measure(double time, const ros::Time& ready, const SimSink& sink) override {
    const sim::ColourFrame& frame = camera_.run(setup_.caster, mount_.pose(), time);
    const std_msgs::Header header = mount_.header(time, "_optical");
    const auto info = boost::make_shared<sensor_msgs::CameraInfo>(infoOf(header, params_));
    send(sink, mount_.topic("camera_info"), ready, info);
    sendPicture(header, frame.image, ready, sink);
    if (setup_.params.truth) sendTruth(header, frame, *info, ready, sink);
  }

  void sendPicture(const std_msgs::Header& header, const cv::Mat& rgb, const ros::Time& ready,
                   const SimSink& sink) const {
    auto bytes = sim::encoded(rgb, params_.encoding, params_.jpeg_quality);
    if (params_.encoding == sim::Encoding::kJpeg) {
      auto image = boost::make_shared<sensor_msgs::CompressedImage>();
      image->header = header;
      image->format = "rgb8; jpeg compressed bgr8";  // as image_transport's plug-in says
      image->data = std::move(bytes);
      send(sink, mount_.topic("image_raw/compressed"), ready, image);
      return;
    }
    const char* encoding = params_.encoding == sim::Encoding::kRgb8 ? "rgb8" : "yuv422";
    send(sink, mount_.topic("image_raw"), ready, imageMessage(header, encoding, rgb.size(), bytes));
  }

  void sendTruth(const std_msgs::Header& header, const sim::ColourFrame& frame,
                 const sensor_msgs::CameraInfo& info, const ros::Time& ready, const SimSink& sink) {
    core::Detections seen;
    for (const sim::BodyView& view : frame.views) {
      if (view.visible < kMinVisible) continue;
      const std::string& label = setup_.world.bodies[static_cast<std::size_t>(view.body)].label;
      core::Detection detection;
      detection.class_id =
          static_cast<int>(std::find(classes_.begin(), classes_.end(), label) - classes_.begin());
      detection.score = static_cast<float>(std::min(view.visible, 1.0));
      detection.box = view.visible_box;
      detection.cut = view.cut;
      seen.detections.push_back(detection);
    }
    const CameraModel model(info);
    send(sink, mount_.truthTopic("detections"), ready,
         detectionMessage(header, frame.image.size(), seen, classes_, &model, core::Plane(),
                          core::RangeParams()));
    if (!setup_.params.labels) return;
    const cv::Mat bodies = frame.bodies.isContinuous() ? frame.bodies : frame.bodies.clone();
    send(sink, mount_.truthTopic("labels"), ready,
         imageMessage(header, "mono16", bodies.size(), labelsOf(bodies.ptr<int>(), bodies.total())));
  }

  SimSetup setup_;
  SimMount mount_;
  sim::CameraParams params_;
  sim::ColourCamera camera_;
  std::vector<std::string> classes_;
};

}  // namespace

std::unique_ptr<SimSource> simSensor(const SimSetup& setup, Mounted mount, const sim::CameraParams& params) {
  return std::make_unique<CameraSource>(setup, mount, params);
}

}  // namespace field_fusion
