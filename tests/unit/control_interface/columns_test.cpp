// The declaration of an interface, and what programs and people get of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "common/control_interface/ci_device.h"
#include "common/control_interface/ci_radio.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/control_interface/eyebot/ci_eyebot_laser_actuator.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kFar = std::numeric_limits<double>::infinity();

struct Spot
{
  std::string id;
  double distance_m;
  std::array<std::uint8_t, 2> bytes;
};

class CCI_SpotSensor : public CCI_SensorOf<CCI_SpotSensor>
{
public:
  double GetLevel() const { return level; }
  bool IsOn() const { return on; }
  const std::vector<double>& GetRing() const { return ring; }
  const std::vector<std::uint8_t>& GetBytes() const { return bytes; }
  const std::vector<Spot>& GetSpots() const { return spots; }

  static void Declare(Declaration& columns)
  {
    columns.Add({.name = "level", .unit = "m", .may_be_infinite = true}, &CCI_SpotSensor::GetLevel)
        .Add({"on", "yes/no", 0, 1}, &CCI_SpotSensor::IsOn)
        .Add({"ring #"}, &CCI_SpotSensor::GetRing)
        .Add(ByteColumn(), &CCI_SpotSensor::GetBytes, 3)
        .AddEach(&CCI_SpotSensor::GetSpots,
                 CCI_Field({.name = "spot # distance", .audience = CCI_Column::For::kPrograms}, &Spot::distance_m))
        .Add({.name = "twice", .audience = CCI_Column::For::kPeople},
             [](const CCI_SpotSensor& sensor) { return 2 * sensor.level; })
        .AddRows("spot", &CCI_SpotSensor::GetSpots, CCI_Field({"distance", "m"}, &Spot::distance_m),
                 CCI_Field(ByteColumn(), &Spot::bytes))
        .AddRowIds(&CCI_SpotSensor::GetSpots, &Spot::id);
  }

  double level = 4;
  bool on = true;
  std::vector<double> ring{1, 2};
  std::vector<std::uint8_t> bytes{7};
  std::vector<Spot> spots{{"a", 0.5, {9, 0}}};
};

class CCI_LampActuator : public CCI_ActuatorOf<CCI_LampActuator>
{
public:
  void Set(double level, std::uint32_t colour) { told = {level, static_cast<double>(colour)}; }
  static void Declare(Declaration& columns)
  {
    columns.Set({{"level", "V"}, {"colour", "colour", 0, 0xffffff}}, &CCI_LampActuator::Set);
  }
  std::vector<double> told;

protected:
  void ReadSettings(std::vector<double>& values) const override
  {
    values.insert(values.end(), told.begin(), told.end());
  }
};

struct Laser : CCI_EyeBotLaserActuator
{
  void SwitchOn() override { told.push_back("on"); }
  void SwitchOff() override { told.push_back("off"); }
  void SetColour(std::uint32_t colour) override { told.push_back("colour " + std::to_string(colour)); }
  void SetDirection(double pan, double tilt) override
  {
    told.push_back("pan " + std::to_string(pan) + ", tilt " + std::to_string(tilt));
  }
  std::vector<std::string> told;
};

struct Radio : CCI_RadioActuator
{
  bool Send(std::span<const std::uint8_t> bytes) override
  {
    sent.emplace_back(bytes.begin(), bytes.end());
    return true;
  }
  unsigned GetWaiting() const override { return 0; }
  std::vector<std::vector<int>> sent;
};

std::vector<std::string> NamesOf(const std::vector<CCI_Column>& columns)
{
  std::vector<std::string> names;
  for (const CCI_Column& column : columns) names.push_back(column.Title());
  return names;
}

std::vector<std::string> ShownOf(const CCI_Device& device)
{
  std::vector<CCI_Reading> readings;
  device.Describe(readings);
  std::vector<std::string> names;
  for (const CCI_Reading& reading : readings) names.push_back(reading.name);
  return names;
}

TEST(Columns, ProgramsGetANumberForEachName)
{
  const CCI_SpotSensor sensor;
  EXPECT_THAT(NamesOf(sensor.Columns()),
              ElementsAre("level [m]", "on", "ring 0", "ring 1", "byte 0", "byte 1", "byte 2", "spot 0 distance"));
  std::vector<double> values;
  sensor.ReadColumns(values);
  EXPECT_THAT(values, ElementsAre(4, 1, 1, 2, 7, 0, 0, 0.5));
  EXPECT_THAT(NamesOf(sensor.Rows()), ElementsAre("distance [m]", "byte 0", "byte 1"));
  values.clear();
  sensor.ReadRows(values);
  EXPECT_THAT(values, ElementsAre(0.5, 9, 0));
  std::vector<std::string> ids;
  sensor.ReadRowIds(ids);
  EXPECT_THAT(ids, ElementsAre("a"));
}

TEST(Columns, PeopleAreNotShownZerosAndInfinityOfColumnsThatSaySo)
{
  CCI_SpotSensor sensor;
  EXPECT_THAT(ShownOf(sensor),
              ElementsAre("level", "on", "ring 0", "ring 1", "byte 0", "twice", "spot a distance", "spot a byte 0"));
  sensor.level = kFar;
  sensor.bytes.clear();
  sensor.spots.clear();
  EXPECT_THAT(ShownOf(sensor), ElementsAre("on", "ring 0", "ring 1", "twice"));
}

TEST(Columns, AnActuatorTakesANumberForEachNameAndShowsWhatItWasTold)
{
  CCI_LampActuator lamp;
  EXPECT_THAT(NamesOf(lamp.Columns()), ElementsAre("level [V]", "colour"));
  EXPECT_THAT(ShownOf(lamp), IsEmpty());
  lamp.SetColumns(std::vector<double>{3, 1e9});
  EXPECT_THAT(lamp.told, ElementsAre(3, 0xffffff));
  EXPECT_THAT(ShownOf(lamp), ElementsAre("level", "colour"));
}

TEST(Columns, OfALaserAreWhetherItIsOnItsColourPanAndTilt)
{
  Laser laser;
  EXPECT_THAT(NamesOf(laser.Columns()), ElementsAre("on", "colour", "pan [rad]", "tilt [rad]"));
  laser.SetColumns(std::vector<double>{1, 5, 0.5, 0.25});
  EXPECT_THAT(laser.told, ElementsAre("on", "colour 5", "pan 0.500000, tilt 0.250000"));
}

TEST(Columns, OfARadioSendPacketsOfAnyLength)
{
  Radio radio;
  std::vector<double> packet(2 + Radio::MAX_BYTES, 7);
  for (const double length : {0.0, 1.0, 3.0})
  {
    packet[0] = 1;
    packet[1] = length;
    radio.SetColumns(packet);
  }
  packet[0] = 0;
  radio.SetColumns(packet);
  EXPECT_THAT(radio.sent, ElementsAre(IsEmpty(), ElementsAre(7), ElementsAre(7, 7, 7)));
}

TEST(Columns, ADeviceThatDeclaresNothingHasNone)
{
  const CCI_Sensor sensor;
  EXPECT_THAT(sensor.Columns(), IsEmpty());
  EXPECT_THAT(sensor.Rows(), IsEmpty());
  EXPECT_THAT(ShownOf(sensor), IsEmpty());
}

class LongReceiver : public CCI_RangeAndBearingSensor
{
public:
  std::span<const Packet> GetAllPackets() const override { return packets; }
  unsigned GetMostFurtherBytes() const override { return 3; }
  std::span<const std::uint8_t> GetFurtherBytes(const Packet&) const override { return further; }
  std::vector<Packet> packets{{.range_m = 2, .bearing_rad = 1, .message = {5}}};
  std::vector<std::uint8_t> further{6, 7};
};

TEST(Columns, LongMessagesAreReadWhole)
{
  const LongReceiver receiver;
  const std::vector<std::string> names = NamesOf(receiver.Rows());
  EXPECT_EQ(names.size(), 16);
  EXPECT_EQ(names.back(), "further byte 2");
  std::vector<double> values;
  receiver.ReadRows(values);
  EXPECT_THAT(values, ElementsAre(2, 1, 0, 5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 6, 7, 0));
  EXPECT_THAT(ShownOf(receiver), ElementsAre("packet 0 range", "packet 0 bearing", "packet 0 vertical bearing",
                                             "packet 0 byte 0", "packet 0 further bytes"));
}

class LongSender : public CCI_RangeAndBearingActuator
{
public:
  void SetMessage(const Message&) override {}
  void StopSending() override { sent.clear(); }
  unsigned GetNumBytes() const override { return 12; }
  void SetBytes(std::span<const std::uint8_t> bytes) override { sent.assign(bytes.begin(), bytes.end()); }
  std::vector<int> sent;
};

TEST(Columns, LongMessagesAreSentWhole)
{
  LongSender sender;
  std::vector<double> values(sender.Columns().size(), 1);
  EXPECT_EQ(values.size(), 13);
  values.back() = 300;
  sender.SetColumns(values);
  EXPECT_THAT(sender.sent, ElementsAre(1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 255));
}

}  // namespace
}  // namespace swarmanoid
