#include "field_fusion/ros/cloud_layout.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

namespace field_fusion {
namespace {

using sensor_msgs::PointField;

/// Bytes of a PointField datatype, 0 for an unknown one.
std::uint32_t sizeOf(std::uint8_t datatype) {
  switch (datatype) {
    case PointField::INT8:
    case PointField::UINT8:
      return 1;
    case PointField::INT16:
    case PointField::UINT16:
      return 2;
    case PointField::INT32:
    case PointField::UINT32:
    case PointField::FLOAT32:
      return 4;
    case PointField::FLOAT64:
      return 8;
    default:
      return 0;
  }
}

template <class T>
double as(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

/// One field of a point, read as double whatever its type and byte order.
class FieldReader {
 public:
  FieldReader(const PointField& field, bool swap)
      : offset_(field.offset), type_(field.datatype), swap_(swap) {}

  double operator()(const std::uint8_t* point) const {
    std::uint8_t bytes[8] = {};
    const auto size = sizeOf(type_);
    std::memcpy(bytes, point + offset_, size);
    if (swap_) std::reverse(bytes, bytes + size);
    switch (type_) {
      case PointField::INT8:
        return as<std::int8_t>(bytes);
      case PointField::UINT8:
        return as<std::uint8_t>(bytes);
      case PointField::INT16:
        return as<std::int16_t>(bytes);
      case PointField::UINT16:
        return as<std::uint16_t>(bytes);
      case PointField::INT32:
        return as<std::int32_t>(bytes);
      case PointField::UINT32:
        return as<std::uint32_t>(bytes);
      case PointField::FLOAT32:
        return as<float>(bytes);
      default:
        return as<double>(bytes);
    }
  }
  bool isFloat() const { return type_ == PointField::FLOAT32 || type_ == PointField::FLOAT64; }

 private:
  std::uint32_t offset_;
  std::uint8_t type_;
  bool swap_;
};

const PointField* find(const CloudShape& shape, std::initializer_list<const char*> names) {
  for (const char* name : names)
    for (const auto& field : shape.fields)
      if (field.name == name) return &field;
  return nullptr;
}

std::optional<FieldReader> optionalReader(const CloudShape& shape, std::initializer_list<const char*> names) {
  const auto* field = find(shape, names);
  if (!field) return std::nullopt;
  if (sizeOf(field->datatype) == 0)
    throw std::runtime_error("cloud field of unknown type: '" + field->name + "' has datatype " +
                             std::to_string(field->datatype));
  if (std::uint64_t{field->offset} + sizeOf(field->datatype) > shape.point_step)
    throw std::runtime_error("cloud field outside its point: '" + field->name + "' at offset " +
                             std::to_string(field->offset) + " of point_step " +
                             std::to_string(shape.point_step));
  return FieldReader(*field, shape.is_bigendian);
}

FieldReader coordinateReader(const CloudShape& shape, const char* name) {
  const auto reader = optionalReader(shape, {name});
  if (!reader) throw std::runtime_error(std::string("cloud field missing: '") + name + "'");
  if (!reader->isFloat()) throw std::runtime_error(std::string("cloud field is not a float: '") + name + "'");
  return *reader;
}

void checkSizes(const CloudShape& shape, std::uint64_t size) {
  const std::uint64_t row = std::uint64_t{shape.width} * shape.point_step;  // below 2^64: 32 bit each
  // a row_step of 0 says nothing on a cloud of one row, and some drivers send it
  const bool row_unset = shape.row_step == 0 && shape.height == 1;
  const std::uint64_t row_step = row_unset ? row : shape.row_step;
  const auto number = [](std::uint64_t n) { return std::to_string(n); };
  if (row == 0 && shape.width > 0 && shape.height > 0)
    throw std::runtime_error("cloud sizes disagree: " + number(shape.width) + " x " + number(shape.height) +
                             " points of 0 bytes");
  if (row_step < row)
    throw std::runtime_error("cloud sizes disagree: row_step " + number(row_step) + " is shorter than " +
                             number(shape.width) + " points of " + number(shape.point_step) + " bytes");
  // row_step >= row, so the product overflows only where it exceeds any real size by far
  const bool overflow = shape.height != 0 && row_step > UINT64_MAX / shape.height;
  if (overflow || row_step * shape.height != size)
    throw std::runtime_error("cloud sizes disagree: height " + number(shape.height) + " x row_step " +
                             number(row_step) + " but " + number(size) + " bytes of data");
}

/// Our own layout needs no reading field by field.
bool isOwnLayout(const CloudShape& shape) {
  const auto& own = pointFields();
  return !shape.is_bigendian && shape.point_step == sizeof(core::Point) &&
         shape.fields.size() == own.size() &&
         std::equal(
             own.begin(), own.end(), shape.fields.begin(), [](const PointField& a, const PointField& b) {
               return a.name == b.name && a.offset == b.offset && a.datatype == b.datatype && b.count == 1;
             });
}

/// Seconds after the cloud's stamp.
float relativeTime(double value, bool is_float, double stamp) {
  constexpr double kAbsolute = 1e6;  // [s]: no scan is twelve days long
  if (!is_float) return static_cast<float>(value * 1e-9);
  return static_cast<float>(value > kAbsolute ? value - stamp : value);
}

core::Cloud readAnyLayout(const CloudShape& shape, const std::uint8_t* data) {
  const auto x = coordinateReader(shape, "x"), y = coordinateReader(shape, "y"),
             z = coordinateReader(shape, "z");
  const auto intensity = optionalReader(shape, {"intensity", "i"});
  const auto ring = optionalReader(shape, {"ring"});
  const auto time = optionalReader(shape, {"time", "t", "timestamp", "time_offset", "offset_time"});
  const std::uint64_t row_step =
      shape.row_step ? shape.row_step : std::uint64_t{shape.width} * shape.point_step;
  core::Cloud cloud(std::size_t{shape.width} * shape.height);
  auto* out = cloud.data();
  for (std::uint32_t row = 0; row < shape.height; ++row) {
    const std::uint8_t* point = data + row * row_step;
    for (std::uint32_t column = 0; column < shape.width; ++column, point += shape.point_step, ++out) {
      out->x = static_cast<float>(x(point));
      out->y = static_cast<float>(y(point));
      out->z = static_cast<float>(z(point));
      if (intensity) out->intensity = static_cast<float>((*intensity)(point));
      if (ring) out->ring = static_cast<std::uint16_t>((*ring)(point));
      if (time) out->time = relativeTime((*time)(point), time->isFloat(), shape.stamp);
    }
  }
  return cloud;
}

}  // namespace

const std::vector<PointField>& pointFields() {
  static const auto fields = [] {
    std::vector<PointField> out;
    const auto add = [&](const char* name, std::size_t offset, std::uint8_t datatype) {
      out.emplace_back();
      out.back().name = name;
      out.back().offset = static_cast<std::uint32_t>(offset);
      out.back().datatype = datatype;
      out.back().count = 1;
    };
    add("x", offsetof(core::Point, x), PointField::FLOAT32);
    add("y", offsetof(core::Point, y), PointField::FLOAT32);
    add("z", offsetof(core::Point, z), PointField::FLOAT32);
    add("intensity", offsetof(core::Point, intensity), PointField::FLOAT32);
    add("time", offsetof(core::Point, time), PointField::FLOAT32);
    add("ring", offsetof(core::Point, ring), PointField::UINT16);
    return out;
  }();
  return fields;
}

void checkFieldCount(const std::uint8_t* data, std::uint64_t size) {
  constexpr std::uint64_t kLeast = 13;  // bytes of a field without a name
  std::uint32_t count = 0;
  if (size < sizeof count) throw std::runtime_error("cloud ends early: before its fields");
  std::memcpy(&count, data, sizeof count);
  if (count > size / kLeast)
    throw std::runtime_error("cloud claims too many fields: " + std::to_string(count) + " in " +
                             std::to_string(size) + " bytes");
}

core::Cloud readPoints(const CloudShape& shape, const std::uint8_t* data, std::uint64_t size) {
  checkSizes(shape, size);
  if (size == 0) return {};
  if (!isOwnLayout(shape) || shape.row_step > std::uint64_t{shape.width} * shape.point_step)
    return readAnyLayout(shape, data);
  core::Cloud cloud(size / sizeof(core::Point));
  std::memcpy(cloud.data(), data, size);
  return cloud;
}

}  // namespace field_fusion
