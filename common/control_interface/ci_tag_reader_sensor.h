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

  std::vector<CCI_Column> Rows() const override { return {{"distance", "m", 0}}; }
  void ReadRows(std::vector<double>& values) const override
  {
    for (const Tag& tag : GetAllTags()) values.push_back(tag.distance_m);
  }
  void ReadRowIds(std::vector<std::string>& ids) const override
  {
    for (const Tag& tag : GetAllTags()) ids.emplace_back(tag.id);
  }
  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    for (const Tag& tag : GetAllTags()) readings.push_back({std::string(tag.id), "m", tag.distance_m});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_TagReaderSensor;
