// Drivers of distance sensors: the proximity sensors of a footbot from a laser scan or from 24 range sensors, those of
// a handbot from range sensors, and the altitude of an eyebot.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/control_interface/eyebot/ci_eyebot_altitude_sensor.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "common/control_interface/handbot/ci_handbot_proximity_sensor.h"
#include "common/math/elementary.h"
#include "real_robot/drivers/ros2/footbot_infrared.h"
#include "real_robot/drivers/ros2/topic_driver.h"

namespace swarmanoid::ros2
{
namespace
{

using LaserScan = sensor_msgs::msg::dds_::LaserScan_;
using Range = sensor_msgs::msg::dds_::Range_;

constexpr unsigned kSensors = CCI_FootBotProximitySensor::NUM_SENSORS;
constexpr double kNothing = std::numeric_limits<double>::infinity();

// Returns a measured range as a distance. By REP 117, -infinity is too near to be measured; other values out of range
// mean nothing was detected.
double Measured(float range, float least, float most)
{
  if (std::isinf(range) && range < 0) return 0;
  return range >= least && range <= most ? static_cast<double>(range) : kNothing;
}

class ScanProximity : public TopicSensor<CCI_FootBotProximitySensor, LaserScan>
{
public:
  std::span<const double, NUM_SENSORS> GetAllSensorReadings() const override { return readings_; }

private:
  void Configure(const Parameters& parameters) override
  {
    radius_ = parameters.Number("body_radius");
    range_ = parameters.Number("range");
  }

  // Each sensor reads the nearest point within its 15 degrees of the scan. Sensors outside the scan read nothing.
  void Read(const LaserScan& scan) override
  {
    std::array<double, kSensors> nearest;
    nearest.fill(kNothing);
    for (std::size_t ray = 0; ray < scan.ranges().size(); ++ray)
    {
      const double angle = static_cast<double>(scan.angle_min()) +
                           static_cast<double>(ray) * static_cast<double>(scan.angle_increment());
      double turn = WrapAngle(angle);
      if (turn < 0) turn += 2 * kPi;
      double& sensor = nearest[static_cast<unsigned>(turn / SPACING) % kSensors];
      const double distance = Measured(scan.ranges()[ray], scan.range_min(), scan.range_max());
      sensor = std::min(sensor, distance);
    }
    for (unsigned i = 0; i < kSensors; ++i) readings_[i] = InfraredReading(std::max(nearest[i] - radius_, 0.0), range_);
  }

  double radius_ = 0;
  double range_ = 0;
  std::array<double, kSensors> readings_{};
};

ParameterSpec RangeParameter(const char* range_m = "0.1")
{
  return NumberParameter("range", "m", range_m, "Distance from the sensor beyond which nothing is seen.");
}

REGISTER_SENSOR_DRIVER(
    ScanProximity,
    DescribeDriver("footbot_proximity", "ros2", "sensor_msgs/msg/LaserScan on scan", {"footbot"},
                   {TopicParameter("topic", "scan", "Topic of the laser scan."),
                    NumberParameter("body_radius", "m", "0.085036758",
                                    "Distance from the origin of the scan, the middle of the robot, to its surface."),
                    RangeParameter()}))

class RangeProximity : public RingSensor<CCI_FootBotProximitySensor, Range>
{
  void Configure(const Parameters& parameters) override { range_ = parameters.Number("range"); }
  double ReadingOf(const Range& range) const override
  {
    return InfraredReading(Measured(range.range(), range.min_range(), range.max_range()), range_);
  }

  double range_ = 0;
};

REGISTER_SENSOR_DRIVER(
    RangeProximity, DescribeDriver("footbot_proximity", "ros2_ranges",
                                   "sensor_msgs/msg/Range on proximity_0 to proximity_23", {"footbot"},
                                   {TopicParameter("topic", "proximity", "Topics of the 24 sensors, before _0 to _23."),
                                    RangeParameter()}))

class HandProximity : public RingSensor<CCI_HandBotProximitySensor, Range>
{
  void Configure(const Parameters& parameters) override { range_ = parameters.Number("range"); }
  double ReadingOf(const Range& range) const override
  {
    return std::max(1 - Measured(range.range(), range.min_range(), range.max_range()) / range_, 0.0);
  }

  double range_ = 0;
};

REGISTER_SENSOR_DRIVER(
    HandProximity,
    DescribeDriver("handbot_proximity", "ros2", "sensor_msgs/msg/Range on proximity_0 to proximity_23", {"handbot"},
                   {TopicParameter("topic", "proximity", "Topics of the 24 sensors, before _0 to _23."),
                    RangeParameter("0.05")}))

class Altitude : public TopicSensor<CCI_EyeBotAltitudeSensor, Range>
{
public:
  double GetAltitude() const override { return altitude_; }

private:
  void Read(const Range& range) override { altitude_ = Measured(range.range(), range.min_range(), range.max_range()); }

  double altitude_ = 0;
};

REGISTER_SENSOR_DRIVER(Altitude,
                       DescribeDriver("eyebot_altitude", "ros2", "sensor_msgs/msg/Range on altitude", {"eyebot"},
                                      {TopicParameter("topic", "altitude", "Topic of the range sensor below.")}))

}  // namespace
}  // namespace swarmanoid::ros2
