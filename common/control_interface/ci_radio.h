// A simple radio: packets of some bytes to all in range, through whatever stands between. Type label "radio", as an
// actuator (sends) and as a sensor (receives). Footbots, eyebots and handbots carry it.
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

class CCI_RadioActuator : public CCI_Actuator
{
public:
  static constexpr unsigned MAX_BYTES = 30;  // of a packet

  // Sends a packet once: now, or as soon as the packets before it are on the air. False, and nothing is sent, if too
  // many wait. Throws std::length_error for more than MAX_BYTES.
  virtual bool Send(std::span<const std::uint8_t> bytes) = 0;
  // Packets that wait.
  virtual unsigned GetWaiting() const = 0;

  // A packet in each step while it is sending: so many of the bytes behind that.
  std::vector<CCI_Column> Columns() const override
  {
    std::vector<CCI_Column> columns{{"sending", "yes/no", 0, 1}, {"length", "", 0, MAX_BYTES}};
    for (CCI_Column& byte : NumberedColumns(MAX_BYTES, "byte ", {{}, {}, 0, 255})) columns.push_back(std::move(byte));
    return columns;
  }
  void SetColumns(std::span<const double> values) override
  {
    if (!(values[0] > 0.5)) return;
    std::array<std::uint8_t, MAX_BYTES> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = static_cast<std::uint8_t>(std::clamp(values[2 + i], 0.0, 255.0));
    const auto length = static_cast<std::size_t>(std::clamp(values[1], 0.0, double{MAX_BYTES}));
    Send(std::span(bytes).first(length));
  }
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

  std::vector<CCI_Column> Rows() const override
  {
    std::vector<CCI_Column> columns{{"signal", "dB"}, {"length", "", 0, CCI_RadioActuator::MAX_BYTES}};
    for (CCI_Column& byte : NumberedColumns(CCI_RadioActuator::MAX_BYTES, "byte ", {{}, {}, 0, 255}))
      columns.push_back(std::move(byte));
    return columns;
  }
  void ReadRows(std::vector<double>& values) const override
  {
    for (const Packet& packet : GetAllPackets())
    {
      values.insert(values.end(), {packet.signal_db, static_cast<double>(packet.length)});
      values.insert(values.end(), packet.bytes.begin(), packet.bytes.end());
    }
  }
  void ReadRowIds(std::vector<std::string>& ids) const override
  {
    for (const Packet& packet : GetAllPackets()) ids.emplace_back(packet.sender);
  }
  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    for (const Packet& packet : GetAllPackets())
      readings.push_back({"bytes from " + std::string(packet.sender), "", static_cast<double>(packet.length)});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_RadioActuator;
using swarmanoid::CCI_RadioSensor;
