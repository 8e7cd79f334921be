// CCI_TagReaderSensor: an antenna that reads the radio tags (RFID) near a robot.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_TagReaderSensor : public CCI_SensorOf<CCI_TagReaderSensor>
{
public:
  struct Tag
  {
    std::string_view id;    // id of the entity that has the tag, valid as long as the sensor
    double distance_m = 0;  // distance from the antenna to the tag, estimated from the strength of its answer
  };

  // Returns all tags that answered in this tick, in no particular order, valid until the next control step.
  virtual std::span<const Tag> GetAllTags() const = 0;

  static void Declare(Declaration& columns)
  {
    columns.AddRows("tag", &CCI_TagReaderSensor::GetAllTags, CCI_Field({"distance", "m", 0}, &Tag::distance_m))
        .AddRowIds(&CCI_TagReaderSensor::GetAllTags, &Tag::id);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_TagReaderSensor;
