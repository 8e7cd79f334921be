// CCI_MicrophoneSensor: the sound sources of the arena that a robot hears.
#pragma once

#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_MicrophoneSensor : public CCI_SensorOf<CCI_MicrophoneSensor>
{
public:
  struct Sound
  {
    double loudness = 0;       // sound pressure; a source of intensity 1 at a distance of 1 m has 1
    double bearing_rad = 0;    // direction of the source, counter-clockwise from the front, -pi..pi
    double elevation_rad = 0;  // angle above the horizontal plane of the robot
  };

  // Returns the pressure of all sounds together, in the unit of Sound::loudness; 20 log10 of it are decibels. 0:
  // silence.
  virtual double GetLoudness() const = 0;
  // Returns the heard sources if the implementation separates them, in no particular order. The span is valid until the
  // next control step.
  virtual std::span<const Sound> GetAllSounds() const = 0;

  static void Declare(Declaration& columns)
  {
    columns.Add({"loudness", "", 0}, &CCI_MicrophoneSensor::GetLoudness)
        .AddRows("sound", &CCI_MicrophoneSensor::GetAllSounds, CCI_Field({"loudness", "", 0}, &Sound::loudness),
                 CCI_Field({"bearing", "rad"}, &Sound::bearing_rad),
                 CCI_Field({"elevation", "rad"}, &Sound::elevation_rad));
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_MicrophoneSensor;
