// Scanners and LiDARs of the simulator.
#include <boost/make_shared.hpp>

#include <cstring>

#include "field_fusion/ros/sim_sensor.h"

namespace field_fusion {
namespace {

namespace sim = core::sim;

/// x y z body range of each point, in the order of the cloud.
boost::shared_ptr<sensor_msgs::PointCloud2> truthCloud(const std_msgs::Header& header,
                                                       const core::Cloud& points,
                                                       const std::vector<sim::BeamReturn>& truth) {
  struct Row {
    float x, y, z;
    std::int32_t body;
    float range;
  };
  auto cloud = boost::make_shared<sensor_msgs::PointCloud2>();
  using Field = sensor_msgs::PointField;
  std::uint32_t offset = 0;
  for (const auto& [name, type] : {std::pair<const char*, std::uint8_t>{"x", Field::FLOAT32},
                                   {"y", Field::FLOAT32},
                                   {"z", Field::FLOAT32},
                                   {"body", Field::INT32},
                                   {"range", Field::FLOAT32}}) {
    Field field;
    field.name = name, field.offset = offset, field.datatype = type, field.count = 1;
    cloud->fields.push_back(field);
    offset += 4;
  }
  cloud->header = header;
  cloud->height = 1;
  cloud->width = static_cast<std::uint32_t>(points.size());
  cloud->point_step = sizeof(Row);
  cloud->row_step = cloud->point_step * cloud->width;
  cloud->data.resize(cloud->row_step);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Row row{points[i].x, points[i].y, points[i].z, truth[i].body, truth[i].true_range};
    std::memcpy(&cloud->data[i * sizeof row], &row, sizeof row);
  }
  return cloud;
}

class Scanner2dSource : public SimSource {
 public:
  Scanner2dSource(const SimSetup& setup, const sim::Mount& mount, const sim::Scanner2dParams& params)
      : SimSource(params.rate, 1.0 / params.rate),
        setup_(setup),
        mount_(setup, mount),
        scanner_(params, setup.seedOf(mount.name)) {}

 private:
  void measure(double time, const ros::Time& ready, const SimSink& sink) override {
    const sim::Scan2d& scan = scanner_.scan(setup_.caster, mount_.pose(), time);
    auto message = boost::make_shared<sensor_msgs::LaserScan>();
    message->header = mount_.header(time);
    message->angle_min = scan.angle_min, message->angle_max = scan.angle_max;
    message->angle_increment = scan.angle_increment;
    message->time_increment = scan.time_increment, message->scan_time = scan.scan_time;
    message->range_min = scan.range_min, message->range_max = scan.range_max;
    message->ranges = scan.ranges;
    message->intensities = scan.intensities;
    send(sink, mount_.topic("scan"), ready, message);
    if (!setup_.params.truth) return;
    auto truth = boost::make_shared<sensor_msgs::LaserScan>(*message);
    const auto& beams = scanner_.truth();
    for (std::size_t i = 0; i < beams.size(); ++i) {
      truth->ranges[i] = beams[i].true_range;
      truth->intensities[i] = static_cast<float>(beams[i].body);
    }
    send(sink, mount_.truthTopic("scan"), ready, truth);
  }

  SimSetup setup_;
  SimMount mount_;
  sim::Scanner2d scanner_;
};

class Lidar3dSource : public SimSource {
 public:
  Lidar3dSource(const SimSetup& setup, const sim::Mount& mount, const sim::Lidar3dParams& params)
      : SimSource(params.rate, 1.0 / params.rate),
        setup_(setup),
        mount_(setup, mount),
        lidar_(params, setup.seedOf(mount.name)) {}

 private:
  void measure(double time, const ros::Time& ready, const SimSink& sink) override {
    auto message = boost::make_shared<CloudMessage>();
    message->points = lidar_.scan(setup_.caster, mount_.pose(), time);
    message->header = mount_.header(time);
    if (setup_.params.truth)
      send(sink, mount_.truthTopic("points"), ready,
           truthCloud(message->header, message->points, lidar_.truth()));
    send(sink, mount_.topic("points"), ready, message);
  }

  SimSetup setup_;
  SimMount mount_;
  sim::Lidar3d lidar_;
};

}  // namespace

std::unique_ptr<SimSource> simSensor(const SimSetup& setup, Mounted mount,
                                     const sim::Scanner2dParams& params) {
  return std::make_unique<Scanner2dSource>(setup, mount, params);
}

std::unique_ptr<SimSource> simSensor(const SimSetup& setup, Mounted mount, const sim::Lidar3dParams& params) {
  return std::make_unique<Lidar3dSource>(setup, mount, params);
}

}  // namespace field_fusion
