// Range and bearing: robots broadcast a few bytes to all in line of sight and in range (3 m); receivers also learn from
// where. Type label "range_and_bearing", as an actuator (sends) and as a sensor (receives). Footbots, eyebots and
// handbots carry it.
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

class CCI_RangeAndBearingActuator : public CCI_Actuator
{
public:
  static constexpr unsigned NUM_BYTES = 10;
  using Message = std::array<std::uint8_t, NUM_BYTES>;

  // Sends these bytes in every tick from now on; others receive them one tick later.
  virtual void SetMessage(const Message& message) = 0;
  virtual void StopSending() = 0;
  // Of a message: NUM_BYTES, or more if the experiment file gives the actuator more ("bytes").
  virtual unsigned GetNumBytes() const { return NUM_BYTES; }
  // SetMessage of any length up to GetNumBytes(); zeros follow. Throws std::length_error for more.
  virtual void SetBytes(std::span<const std::uint8_t> bytes)
  {
    RequireLength(bytes.size());
    Message message{};
    std::copy(bytes.begin(), bytes.end(), message.begin());
    SetMessage(message);
  }

  // Whether it sends, and the first NUM_BYTES of what.
  std::vector<CCI_Column> Columns() const override
  {
    std::vector<CCI_Column> columns{{"sending", "yes/no", 0, 1}};
    for (CCI_Column& byte : NumberedColumns(NUM_BYTES, "byte ", {{}, {}, 0, 255})) columns.push_back(std::move(byte));
    return columns;
  }
  void SetColumns(std::span<const double> values) override
  {
    if (!(values[0] > 0.5)) return StopSending();
    Message message{};
    for (std::size_t i = 0; i < message.size(); ++i)
      message[i] = static_cast<std::uint8_t>(std::clamp(values[1 + i], 0.0, 255.0));
    SetMessage(message);
  }

protected:
  void RequireLength(std::size_t bytes) const
  {
    if (bytes > GetNumBytes())
      throw std::length_error("a message of range and bearing has " + std::to_string(GetNumBytes()) + " bytes, and " +
                              std::to_string(bytes) + " are given");
  }
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
    std::uint32_t further = 0;  // for GetFurtherBytes
  };

  // All packets received in this tick, in no particular order, valid until the next control step.
  virtual std::span<const Packet> GetAllPackets() const = 0;
  // The bytes of a packet behind its first NUM_BYTES: none if its sender has no longer messages. Valid as the packets.
  virtual std::span<const std::uint8_t> GetFurtherBytes(const Packet&) const { return {}; }

  // A packet with its first NUM_BYTES.
  std::vector<CCI_Column> Rows() const override
  {
    std::vector<CCI_Column> columns{{"range", "m", 0}, {"bearing", "rad"}, {"vertical bearing", "rad"}};
    for (CCI_Column& byte : NumberedColumns(CCI_RangeAndBearingActuator::NUM_BYTES, "byte ", {{}, {}, 0, 255}))
      columns.push_back(std::move(byte));
    return columns;
  }
  void ReadRows(std::vector<double>& values) const override
  {
    for (const Packet& packet : GetAllPackets())
    {
      values.insert(values.end(), {packet.range_m, packet.bearing_rad, packet.vertical_bearing_rad});
      values.insert(values.end(), packet.message.begin(), packet.message.end());
    }
  }
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
      if (const std::size_t further = GetFurtherBytes(packet).size(); further != 0)
        readings.push_back({name + " further bytes", "", static_cast<double>(further)});
    }
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_RangeAndBearingActuator;
using swarmanoid::CCI_RangeAndBearingSensor;
