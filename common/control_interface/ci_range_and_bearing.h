// Range and bearing: robots broadcast a few bytes to all in line of sight and in range (3 m); receivers also learn from
// where. Type label "range_and_bearing", as an actuator (sends) and as a sensor (receives). Footbots, eyebots and
// handbots carry it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_RangeAndBearingActuator : public CCI_Actuator
{
public:
  static constexpr unsigned NUM_BYTES = 10;
  using Message = std::array<std::uint8_t, NUM_BYTES>;

  // Sends these bytes in every tick from now on; others receive them one tick later.
  virtual void SetMessage(const Message& message) = 0;
  virtual void StopSending() = 0;
};

class CCI_RangeAndBearingSensor : public CCI_Sensor
{
public:
  struct Packet
  {
    double range_m = 0;
    double bearing_rad = 0;           // of the sender, counter-clockwise from the receiver's front, -pi..pi
    double vertical_bearing_rad = 0;  // above the receiver's horizontal plane
    CCI_RangeAndBearingActuator::Message message{};
  };

  // All packets received in this tick, in no particular order, valid until the next control step.
  virtual std::span<const Packet> GetAllPackets() const = 0;

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    for (std::size_t i = 0; i < GetAllPackets().size(); ++i)
    {
      const Packet& packet = GetAllPackets()[i];
      const std::string name = "packet " + std::to_string(i);
      readings.push_back({name + " range", "m", packet.range_m});
      readings.push_back({name + " bearing", "rad", packet.bearing_rad});
      for (std::size_t byte = 0; byte < packet.message.size(); ++byte)
        if (packet.message[byte] != 0)
          readings.push_back({name + " byte " + std::to_string(byte), "", static_cast<double>(packet.message[byte])});
    }
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_RangeAndBearingActuator;
using swarmanoid::CCI_RangeAndBearingSensor;
