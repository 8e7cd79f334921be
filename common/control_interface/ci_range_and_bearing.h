// Range and bearing: robots broadcast a few bytes to all robots in line of sight and in range (3 m). Receivers also get
// the position of the sender. The type label "range_and_bearing" names an actuator (sends) and a sensor (receives).
// Footbots, eyebots and handbots can carry it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_RangeAndBearingActuator : public CCI_ActuatorOf<CCI_RangeAndBearingActuator>
{
public:
  static constexpr unsigned NUM_BYTES = 10;
  using Message = std::array<std::uint8_t, NUM_BYTES>;

  // Sends these bytes in every tick from now on; others receive them one tick later.
  virtual void SetMessage(const Message& message) = 0;
  // Stops sending from this tick on.
  virtual void StopSending() = 0;
  // Returns the number of bytes of a message: NUM_BYTES, or more if the experiment file gives the actuator more
  // ("bytes").
  virtual unsigned GetNumBytes() const { return NUM_BYTES; }
  // Works as SetMessage for a message of any length up to GetNumBytes(); zeros follow. Throws std::length_error for
  // more bytes.
  virtual void SetBytes(std::span<const std::uint8_t> bytes)
  {
    RequireLength(bytes.size());
    Message message{};
    std::copy_n(bytes.begin(), std::min(bytes.size(), message.size()), message.begin());
    SetMessage(message);
  }

  static void Declare(Declaration& columns)
  {
    columns.Set({{"sending", "yes/no", 0, 1}, ByteColumn()}, &SetNumbers, &CCI_RangeAndBearingActuator::GetNumBytes);
  }

protected:
  static void SetNumbers(CCI_RangeAndBearingActuator& sender, std::span<const double> values)
  {
    if (!(values[0] > 0.5)) return sender.StopSending();
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(std::clamp(values[1 + i], 0.0, 255.0)); };
    Message message{};
    for (std::size_t i = 0; i < message.size(); ++i) message[i] = byte(i);
    if (values.size() == 1 + message.size()) return sender.SetMessage(message);
    std::vector<std::uint8_t> bytes(values.size() - 1);
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = byte(i);
    sender.SetBytes(bytes);
  }
  void RequireLength(std::size_t bytes) const
  {
    if (bytes > GetNumBytes())
      throw std::length_error("a message of range and bearing has " + std::to_string(GetNumBytes()) + " bytes, and " +
                              std::to_string(bytes) + " are given");
  }
};

class CCI_RangeAndBearingSensor : public CCI_SensorOf<CCI_RangeAndBearingSensor>
{
public:
  struct Packet
  {
    double range_m = 0;
    double bearing_rad = 0;           // direction of the sender, counter-clockwise from the receiver's front, -pi..pi
    double vertical_bearing_rad = 0;  // angle of the sender above the receiver's horizontal plane
    CCI_RangeAndBearingActuator::Message message{};
    std::uint32_t further = 0;  // position of the further bytes, for GetFurtherBytes
  };

  // Returns all packets received in this tick, in no particular order, valid until the next control step.
  virtual std::span<const Packet> GetAllPackets() const = 0;
  // Returns the bytes of a packet after its first NUM_BYTES, or none if its sender has no longer messages. The span is
  // valid as long as the packets.
  virtual std::span<const std::uint8_t> GetFurtherBytes(const Packet&) const { return {}; }
  // Returns the number of further bytes in the longest message that any robot of the experiment can send.
  virtual unsigned GetMostFurtherBytes() const { return 0; }

  static void Declare(Declaration& columns)
  {
    // Each packet has the same number of columns, so that rows are equally long.
    const auto further = [](const CCI_RangeAndBearingSensor& sensor, const Packet& packet)
    {
      const std::span<const std::uint8_t> bytes = sensor.GetFurtherBytes(packet);
      std::vector<std::uint8_t> all(bytes.begin(), bytes.end());
      all.resize(sensor.GetMostFurtherBytes());
      return all;
    };
    const auto count = [](const CCI_RangeAndBearingSensor& sensor, const Packet& packet)
    { return sensor.GetFurtherBytes(packet).size(); };
    columns.AddRows("packet", &CCI_RangeAndBearingSensor::GetAllPackets, CCI_Field({"range", "m", 0}, &Packet::range_m),
                    CCI_Field({"bearing", "rad"}, &Packet::bearing_rad),
                    CCI_Field({"vertical bearing", "rad"}, &Packet::vertical_bearing_rad),
                    CCI_Field(ByteColumn(), &Packet::message),
                    CCI_Field({"further byte #", "", 0, 255, false, false, CCI_Column::For::kPrograms}, further),
                    CCI_Field({"further bytes", "", 0, 1e9, false, true, CCI_Column::For::kPeople}, count));
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_RangeAndBearingActuator;
using swarmanoid::CCI_RangeAndBearingSensor;
