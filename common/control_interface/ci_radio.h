// A simple radio that sends packets of some bytes to all robots in range; bodies do not block them. The type label
// "radio" names an actuator (sends) and a sensor (receives). Footbots, eyebots and handbots can carry it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_RadioActuator : public CCI_ActuatorOf<CCI_RadioActuator>
{
public:
  static constexpr unsigned MAX_BYTES = 30;  // size limit of a packet

  // Sends a packet once: now, or as soon as the packets before it have been sent. Returns false and sends nothing if
  // too many packets wait. Throws std::length_error for more than MAX_BYTES.
  virtual bool Send(std::span<const std::uint8_t> bytes) = 0;
  // Returns the number of waiting packets.
  virtual unsigned GetWaiting() const = 0;

  static void Declare(Declaration& columns)
  {
    columns.Set({{"sending", "yes/no", 0, 1}, {"length", "", 0, MAX_BYTES}, ByteColumn()}, &SetNumbers, MAX_BYTES)
        .Add({.name = "waiting", .audience = CCI_Column::For::kPeople}, &CCI_RadioActuator::GetWaiting);
  }

private:
  // Sends a packet in each step while values[0] is above 0.5. The next value is the count of bytes, and the bytes
  // follow.
  static void SetNumbers(CCI_RadioActuator& radio, std::span<const double> values)
  {
    if (values[0] > 0.5) SendNumbers<MAX_BYTES>(values.subspan(1), [&](auto bytes) { radio.Send(bytes); });
  }
};

class CCI_RadioSensor : public CCI_SensorOf<CCI_RadioSensor>
{
public:
  struct Packet
  {
    std::string_view sender;  // id of the sender, valid as long as the sensor
    double signal_db = 0;  // strength relative to that at 1 m, for a field that falls with the square of the distance
    unsigned length = 0;
    std::array<std::uint8_t, CCI_RadioActuator::MAX_BYTES> bytes{};

    std::span<const std::uint8_t> Bytes() const { return {bytes.data(), length}; }
  };

  // Returns all packets that arrived in this tick, in the order of sending. Packets of one tick are in the order of the
  // entities in the experiment file. The span is valid until the next control step.
  virtual std::span<const Packet> GetAllPackets() const = 0;

  static void Declare(Declaration& columns)
  {
    columns
        .AddRows("packet", &CCI_RadioSensor::GetAllPackets, CCI_Field({"signal", "dB"}, &Packet::signal_db),
                 CCI_Field({"length", "", 0, CCI_RadioActuator::MAX_BYTES}, &Packet::length),
                 CCI_Field(ByteColumn(), &Packet::bytes))
        .AddRowIds(&CCI_RadioSensor::GetAllPackets, &Packet::sender);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_RadioActuator;
using swarmanoid::CCI_RadioSensor;
