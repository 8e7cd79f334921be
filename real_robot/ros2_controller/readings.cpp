// Each sensor of the simulated robot is published on the topic, in the frame and with the units that the driver of the
// real sensor reads (real_robot/drivers/ros2): these classes compute the inverse of those drivers. Messages are filled
// in place and kept from tick to tick, so that hundreds of robots do not allocate memory in each tick. A sensor without
// a driver has a topic with one number for each of its columns.
#include "real_robot/ros2_controller/readings.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <optional>

#include "common/control_interface/ci_ground_sensor.h"
#include "common/control_interface/ci_gyroscope_sensor.h"
#include "common/control_interface/ci_joints_sensor.h"
#include "common/control_interface/ci_proximity_sensor.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/control_interface/ci_range_scanner_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_altitude_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_camera_sensor.h"
#include "common/control_interface/footbot/ci_footbot_accelerometer_sensor.h"
#include "common/control_interface/footbot/ci_footbot_encoders_sensor.h"
#include "common/control_interface/footbot/ci_footbot_gripper_sensor.h"
#include "common/control_interface/footbot/ci_footbot_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_light_sensor.h"
#include "common/control_interface/footbot/ci_footbot_omnidirectional_camera_sensor.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turret_encoder_sensor.h"
#include "common/math/elementary.h"
#include "real_robot/drivers/ros2/footbot_infrared.h"
#include "real_robot/drivers/ros2/point_cloud.h"
#include "real_robot/ros2_controller/odometry.h"

namespace swarmanoid::ros2
{
namespace
{

using LaserScan = sensor_msgs::msg::dds_::LaserScan_;
using Range = sensor_msgs::msg::dds_::Range_;
using Illuminance = sensor_msgs::msg::dds_::Illuminance_;
using Imu = sensor_msgs::msg::dds_::Imu_;

constexpr double kBodyRadius_m = 0.085036758;  // of a footbot
constexpr double kFullScale_lx = 1000;         // what a light sensor of a footbot reads as 1
constexpr std::uint8_t kInfrared = 1;          // sensor_msgs/msg/Range: INFRARED

// Publishes one sensor on one topic.
template <class Interface, class Message>
class TopicReading : public ReadingPublisher
{
public:
  TopicReading(const ReadingSetup& setup, const std::string& type, const std::string& topic)
      : sensor_(setup.robot->Sensor<Interface>(type)), publisher_(setup, topic)
  {
  }
  void Publish(const Header& header) override
  {
    Fill(header);
    publisher_.Publish(message_);
  }
  unsigned Listeners() const override { return publisher_.Listeners(); }

protected:
  virtual void Fill(const Header& header) = 0;

  const Interface& sensor_;
  Message message_;

private:
  ReadingTopic<Message> publisher_;
};

class Scan : public TopicReading<CCI_FootBotProximitySensor, LaserScan>
{
public:
  explicit Scan(const ReadingSetup& setup) : TopicReading(setup, "footbot_proximity", "scan")
  {
    message_.angle_min(static_cast<float>(CCI_FootBotProximitySensor::FIRST_ANGLE));
    message_.angle_increment(static_cast<float>(CCI_FootBotProximitySensor::SPACING));
    message_.angle_max(static_cast<float>(CCI_FootBotProximitySensor::AngleOf(kSensors - 1)));
    message_.range_min(static_cast<float>(kBodyRadius_m));
    message_.range_max(static_cast<float>(kBodyRadius_m + setup.range_m));
    message_.ranges().resize(kSensors);
  }

private:
  static constexpr unsigned kSensors = CCI_FootBotProximitySensor::NUM_SENSORS;

  void Fill(const Header& header) override
  {
    message_.header(header);
    for (unsigned i = 0; i < kSensors; ++i)
      message_.ranges()[i] = static_cast<float>(kBodyRadius_m + InfraredDistance(sensor_.GetAllSensorReadings()[i]));
  }
};

// A message for each of the sensors of a ring, on topics that are numbered from 0.
template <class Interface, class Message>
class RingReading : public ReadingPublisher
{
public:
  RingReading(const ReadingSetup& setup, const std::string& type, const std::string& topic)
      : sensor_(setup.robot->Sensor<Interface>(type))
  {
    for (std::size_t i = 0; i < sensor_.GetAllSensorReadings().size(); ++i)
      publishers_.push_back(std::make_unique<ReadingTopic<Message>>(setup, topic + "_" + std::to_string(i)));
  }
  void Publish(const Header& header) override
  {
    message_.header(header);
    const auto readings = sensor_.GetAllSensorReadings();
    for (std::size_t i = 0; i < publishers_.size(); ++i)
    {
      Fill(readings[i]);
      publishers_[i]->Publish(message_);
    }
  }
  unsigned Listeners() const override
  {
    unsigned listeners = 0;
    for (const auto& publisher : publishers_) listeners += publisher->Listeners();
    return listeners;
  }

protected:
  virtual void Fill(double reading) = 0;

  Message message_;

private:
  const Interface& sensor_;
  std::vector<std::unique_ptr<ReadingTopic<Message>>> publishers_;
};

// Publishes the ranges of any robot: a reading is 1 at the sensor and 0 at the end of its range.
class Ranges : public RingReading<CCI_ProximitySensor, Range>
{
public:
  explicit Ranges(const ReadingSetup& setup) : RingReading(setup, "proximity", "proximity"), range_m_(setup.range_m)
  {
    message_.radiation_type(kInfrared);
    message_.min_range(0);
    message_.max_range(static_cast<float>(range_m_));
  }

private:
  void Fill(double reading) override
  {
    constexpr float kNothing = std::numeric_limits<float>::infinity();
    message_.range(reading <= 0 ? kNothing : static_cast<float>((1 - std::min(reading, 1.0)) * range_m_));
  }

  double range_m_;
};

class Light : public RingReading<CCI_FootBotLightSensor, Illuminance>
{
public:
  explicit Light(const ReadingSetup& setup) : RingReading(setup, "footbot_light", "light") {}

private:
  void Fill(double reading) override { message_.illuminance(reading * kFullScale_lx); }
};

// Publishes the brightness of the floor under each sensor, and its colour below the middle.
template <class Interface>
class Ground : public ReadingPublisher
{
public:
  Ground(const ReadingSetup& setup, const std::string& type)
      : sensor_(setup.robot->Sensor<Interface>(type)), brightness_(setup, "ground"), colour_(setup, "floor_color")
  {
  }
  void Publish(const Header&) override
  {
    const auto readings = sensor_.GetAllSensorReadings();
    message_.data().clear();
    for (const double reading : readings) message_.data().push_back(static_cast<float>(reading));
    std_msgs::msg::dds_::MultiArrayDimension_ dimension;
    dimension.label("sensor");
    dimension.size(static_cast<std::uint32_t>(readings.size()));
    dimension.stride(dimension.size());
    message_.layout().dim({dimension});
    brightness_.Publish(message_);
    ColorRGBA floor = ToMessage(sensor_.GetFloorColour());
    floor.a(1);
    colour_.Publish(floor);
  }
  unsigned Listeners() const override { return brightness_.Listeners() + colour_.Listeners(); }

private:
  const Interface& sensor_;
  ReadingTopic<Float32MultiArray> brightness_;
  ReadingTopic<ColorRGBA> colour_;
  Float32MultiArray message_;
};

// Points in the frame of the robot, x, y and z as float32 and more behind them.
class CloudWriter
{
public:
  CloudWriter(const char* further, PointCloud::Type type, std::uint32_t count, std::uint32_t bytes)
  {
    const auto add = [&](const char* name, std::uint32_t offset, PointCloud::Type of, std::uint32_t values)
    {
      sensor_msgs::msg::dds_::PointField_ field;
      field.name(name);
      field.offset(offset);
      field.datatype(static_cast<std::uint8_t>(of));
      field.count(values);
      message_.fields().push_back(field);
    };
    add("x", 0, PointCloud::Type::kFloat32, 1);
    add("y", 4, PointCloud::Type::kFloat32, 1);
    add("z", 8, PointCloud::Type::kFloat32, 1);
    add(further, kPlaceBytes, type, count);
    message_.height(1);
    message_.point_step(kPlaceBytes + bytes);
    message_.is_bigendian(std::endian::native == std::endian::big);
    message_.is_dense(true);
  }

  void Begin(const Header& header)
  {
    message_.header(header);
    message_.data().clear();
  }
  void Add(const Vector3& place, const void* further)
  {
    std::vector<std::uint8_t>& data = message_.data();
    const std::size_t at = data.size();
    data.resize(at + message_.point_step());
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto number = static_cast<float>(place[axis]);
      std::memcpy(&data[at + 4 * static_cast<std::size_t>(axis)], &number, sizeof number);
    }
    std::memcpy(&data[at + kPlaceBytes], further, message_.point_step() - kPlaceBytes);
  }
  PointCloud2& End()
  {
    message_.row_step(static_cast<std::uint32_t>(message_.data().size()));
    message_.width(message_.row_step() / message_.point_step());
    return message_;
  }

private:
  static constexpr std::uint32_t kPlaceBytes = 12;
  PointCloud2 message_;
};

// Returns a point from its distance in the plane, or along the line of sight, and its angles.
Vector3 PlaceAt(double flat_m, double angle, double up_m)
{
  const SinCos direction = SinCosOf(angle);
  return {flat_m * direction.cos, flat_m * direction.sin, up_m};
}

template <class Interface>
class Blobs : public ReadingPublisher
{
public:
  Blobs(const ReadingSetup& setup, const std::string& type)
      : sensor_(setup.robot->Sensor<Interface>(type)), publisher_(setup, "blobs")
  {
  }
  void Publish(const Header& header) override
  {
    cloud_.Begin(header);
    for (const CCI_ColourBlob& blob : sensor_.GetAllBlobs())
      cloud_.Add(PlaceAt(blob.distance_m, blob.angle_rad, 0), &blob.colour);
    publisher_.Publish(cloud_.End());
  }
  unsigned Listeners() const override { return publisher_.Listeners(); }

private:
  const Interface& sensor_;
  ReadingTopic<PointCloud2> publisher_;
  CloudWriter cloud_{"rgb", PointCloud::Type::kUint32, 1, 4};
};

class Packets : public ReadingPublisher
{
public:
  explicit Packets(const ReadingSetup& setup)
      : sensor_(setup.robot->Sensor<CCI_RangeAndBearingSensor>("range_and_bearing")),
        publisher_(setup, "range_and_bearing")
  {
  }
  void Publish(const Header& header) override
  {
    cloud_.Begin(header);
    for (const auto& packet : sensor_.GetAllPackets())
    {
      const SinCos up = SinCosOf(packet.vertical_bearing_rad);
      cloud_.Add(PlaceAt(packet.range_m * up.cos, packet.bearing_rad, packet.range_m * up.sin), packet.message.data());
    }
    publisher_.Publish(cloud_.End());
  }
  unsigned Listeners() const override { return publisher_.Listeners(); }

private:
  const CCI_RangeAndBearingSensor& sensor_;
  ReadingTopic<PointCloud2> publisher_;
  CloudWriter cloud_{"data", PointCloud::Type::kUint8, CCI_RangeAndBearingActuator::NUM_BYTES,
                     CCI_RangeAndBearingActuator::NUM_BYTES};
};

// A range scanner: the layer that is nearest to level as LaserScan, and the points of all layers in the frame of the
// robot, without beams that measured nothing. "ring" is the number of the layer, as of common laser scanners.
class Scanner : public ReadingPublisher
{
public:
  explicit Scanner(const ReadingSetup& setup)
      : sensor_(setup.robot->Sensor<CCI_RangeScannerSensor>("range_scanner")),
        scan_(setup, "laser_scan"),
        points_(setup, "points")
  {
    const unsigned beams = sensor_.GetBeams();
    message_.angle_min(static_cast<float>(sensor_.GetAngle(0)));
    message_.angle_max(static_cast<float>(sensor_.GetAngle(beams - 1)));
    message_.angle_increment(
        beams > 1 ? static_cast<float>((sensor_.GetAngle(beams - 1) - sensor_.GetAngle(0)) / (beams - 1)) : 0);
    message_.range_min(static_cast<float>(sensor_.GetNearest()));
    message_.range_max(static_cast<float>(sensor_.GetRange()));
    message_.ranges().resize(beams);
    for (unsigned layer = 0; layer < sensor_.GetLayers(); ++layer)
    {
      const SinCos up = SinCosOf(sensor_.GetElevation(layer));
      for (unsigned beam = 0; beam < beams; ++beam)
        directions_.push_back(PlaceAt(up.cos, sensor_.GetAngle(beam), up.sin));
    }
    level_ = (sensor_.GetLayers() - 1) / 2;
  }
  void Publish(const Header& header) override
  {
    if (scan_.Listeners() != 0) PublishScan(header);
    if (points_.Listeners() != 0) PublishPoints(header);
  }
  unsigned Listeners() const override { return scan_.Listeners() + points_.Listeners(); }

private:
  // By REP 117 -infinity means too near.
  void PublishScan(const Header& header)
  {
    message_.header(header);
    const unsigned beams = sensor_.GetBeams();
    const auto distances = sensor_.GetAllDistances().subspan(std::size_t{level_} * beams, beams);
    for (unsigned beam = 0; beam < beams; ++beam)
      message_.ranges()[beam] =
          distances[beam] == 0 ? -std::numeric_limits<float>::infinity() : static_cast<float>(distances[beam]);
    scan_.Publish(message_);
  }
  void PublishPoints(const Header& header)
  {
    cloud_.Begin(header);
    const auto distances = sensor_.GetAllDistances();
    for (std::size_t i = 0; i < distances.size(); ++i)
    {
      if (distances[i] == 0 || distances[i] == std::numeric_limits<double>::infinity()) continue;
      const auto ring = static_cast<std::uint16_t>(i / sensor_.GetBeams());
      cloud_.Add(sensor_.GetPosition() + distances[i] * directions_[i], &ring);
    }
    points_.Publish(cloud_.End());
  }

  const CCI_RangeScannerSensor& sensor_;
  ReadingTopic<LaserScan> scan_;
  ReadingTopic<PointCloud2> points_;
  LaserScan message_;
  CloudWriter cloud_{"ring", PointCloud::Type::kUint16, 1, 2};
  std::vector<Vector3> directions_;  // of all beams, in the frame of the robot
  unsigned level_ = 0;               // the layer of the scan
};

// Wheels, turret and gripper, and the joints of other robots.
class Joints : public ReadingPublisher
{
public:
  explicit Joints(const ReadingSetup& setup) : rolled_(setup.wheels), publisher_(setup, "joint_states")
  {
    const CCI_Robot& robot = *setup.robot;
    if (robot.HasSensor("footbot_encoders")) wheels_ = &robot.Sensor<CCI_FootBotEncodersSensor>("footbot_encoders");
    if (robot.HasSensor("footbot_turret_encoder"))
      turret_ = &robot.Sensor<CCI_FootBotTurretEncoderSensor>("footbot_turret_encoder");
    if (robot.HasSensor("joints")) joints_ = &robot.Sensor<CCI_JointsSensor>("joints");
    if (!robot.HasSensor("footbot_gripper")) return;
    gripper_ = &robot.Sensor<CCI_FootBotGripperSensor>("footbot_gripper");
    holding_.emplace(setup, "gripper/holding");
  }
  void Publish(const Header& header) override
  {
    JointState message;
    message.header(header);
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    const auto add = [&](const char* name, double position, double velocity)
    {
      message.name().emplace_back(name);
      message.position().push_back(position);
      message.velocity().push_back(velocity);
    };
    if (wheels_ != nullptr)
    {
      add("left_wheel", rolled_->LeftAngle(), wheels_->GetLeftVelocity());
      add("right_wheel", rolled_->RightAngle(), wheels_->GetRightVelocity());
    }
    if (turret_ != nullptr) add("turret", turret_->GetTurretAngle(), kUnknown);
    if (gripper_ != nullptr)
    {
      add("gripper", gripper_->GetAperture(), kUnknown);
      Bool holding;
      holding.data(gripper_->IsGripping());
      holding_->Publish(holding);
    }
    if (joints_ != nullptr)
    {
      message.effort().resize(message.name().size(), kUnknown);
      for (unsigned joint = 0; joint < joints_->GetNumJoints(); ++joint)
      {
        add(joints_->GetName(joint).c_str(), joints_->GetPosition(joint), joints_->GetVelocity(joint));
        message.effort().push_back(joints_->GetEffort(joint));
      }
    }
    publisher_.Publish(message);
  }
  unsigned Listeners() const override { return publisher_.Listeners(); }

private:
  const CCI_FootBotEncodersSensor* wheels_ = nullptr;
  const CCI_FootBotTurretEncoderSensor* turret_ = nullptr;
  const CCI_FootBotGripperSensor* gripper_ = nullptr;
  const CCI_JointsSensor* joints_ = nullptr;
  std::optional<ReadingTopic<Bool>> holding_;
  const WheelOdometry* rolled_;
  ReadingTopic<JointState> publisher_;
};

// Publishes the motion that a robot feels. By the definition of the message, -1 says that a part is not measured.
class Inertia : public ReadingPublisher
{
public:
  explicit Inertia(const ReadingSetup& setup) : publisher_(setup, "imu")
  {
    const CCI_Robot& robot = *setup.robot;
    message_.orientation_covariance()[0] = -1;
    if (robot.HasSensor("gyroscope"))
      turning_ = &robot.Sensor<CCI_GyroscopeSensor>("gyroscope");
    else
      message_.angular_velocity_covariance()[0] = -1;
    if (robot.HasSensor("footbot_accelerometer"))
      acceleration_ = &robot.Sensor<CCI_FootBotAccelerometerSensor>("footbot_accelerometer");
    else
      message_.linear_acceleration_covariance()[0] = -1;
  }
  void Publish(const Header& header) override
  {
    message_.header(header);
    const auto set = [](auto& vector, std::span<const double, 3> readings)
    {
      vector.x(readings[0]);
      vector.y(readings[1]);
      vector.z(readings[2]);
    };
    if (turning_ != nullptr) set(message_.angular_velocity(), turning_->GetAllSensorReadings());
    if (acceleration_ != nullptr) set(message_.linear_acceleration(), acceleration_->GetAllSensorReadings());
    publisher_.Publish(message_);
  }
  unsigned Listeners() const override { return publisher_.Listeners(); }

private:
  const CCI_GyroscopeSensor* turning_ = nullptr;
  const CCI_FootBotAccelerometerSensor* acceleration_ = nullptr;
  Imu message_;
  ReadingTopic<Imu> publisher_;
};

class Altitude : public TopicReading<CCI_EyeBotAltitudeSensor, Range>
{
public:
  explicit Altitude(const ReadingSetup& setup) : TopicReading(setup, "eyebot_altitude", "altitude")
  {
    message_.radiation_type(kInfrared);
    message_.max_range(std::numeric_limits<float>::max());
  }

private:
  void Fill(const Header& header) override
  {
    message_.header(header);
    message_.range(static_cast<float>(sensor_.GetAltitude()));
  }
};

// The columns of a sensor that no message of ROS 2 is made for, and its rows behind them on a topic of their own.
class Table : public ReadingPublisher
{
public:
  Table(const ReadingSetup& setup, const std::string& type) : sensor_(*setup.robot->GetSensor(type))
  {
    Open(columns_, setup, type, sensor_.Columns());
    Open(rows_, setup, type + "/rows", sensor_.Rows());
  }
  void Publish(const Header&) override
  {
    values_.clear();
    sensor_.ReadColumns(values_);
    Publish(columns_);
    values_.clear();
    sensor_.ReadRows(values_);
    Publish(rows_);
  }
  unsigned Listeners() const override
  {
    return (columns_ ? columns_->topic.Listeners() : 0) + (rows_ ? rows_->topic.Listeners() : 0);
  }

private:
  struct Part
  {
    Part(const ReadingSetup& setup, const std::string& name) : topic(setup, name) {}
    ReadingTopic<Float32MultiArray> topic;
    Float32MultiArray message{};
  };

  // The columns are named by the label of the second dimension, with commas between them.
  static void Open(std::optional<Part>& part, const ReadingSetup& setup, const std::string& topic,
                   const std::vector<CCI_Column>& columns)
  {
    if (columns.empty()) return;
    part.emplace(setup, topic);
    std::string titles;
    for (const CCI_Column& column : columns) titles += (titles.empty() ? "" : ", ") + column.Title();
    part->message.layout().dim().resize(2);
    part->message.layout().dim()[0].label("row");
    part->message.layout().dim()[1].label(titles);
    part->message.layout().dim()[1].size(static_cast<std::uint32_t>(columns.size()));
    part->message.layout().dim()[1].stride(static_cast<std::uint32_t>(columns.size()));
  }
  void Publish(std::optional<Part>& part)
  {
    if (!part) return;
    auto& dimensions = part->message.layout().dim();
    dimensions[0].stride(static_cast<std::uint32_t>(values_.size()));
    dimensions[0].size(dimensions[0].stride() / dimensions[1].size());
    part->message.data().assign(values_.begin(), values_.end());
    part->topic.Publish(part->message);
  }

  const CCI_Sensor& sensor_;
  std::optional<Part> columns_, rows_;
  std::vector<double> values_;
};

template <class Reading, class... Further>
std::unique_ptr<ReadingPublisher> Make(const ReadingSetup& setup, Further... further)
{
  return std::make_unique<Reading>(setup, further...);
}

using Maker = std::function<std::unique_ptr<ReadingPublisher>(const ReadingSetup&)>;

// The sensors that messages of ROS 2 are made for. Those that share a message share a name of the maker: it is made
// once.
struct Source
{
  std::string publisher;
  Maker make;
};

const std::map<std::string, Source>& Sources()
{
  static const std::map<std::string, Source> sources{
      {"eyebot_altitude", {"altitude", Make<Altitude>}},
      {"eyebot_camera",
       {"blobs",
        [](const ReadingSetup& setup) { return Make<Blobs<CCI_EyeBotCameraSensor>>(setup, "eyebot_camera"); }}},
      {"footbot_accelerometer", {"imu", Make<Inertia>}},
      {"footbot_encoders", {"joints", Make<Joints>}},
      {"footbot_gripper", {"joints", Make<Joints>}},
      {"footbot_ground",
       {"ground",
        [](const ReadingSetup& setup) { return Make<Ground<CCI_FootBotGroundSensor>>(setup, "footbot_ground"); }}},
      {"footbot_light", {"light", Make<Light>}},
      {"footbot_omnidirectional_camera",
       {"blobs", [](const ReadingSetup& setup)
        { return Make<Blobs<CCI_FootBotOmnidirectionalCameraSensor>>(setup, "footbot_omnidirectional_camera"); }}},
      {"footbot_proximity", {"scan", Make<Scan>}},
      {"footbot_turret_encoder", {"joints", Make<Joints>}},
      {"ground", {"ground", [](const ReadingSetup& setup) { return Make<Ground<CCI_GroundSensor>>(setup, "ground"); }}},
      {"gyroscope", {"imu", Make<Inertia>}},
      {"joints", {"joints", Make<Joints>}},
      {"positioning", {}},
      {"proximity", {"proximity", Make<Ranges>}},
      {"range_and_bearing", {"range_and_bearing", Make<Packets>}},
      {"range_scanner", {"range_scanner", Make<Scanner>}},
  };
  return sources;
}

}  // namespace

std::vector<std::unique_ptr<ReadingPublisher>> MakeReadings(const ReadingSetup& setup)
{
  std::vector<std::unique_ptr<ReadingPublisher>> readings;
  std::vector<std::string> made;
  for (const std::string& type : setup.robot->SensorTypes())
  {
    const auto found = Sources().find(type);
    if (found == Sources().end())
    {
      readings.push_back(Make<Table>(setup, type));
      continue;
    }
    const Source& source = found->second;
    if (!source.make || std::ranges::find(made, source.publisher) != made.end()) continue;
    made.push_back(source.publisher);
    readings.push_back(source.make(setup));
  }
  if (setup.wheels != nullptr || setup.robot->HasSensor("positioning")) readings.push_back(MakeOdometry(setup));
  return readings;
}

}  // namespace swarmanoid::ros2
