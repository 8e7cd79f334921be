// What measures distances: the proximity sensors of a footbot from a laser scan or from 24 range sensors, and the
// altitude of an eyebot.
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "common/control_interface/eyebot/ci_eyebot_altitude_sensor.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "common/math/elementary.h"
#include "real_robot/drivers/ros2/ros2_kit.h"

namespace swarmanoid::ros2
{
namespace
{

using LaserScan = sensor_msgs::msg::dds_::LaserScan_;
using Range = sensor_msgs::msg::dds_::Range_;

constexpr unsigned kSensors = CCI_FootBotProximitySensor::NUM_SENSORS;
constexpr double kNothing = std::numeric_limits<double>::infinity();

// The reading of the infrared sensors of a footbot at a distance from the body (ARGoS3, foot-bot), as in the simulator.
double ReadingAt(double distance, double range)
{
  constexpr double kContactDistance = 0.009889556;
  if (distance > range) return 0;
  return distance < kContactDistance ? 1 : 0.0100527 / (distance + 0.000163144);
}

// A measured range as a distance, by REP 117: -infinity is too near to be measured, all else out of range is nothing.
double Measured(float range, float least, float most)
{
  if (std::isinf(range) && range < 0) return 0;
  return range >= least && range <= most ? static_cast<double>(range) : kNothing;
}

class ScanProximity : public CSensorDriver, public CCI_FootBotProximitySensor
{
public:
  void Init(const DriverSetup& setup) override
  {
    subscriber_.emplace(setup, setup.parameters.Text("topic"));
    radius_ = setup.parameters.Number("body_radius");
    range_ = setup.parameters.Number("range");
  }
  CCI_Sensor* Sensor() override { return this; }
  std::span<const double, NUM_SENSORS> GetAllSensorReadings() const override { return readings_; }

  // Each sensor sees what is nearest within its 15 degrees of the scan; those that the scan does not reach see nothing.
  void Poll() override
  {
    if (!subscriber_->TakeLatest()) return;
    const LaserScan& scan = subscriber_->Latest();
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
    for (unsigned i = 0; i < kSensors; ++i) readings_[i] = ReadingAt(std::max(nearest[i] - radius_, 0.0), range_);
  }
  std::vector<DriverSource> Sources() const override { return {subscriber_->Source()}; }

private:
  std::optional<Subscriber<LaserScan>> subscriber_;
  double radius_ = 0;
  double range_ = 0;
  std::array<double, kSensors> readings_{};
};

ParameterSpec RangeParameter()
{
  return NumberParameter("range", "m", "0.1", "Distance from the body beyond which nothing is seen.");
}

REGISTER_SENSOR_DRIVER(
    ScanProximity,
    DescribeDriver("footbot_proximity", "ros2", "sensor_msgs/msg/LaserScan on scan", {"footbot"},
                   {TopicParameter("topic", "scan", "Topic of the laser scan."),
                    NumberParameter("body_radius", "m", "0.085036758",
                                    "Distance from the origin of the scan, the middle of the robot, to its surface."),
                    RangeParameter()}))

class RangeProximity : public CSensorDriver, public CCI_FootBotProximitySensor
{
public:
  void Init(const DriverSetup& setup) override
  {
    for (unsigned i = 0; i < kSensors; ++i)
      subscribers_[i].emplace(setup, setup.parameters.Text("topic") + "_" + std::to_string(i));
    range_ = setup.parameters.Number("range");
  }
  CCI_Sensor* Sensor() override { return this; }
  std::span<const double, NUM_SENSORS> GetAllSensorReadings() const override { return readings_; }
  void Poll() override
  {
    for (unsigned i = 0; i < kSensors; ++i)
    {
      if (!subscribers_[i]->TakeLatest()) continue;
      const Range& range = subscribers_[i]->Latest();
      readings_[i] = ReadingAt(Measured(range.range(), range.min_range(), range.max_range()), range_);
    }
  }
  std::vector<DriverSource> Sources() const override
  {
    std::vector<DriverSource> sources;
    for (const auto& subscriber : subscribers_) sources.push_back(subscriber->Source());
    return sources;
  }

private:
  std::array<std::optional<Subscriber<Range>>, kSensors> subscribers_;
  double range_ = 0;
  std::array<double, kSensors> readings_{};
};

REGISTER_SENSOR_DRIVER(
    RangeProximity, DescribeDriver("footbot_proximity", "ros2_ranges",
                                   "sensor_msgs/msg/Range on proximity_0 to proximity_23", {"footbot"},
                                   {TopicParameter("topic", "proximity", "Topics of the 24 sensors, before _0 to _23."),
                                    RangeParameter()}))

class Altitude : public CSensorDriver, public CCI_EyeBotAltitudeSensor
{
public:
  void Init(const DriverSetup& setup) override { subscriber_.emplace(setup, setup.parameters.Text("topic")); }
  CCI_Sensor* Sensor() override { return this; }
  double GetAltitude() const override { return altitude_; }
  void Poll() override
  {
    if (!subscriber_->TakeLatest()) return;
    const Range& range = subscriber_->Latest();
    altitude_ = Measured(range.range(), range.min_range(), range.max_range());
  }
  std::vector<DriverSource> Sources() const override { return {subscriber_->Source()}; }

private:
  std::optional<Subscriber<Range>> subscriber_;
  double altitude_ = 0;
};

REGISTER_SENSOR_DRIVER(Altitude,
                       DescribeDriver("eyebot_altitude", "ros2", "sensor_msgs/msg/Range on altitude", {"eyebot"},
                                      {TopicParameter("topic", "altitude", "Topic of the range sensor below.")}))

}  // namespace
}  // namespace swarmanoid::ros2
