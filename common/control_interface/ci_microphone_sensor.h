// What a robot hears of the sound sources of the arena.
#pragma once

#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_MicrophoneSensor : public CCI_Sensor
{
public:
  struct Sound
  {
    double loudness = 0;       // sound pressure: 1 is that of a source of intensity 1 at 1 m
    double bearing_rad = 0;    // of the source, counter-clockwise from the front, -pi..pi
    double elevation_rad = 0;  // above the horizontal plane of the robot
  };

  // The pressure of all sounds together, in the unit of Sound::loudness; 20 log10 of it are decibels. 0: silence.
  virtual double GetLoudness() const = 0;
  // Each source that is heard, if the implementation tells them apart; in no particular order, valid until the next
  // control step.
  virtual std::span<const Sound> GetAllSounds() const = 0;

  std::vector<CCI_Column> Columns() const override { return {{"loudness", "", 0}}; }
  void ReadColumns(std::vector<double>& values) const override { values.push_back(GetLoudness()); }
  std::vector<CCI_Column> Rows() const override
  {
    return {{"loudness", "", 0}, {"bearing", "rad"}, {"elevation", "rad"}};
  }
  void ReadRows(std::vector<double>& values) const override
  {
    for (const Sound& sound : GetAllSounds())
      values.insert(values.end(), {sound.loudness, sound.bearing_rad, sound.elevation_rad});
  }
  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    readings.push_back({"loudness", "", GetLoudness()});
    for (std::size_t i = 0; i < GetAllSounds().size(); ++i)
    {
      const Sound& sound = GetAllSounds()[i];
      const std::string name = "sound " + std::to_string(i);
      readings.push_back({name + " loudness", "", sound.loudness});
      readings.push_back({name + " bearing", "rad", sound.bearing_rad});
    }
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_MicrophoneSensor;
