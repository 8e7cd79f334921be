// A simple radio: packets of some bytes to all in range, through whatever stands between. Type label "radio", as an
// actuator (sends) and as a sensor (receives). Footbots, eyebots and handbots carry it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_RadioActuator : public CCI_Actuator
{
public:
  static constexpr unsigned MAX_BYTES = 30;  // of a packet

  // Sends a packet once: now, or as soon as the packets before it are on the air. False, and nothing is sent, if too
  // many wait. Throws std::length_error for more than MAX_BYTES.
  virtual bool Send(std::span<const std::uint8_t> bytes) = 0;
  // Packets that wait.
  virtual unsigned GetWaiting() const = 0;

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    readings.push_back({"waiting", "", static_cast<double>(GetWaiting())});
  }
};

class CCI_RadioSensor : public CCI_Sensor
{
public:
  struct Packet
  {
    std::string_view sender;  // its id, valid as long as the sensor
    double signal_db = 0;     // strength over that at 1 m, of a field that falls with the square of the distance
    unsigned length = 0;
    std::array<std::uint8_t, CCI_RadioActuator::MAX_BYTES> bytes{};

    std::span<const std::uint8_t> Bytes() const { return {bytes.data(), length}; }
  };

  // All packets that arrived in this tick, in the order in which they were sent and, of one tick, of the entities in
  // the experiment file. Valid until the next control step.
  virtual std::span<const Packet> GetAllPackets() const = 0;

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    for (const Packet& packet : GetAllPackets())
      readings.push_back({"bytes from " + std::string(packet.sender), "", static_cast<double>(packet.length)});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_RadioActuator;
using swarmanoid::CCI_RadioSensor;
