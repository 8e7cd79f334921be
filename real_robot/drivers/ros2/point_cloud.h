// Reads the points of sensor_msgs/msg/PointCloud2, whose fields may have any position in a point.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>

#include "common/math/pose.h"
#include "real_robot/drivers/ros2/ros2_messages.h"

namespace swarmanoid::ros2
{

using PointCloud2 = sensor_msgs::msg::dds_::PointCloud2_;

class PointCloud
{
public:
  // The types, with the numbers of sensor_msgs/msg/PointField.
  enum class Type : std::uint8_t
  {
    kUint8 = 2,
    kUint16 = 4,
    kUint32 = 6,
    kFloat32 = 7
  };

  // `cloud` must not change while this object lives. Throws DriverError with the name of the topic if its data have the
  // wrong length or the other byte order.
  PointCloud(const PointCloud2& cloud, const std::string& topic);

  std::size_t Size() const { return std::size_t{cloud_.height()} * cloud_.width(); }
  // Returns the bytes from the start of a point to a field with `count` values of one of these types. Throws
  // DriverError if the points have no such field.
  std::size_t OffsetOf(const std::string& name, std::initializer_list<Type> types, std::size_t count = 1) const;
  // Returns `count` values of a point.
  template <class Value>
  void Copy(std::size_t point, std::size_t offset, Value* values, std::size_t count = 1) const
  {
    std::memcpy(values, Bytes(point) + offset, count * sizeof(Value));
  }

private:
  const std::uint8_t* Bytes(std::size_t point) const
  {
    return cloud_.data().data() + point / cloud_.width() * cloud_.row_step() +
           point % cloud_.width() * cloud_.point_step();
  }

  const PointCloud2& cloud_;
  std::string topic_;
};

// Reads the fields x, y and z (float32, m).
class PointPlaces
{
public:
  explicit PointPlaces(const PointCloud& cloud);
  // Returns the position of a point in metres.
  Vector3 At(std::size_t point) const;

private:
  const PointCloud& cloud_;
  std::array<std::size_t, 3> offsets_;
};

}  // namespace swarmanoid::ros2
