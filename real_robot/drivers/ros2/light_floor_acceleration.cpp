// Drivers of a footbot's sensors for light, floor and acceleration.
#include <algorithm>
#include <array>
#include <optional>

#include "common/control_interface/ci_gyroscope_sensor.h"
#include "common/control_interface/ci_positioning_sensor.h"
#include "common/control_interface/footbot/ci_footbot_accelerometer_sensor.h"
#include "common/control_interface/footbot/ci_footbot_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_light_sensor.h"
#include "nav_msgs.h"
#include "real_robot/drivers/ros2/topic_driver.h"

namespace swarmanoid::ros2
{
namespace
{

using Illuminance = sensor_msgs::msg::dds_::Illuminance_;

class Light : public RingSensor<CCI_FootBotLightSensor, Illuminance>
{
  void Configure(const Parameters& parameters) override { full_scale_ = parameters.Number("full_scale"); }
  double ReadingOf(const Illuminance& felt) const override
  {
    return std::clamp(felt.illuminance() / full_scale_, 0.0, 1.0);
  }

  double full_scale_ = 1;
};

REGISTER_SENSOR_DRIVER(Light,
                       DescribeDriver("footbot_light", "ros2", "sensor_msgs/msg/Illuminance on light_0 to light_23",
                                      {"footbot"},
                                      {TopicParameter("topic", "light", "Topics of the 24 sensors, before _0 to _23."),
                                       NumberParameter("full_scale", "lx", "1000", "Illuminance that reads as 1.")}))

class Ground : public CSensorDriver, public CCI_FootBotGroundSensor
{
public:
  void Init(const DriverSetup& setup) override
  {
    brightness_.emplace(setup, setup.parameters.Text("topic"));
    const std::string colour_topic = setup.parameters.Text("colour_topic");
    if (!colour_topic.empty()) colour_.emplace(setup, colour_topic);
  }
  CCI_Sensor* Sensor() override { return this; }
  std::span<const double, NUM_SENSORS> GetAllSensorReadings() const override { return readings_; }
  std::uint32_t GetFloorColour() const override { return floor_; }
  void Poll() override
  {
    if (brightness_->TakeLatest())
    {
      const auto& data = brightness_->Latest().data();
      if (data.size() != NUM_SENSORS)
        throw DriverError(brightness_->Name() + ": it needs 8 values, one for each sensor, not " +
                          std::to_string(data.size()));
      double sum = 0;
      for (unsigned i = 0; i < NUM_SENSORS; ++i)
        sum += readings_[i] = std::clamp(static_cast<double>(data[i]), 0.0, 1.0);
      const auto grey = static_cast<std::uint32_t>(sum / NUM_SENSORS * 255 + 0.5);
      if (!colour_) floor_ = grey << 16 | grey << 8 | grey;
    }
    if (colour_ && colour_->TakeLatest()) floor_ = ToColour(colour_->Latest());
  }
  std::vector<DriverSource> Sources() const override
  {
    std::vector<DriverSource> sources{brightness_->Source()};
    if (colour_) sources.push_back(colour_->Source());
    return sources;
  }

private:
  std::optional<Subscriber<Float32MultiArray>> brightness_;
  std::optional<Subscriber<ColorRGBA>> colour_;
  std::array<double, NUM_SENSORS> readings_{};
  std::uint32_t floor_ = 0;
};

REGISTER_SENSOR_DRIVER(
    Ground,
    DescribeDriver("footbot_ground", "ros2",
                   "std_msgs/msg/Float32MultiArray (8) on ground, std_msgs/msg/ColorRGBA on floor_color", {"footbot"},
                   {TopicParameter("topic", "ground", "Topic of the eight brightnesses, 0 to 1."),
                    TopicParameter("colour_topic", "floor_color",
                                   "Topic of the colour below the middle; empty: the mean brightness as grey.")}))

using Imu = sensor_msgs::msg::dds_::Imu_;

class Accelerometer : public TopicSensor<CCI_FootBotAccelerometerSensor, Imu>
{
public:
  std::span<const double, 3> GetAllSensorReadings() const override { return readings_; }

private:
  void Read(const Imu& message) override
  {
    const auto& felt = message.linear_acceleration();
    readings_ = {felt.x(), felt.y(), felt.z()};
  }

  std::array<double, 3> readings_{};
};

REGISTER_SENSOR_DRIVER(Accelerometer,
                       DescribeDriver("footbot_accelerometer", "ros2", "sensor_msgs/msg/Imu on imu", {"footbot"},
                                      {TopicParameter("topic", "imu", "Topic of the inertial sensor.")}))

class Gyroscope : public TopicSensor<CCI_GyroscopeSensor, Imu>
{
public:
  std::span<const double, 3> GetAllSensorReadings() const override { return readings_; }

private:
  void Read(const Imu& message) override
  {
    const auto& turning = message.angular_velocity();
    readings_ = {turning.x(), turning.y(), turning.z()};
  }

  std::array<double, 3> readings_{};
};

REGISTER_SENSOR_DRIVER(Gyroscope, DescribeDriver("gyroscope", "ros2", "sensor_msgs/msg/Imu on imu", {},
                                                 {TopicParameter("topic", "imu", "Topic of the inertial sensor.")}))

using Odometry = nav_msgs::msg::dds_::Odometry_;

class Positioning : public TopicSensor<CCI_PositioningSensor, Odometry>
{
public:
  Vector3 GetPosition() const override { return pose_.position; }
  Quaternion GetOrientation() const override { return pose_.orientation; }

private:
  void Read(const Odometry& message) override
  {
    const auto& place = message.pose().pose().position();
    const auto& turn = message.pose().pose().orientation();
    pose_ = {{place.x(), place.y(), place.z()}, Quaternion(turn.w(), turn.x(), turn.y(), turn.z()).normalized()};
  }

  Pose pose_;
};

REGISTER_SENSOR_DRIVER(Positioning, DescribeDriver("positioning", "ros2", "nav_msgs/msg/Odometry on odom", {},
                                                   {TopicParameter("topic", "odom", "Topic of the pose.")}))

}  // namespace
}  // namespace swarmanoid::ros2
