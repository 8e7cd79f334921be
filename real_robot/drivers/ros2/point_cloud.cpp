#include "real_robot/drivers/ros2/point_cloud.h"

#include <bit>

namespace swarmanoid::ros2
{
namespace
{

std::size_t SizeOf(PointCloud::Type type)
{
  return type == PointCloud::Type::kUint8 ? 1 : type == PointCloud::Type::kUint16 ? 2 : 4;
}

const char* NameOf(PointCloud::Type type)
{
  switch (type)
  {
    case PointCloud::Type::kUint8:
      return "uint8";
    case PointCloud::Type::kUint16:
      return "uint16";
    case PointCloud::Type::kUint32:
      return "uint32";
    case PointCloud::Type::kFloat32:
      break;
  }
  return "float32";
}

}  // namespace

PointCloud::PointCloud(const PointCloud2& cloud, const std::string& topic) : cloud_(cloud), topic_(topic)
{
  if (cloud.is_bigendian() != (std::endian::native == std::endian::big) ||
      cloud.row_step() < std::size_t{cloud.width()} * cloud.point_step() ||
      cloud.data().size() < std::size_t{cloud.height()} * cloud.row_step())
    throw DriverError(topic + ": the data do not fit height, row_step, point_step and byte order");
}

std::size_t PointCloud::OffsetOf(const std::string& name, std::initializer_list<Type> types, std::size_t count) const
{
  std::string wanted;
  for (const Type type : types)
  {
    wanted += (wanted.empty() ? "" : " or ") + std::string(NameOf(type));
    for (const auto& field : cloud_.fields())
      if (field.name() == name && field.datatype() == static_cast<std::uint8_t>(type) && field.count() >= count &&
          field.offset() + count * SizeOf(type) <= cloud_.point_step())
        return field.offset();
  }
  throw DriverError(topic_ + ": the points need the field " + name + " as " +
                    (count > 1 ? std::to_string(count) + " " : "") + wanted);
}

PointPlaces::PointPlaces(const PointCloud& cloud) : cloud_(cloud)
{
  constexpr const char* kNames[] = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis)
    offsets_[axis] = cloud.OffsetOf(kNames[axis], {PointCloud::Type::kFloat32});
}

Vector3 PointPlaces::At(std::size_t point) const
{
  float place[3];
  for (std::size_t axis = 0; axis < 3; ++axis) cloud_.Copy(point, offsets_[axis], &place[axis]);
  return {static_cast<double>(place[0]), static_cast<double>(place[1]), static_cast<double>(place[2])};
}

}  // namespace swarmanoid::ros2
