// An antenna that reads the radio tags (RFID) near a robot.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_TagReaderSensor : public CCI_Sensor
{
public:
  struct Tag
  {
    std::string_view id;    // of the entity that has the tag, valid as long as the sensor
    double distance_m = 0;  // from the antenna to its position, as the strength of its answer tells it
  };

  // All tags that answered in this tick, in no particular order, valid until the next control step.
  virtual std::span<const Tag> GetAllTags() const = 0;

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    for (const Tag& tag : GetAllTags()) readings.push_back({std::string(tag.id), "m", tag.distance_m});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_TagReaderSensor;
