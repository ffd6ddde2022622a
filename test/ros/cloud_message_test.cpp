#include "field_fusion/ros/cloud_message.h"

#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cmath>
#include <cstring>

namespace field_fusion {
namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

/// Sends `in` over the wire and reads it as Out.
template <class Out, class In>
Out overTheWire(const In& in) {
  const auto bytes = ros::serialization::serializeMessage(in);
  Out out;
  ros::serialization::IStream stream(bytes.message_start, bytes.num_bytes - 4);
  ros::serialization::deserialize(stream, out);
  return out;
}

/// An unorganised cloud with the given fields (name, datatype), packed, little-endian, all bytes zero.
PointCloud2 cloudWith(const std::vector<std::pair<const char*, int>>& fields, std::uint32_t points) {
  static const int kSizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
  PointCloud2 cloud;
  cloud.header.frame_id = "lidar";
  cloud.header.stamp = ros::Time(1'600'000'000, 7);
  for (const auto& [name, datatype] : fields) {
    PointField field;
    field.name = name;
    field.datatype = static_cast<std::uint8_t>(datatype);
    field.offset = cloud.point_step;
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += kSizes[datatype];
  }
  cloud.height = 1;
  cloud.width = points;
  cloud.row_step = points * cloud.point_step;
  cloud.data.resize(cloud.row_step);
  return cloud;
}

PointCloud2 xyz(std::uint32_t points) {
  return cloudWith({{"x", PointField::FLOAT32}, {"y", PointField::FLOAT32}, {"z", PointField::FLOAT32}},
                   points);
}

template <class T>
void put(PointCloud2& cloud, std::size_t point, std::size_t field, T value) {
  std::memcpy(&cloud.data[point * cloud.point_step + cloud.fields[field].offset], &value, sizeof value);
}

TEST(CloudMessage, RoundTripKeepsEveryBitAndTheStampToTheNanosecond) {
  CloudMessage in;
  in.header.frame_id = "lidar";
  in.header.stamp = ros::Time(1'600'000'000, 123'456'789);
  in.points = {{1.f, 2.f, 3.f, 4.f, -0.05f, 7},
               {core::kNaN, INFINITY, -1.f, core::kNaN, core::kNaN, core::kUnknownRing}};
  const auto out = overTheWire<CloudMessage>(in);
  EXPECT_EQ(out.fault, "");
  EXPECT_EQ(out.header.stamp, in.header.stamp);
  ASSERT_EQ(out.points.size(), 2u);
  EXPECT_EQ(std::memcmp(out.points.data(), in.points.data(), 2 * sizeof(core::Point)), 0);
}

TEST(CloudMessage, IsAPointCloud2OnTheWire) {
  CloudMessage in;
  in.points = {{1.f, 2.f, 3.f, 4.f, 0.5f, 6}};
  auto cloud = overTheWire<PointCloud2>(in);
  EXPECT_EQ(cloud.width * cloud.height, 1u);
  EXPECT_EQ(*sensor_msgs::PointCloud2Iterator<float>(cloud, "z"), 3.f);
  EXPECT_EQ(*sensor_msgs::PointCloud2Iterator<float>(cloud, "time"), 0.5f);
  EXPECT_EQ(*sensor_msgs::PointCloud2Iterator<std::uint16_t>(cloud, "ring"), 6);
}

TEST(CloudMessage, EmptyCloudIsNoFault) {
  EXPECT_EQ(overTheWire<CloudMessage>(CloudMessage()).fault, "");
  EXPECT_EQ(overTheWire<CloudMessage>(xyz(0)).fault, "");
}

TEST(CloudMessage, WhatTheDriverDoesNotSendIsUnknown) {
  auto cloud = xyz(1);
  put(cloud, 0, 1, 5.f);
  const auto out = overTheWire<CloudMessage>(cloud);
  ASSERT_EQ(out.points.size(), 1u);
  EXPECT_EQ(out.points[0].y, 5.f);
  EXPECT_TRUE(std::isnan(out.points[0].intensity));
  EXPECT_TRUE(std::isnan(out.points[0].time));
  EXPECT_EQ(out.points[0].ring, core::kUnknownRing);
}

TEST(CloudMessage, SecondLayoutIsReadByItsOwnFields) {
  // a reader that remembers the first message's layout would swap x and z here
  auto turned =
      cloudWith({{"z", PointField::FLOAT64}, {"y", PointField::FLOAT32}, {"x", PointField::FLOAT32}}, 1);
  put(turned, 0, 0, 3.0);
  put(turned, 0, 2, 1.f);
  overTheWire<CloudMessage>(xyz(1));
  const auto out = overTheWire<CloudMessage>(turned);
  ASSERT_EQ(out.points.size(), 1u);
  EXPECT_EQ(out.points[0].x, 1.f);
  EXPECT_EQ(out.points[0].z, 3.f);
}

TEST(CloudMessage, DriversTimesBecomeSecondsAfterTheStamp) {
  struct Case {
    const char* name;
    int type;
  };
  const auto timeOf = [](const Case& c, auto value) {
    auto cloud = cloudWith({{"x", 7}, {"y", 7}, {"z", 7}, {c.name, c.type}}, 1);
    put(cloud, 0, 3, value);
    return overTheWire<CloudMessage>(cloud).points.at(0).time;
  };
  EXPECT_FLOAT_EQ(timeOf({"time", PointField::FLOAT32}, -0.02f), -0.02f);
  EXPECT_FLOAT_EQ(timeOf({"t", PointField::UINT32}, std::uint32_t{50'000'000}), 0.05f);
  EXPECT_FLOAT_EQ(timeOf({"offset_time", PointField::UINT32}, std::uint32_t{1'000}), 1e-6f);
  EXPECT_FLOAT_EQ(timeOf({"time_offset", PointField::FLOAT32}, 0.01f), 0.01f);
  EXPECT_NEAR(timeOf({"timestamp", PointField::FLOAT64}, 1'600'000'000.000000007 + 0.1), 0.1f, 1e-6);
  EXPECT_FLOAT_EQ(timeOf({"timestamp", PointField::FLOAT64}, 0.1), 0.1f);
}

TEST(CloudMessage, RowsMayBePadded) {
  auto cloud = xyz(4);
  cloud.height = 2;
  cloud.width = 1;
  cloud.row_step = 24;
  put(cloud, 2, 0, 9.f);  // second row starts 24 bytes in
  const auto out = overTheWire<CloudMessage>(cloud);
  ASSERT_EQ(out.points.size(), 2u) << out.fault;
  EXPECT_EQ(out.points[1].x, 9.f);
}

TEST(CloudMessage, BigEndianIsTurned) {
  auto cloud = xyz(1);
  cloud.is_bigendian = true;
  const std::uint8_t one[] = {0x3f, 0x80, 0, 0};  // 1.0f, most significant byte first
  std::memcpy(&cloud.data[0], one, 4);
  EXPECT_EQ(overTheWire<CloudMessage>(cloud).points.at(0).x, 1.f);
}

TEST(CloudMessage, DisagreementIsNamedAndLeavesNoPoint) {
  const auto faultOf = [](auto damage) {
    auto cloud = xyz(2);
    damage(cloud);
    const auto out = overTheWire<CloudMessage>(cloud);
    EXPECT_TRUE(out.points.empty());
    return out.fault.substr(0, out.fault.find(':'));
  };
  EXPECT_EQ(faultOf([](PointCloud2& c) { c.width = c.height = 0xffffffff; }), "cloud sizes disagree");
  EXPECT_EQ(faultOf([](PointCloud2& c) { c.width = c.height = c.row_step = c.point_step = 0xffffffff; }),
            "cloud sizes disagree");
  EXPECT_EQ(faultOf([](PointCloud2& c) { c.data.pop_back(); }), "cloud sizes disagree");
  EXPECT_EQ(faultOf([](PointCloud2& c) {
              c = PointCloud2();
              c.width = c.height = 0xffffffff;
            }),
            "cloud sizes disagree");
  EXPECT_EQ(faultOf([](PointCloud2& c) { c.row_step = 1; }), "cloud sizes disagree");
  EXPECT_EQ(faultOf([](PointCloud2& c) { c.fields.pop_back(); }), "cloud field missing");
  EXPECT_EQ(faultOf([](PointCloud2& c) { c.fields[0].datatype = 77; }), "cloud field of unknown type");
  EXPECT_EQ(faultOf([](PointCloud2& c) { c.fields[2].offset = 0xfffffffe; }),
            "cloud field outside its point");
  EXPECT_EQ(faultOf([](PointCloud2& c) { c.fields[0].datatype = PointField::INT32; }),
            "cloud field is not a float");
}

TEST(CloudMessage, FieldCountBeyondTheMessageTakesNoMemory) {
  const auto bytes = ros::serialization::serializeMessage(PointCloud2());
  constexpr int kFields = 4 + 8 + 4 + 4 + 4;  // after seq, stamp, empty frame_id, height, width
  const std::uint32_t count = 0xffffffff;
  std::memcpy(bytes.message_start + kFields, &count, sizeof count);
  CloudMessage out;
  ros::serialization::IStream stream(bytes.message_start, bytes.num_bytes - 4);
  ros::serialization::deserialize(stream, out);
  EXPECT_EQ(out.fault.substr(0, out.fault.find(':')), "cloud claims too many fields");
}

TEST(CloudMessage, MessageThatEndsEarlyIsAFault) {
  const auto bytes = ros::serialization::serializeMessage(xyz(10));
  for (std::uint32_t length = 0; length + 4 < bytes.num_bytes; length += 5) {
    CloudMessage out;
    ros::serialization::IStream stream(bytes.message_start, length);
    ros::serialization::deserialize(stream, out);
    EXPECT_NE(out.fault, "") << "cut after " << length << " bytes";
  }
}

}  // namespace
}  // namespace field_fusion
