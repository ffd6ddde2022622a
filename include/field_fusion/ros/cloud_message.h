#pragma once
// A core cloud with a header that roscpp sends and receives as sensor_msgs/PointCloud2. Between
// nodelets of one manager the pointer itself travels; stamps stay exact; every size is checked on reading.
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <sensor_msgs/PointCloud2.h>

#include <string>

#include "field_fusion/core/base/types.h"
#include "field_fusion/ros/cloud_layout.h"

namespace field_fusion {

struct CloudMessage {
  std_msgs::Header header;
  core::Cloud points;
  std::string fault;  ///< why the received bytes could not be read ("what: details"); empty when all is well

  using Ptr = boost::shared_ptr<CloudMessage>;
  using ConstPtr = boost::shared_ptr<const CloudMessage>;
};

/// Uniform for all messages: what was found wrong on the way in.
inline const std::string& faultOf(const CloudMessage& message) { return message.fault; }

}  // namespace field_fusion

namespace ros {
namespace message_traits {

template <>
struct MD5Sum<field_fusion::CloudMessage> : MD5Sum<sensor_msgs::PointCloud2> {
  static const char* value() { return MD5Sum<sensor_msgs::PointCloud2>::value(); }
  static const char* value(const field_fusion::CloudMessage&) { return value(); }
};
template <>
struct DataType<field_fusion::CloudMessage> {
  static const char* value() { return DataType<sensor_msgs::PointCloud2>::value(); }
  static const char* value(const field_fusion::CloudMessage&) { return value(); }
};
template <>
struct Definition<field_fusion::CloudMessage> {
  static const char* value() { return Definition<sensor_msgs::PointCloud2>::value(); }
  static const char* value(const field_fusion::CloudMessage&) { return value(); }
};
template <>
struct HasHeader<field_fusion::CloudMessage> : TrueType {};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<field_fusion::CloudMessage> {
  template <class Stream>
  static void write(Stream& stream, const field_fusion::CloudMessage& m) {
    const auto width = static_cast<std::uint32_t>(m.points.size());
    const auto step = static_cast<std::uint32_t>(sizeof(field_fusion::core::Point));
    const std::uint32_t size = width * step;
    stream.next(m.header);
    stream.next(std::uint32_t{1});
    stream.next(width);
    stream.next(field_fusion::pointFields());
    stream.next(std::uint8_t{0});
    stream.next(step);
    stream.next(size);
    stream.next(size);
    if (size > 0) std::memcpy(stream.advance(size), m.points.data(), size);
    stream.next(std::uint8_t{0});  // points may be NaN
  }

  template <class Stream>
  static void read(Stream& stream, field_fusion::CloudMessage& m) {
    try {
      field_fusion::CloudShape shape;
      std::uint8_t flag = 0;
      std::uint32_t size = 0;
      stream.next(m.header);
      stream.next(shape.height);
      stream.next(shape.width);
      field_fusion::checkFieldCount(stream.getData(), stream.getLength());
      stream.next(shape.fields);
      stream.next(flag);
      stream.next(shape.point_step);
      stream.next(shape.row_step);
      stream.next(size);
      const std::uint8_t* data = stream.advance(size);
      shape.stamp = m.header.stamp.toSec();
      shape.is_bigendian = flag != 0;
      m.points = field_fusion::readPoints(shape, data, size);
      stream.next(flag);                 // is_dense: not believed, every stage looks at each point
    } catch (const std::exception& e) {  // also a stream that ends early; the stage counts it
      m.points.clear();
      m.fault = e.what();
    }
  }

  static std::uint32_t serializedLength(const field_fusion::CloudMessage& m) {
    constexpr std::uint32_t kFixed = 4 + 4 + 1 + 4 + 4 + 4 + 1;  // height .. data length, is_dense
    return serializationLength(m.header) + serializationLength(field_fusion::pointFields()) + kFixed +
           static_cast<std::uint32_t>(m.points.size() * sizeof(field_fusion::core::Point));
  }
};

}  // namespace serialization

namespace message_operations {

template <>
struct Printer<field_fusion::CloudMessage> {
  template <class Stream>
  static void stream(Stream& s, const std::string& indent, const field_fusion::CloudMessage& m) {
    s << indent << m.points.size() << " points\n";
  }
};

}  // namespace message_operations
}  // namespace ros
