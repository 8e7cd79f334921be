// The devices for the fields on the floor. The rates of deposits are attributes of the robot, so they travel with the
// state, and its hash, journal and checkpoints have them. The space computes the fields from them. Generic.
#include <algorithm>
#include <string>
#include <vector>

#include "common/control_interface/ci_floor_field.h"
#include "common/messages/attribute_changes.h"
#include "common/plugin_descriptions/field_points.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

std::vector<std::string> IdsOfFields(const DeviceSetup& setup)
{
  std::vector<std::string> ids;
  for (const FloorFieldConfiguration& field : setup.space.GetExperiment().floor_fields) ids.push_back(field.id);
  return ids;
}

class Depositor : public CCI_FloorFieldActuator
{
public:
  Depositor(double* rates, std::span<const std::string> fields) : rates_(rates), fields_(fields) {}
  std::span<const std::string> GetFields() const override { return fields_; }

private:
  void Set(std::size_t field, double amount_per_s) override { rates_[field] = amount_per_s; }
  void ReadSettings(std::vector<double>& values) const override
  {
    values.insert(values.end(), rates_, rates_ + fields_.size());
  }

  double* rates_;
  std::span<const std::string> fields_;
};

class FloorFieldActuator : public ValueActuator
{
public:
  void Init(const DeviceSetup& setup) override
  {
    fields_ = IdsOfFields(setup);
    Reset(setup, fields_.size());
    noise_ = NoiseFrom(setup.parameters);
    for (const std::uint32_t robot : setup.robots)
      for (std::uint32_t k = 0; k < fields_.size(); ++k) slots_.push_back(setup.space.RateSlotOf(robot) + k);
    for (std::size_t i = 0; i < slots_.size(); ++i) values_[i] = setup.space.Attributes()[slots_[i]];
    devices_.reserve(robots_.size());
    for (std::size_t k = 0; k < robots_.size(); ++k) devices_.emplace_back(ValuesOf(k), fields_);
  }
  CCI_FloorFieldActuator* Actuator(std::size_t k) override { return &devices_[k]; }
  void Commit(const ChannelView&, AttributeChanges& changes) override
  {
    if (!noise_.IsActive()) return ReportChanges(slots_, values_, space_->Attributes(), changes);
    shown_ = values_;
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      RandomStream random = streams_.Of(k);
      for (std::size_t i = k * width_; i < (k + 1) * width_; ++i)
      {
        const double noise = noise_.Sample(random);
        if (shown_[i] != 0) shown_[i] += noise;
      }
    }
    ReportChanges(slots_, shown_, space_->Attributes(), changes);
  }

private:
  NoiseModel noise_;
  std::vector<double> shown_;  // with noise
  std::vector<std::string> fields_;
  std::vector<std::uint32_t> slots_;  // robot after robot
  std::vector<Depositor> devices_;
};

class Reader : public CCI_FloorFieldSensor
{
public:
  Reader(std::span<const Reading> readings, std::span<const std::string> fields) : readings_(readings), fields_(fields)
  {
  }
  std::span<const std::string> GetFields() const override { return fields_; }
  std::size_t PointCount() const override { return fields_.empty() ? 0 : readings_.size() / fields_.size(); }
  std::span<const Reading> GetAllReadings() const override { return readings_; }

private:
  std::span<const Reading> readings_;
  std::span<const std::string> fields_;
};

// It reads fields that depend on all robots, so it does not override Reach.
class FloorFieldSensor : public SensorBatch
{
public:
  void Init(const DeviceSetup& setup) override
  {
    space_ = &setup.space;
    robots_ = setup.robots;
    fields_ = IdsOfFields(setup);
    points_ = FieldPoints(setup.parameters.Text("points")).value();
    value_noise_ = NoiseFrom(setup.parameters, "value_");
    gradient_noise_ = NoiseFrom(setup.parameters, "gradient_");
    value_streams_ = DeviceStreams(setup, "value");
    gradient_streams_ = DeviceStreams(setup, "gradient");
    of_robot_ = fields_.size() * points_.size();
    readings_.resize(robots_.size() * of_robot_);
    devices_.reserve(robots_.size());
    for (std::size_t k = 0; k < robots_.size(); ++k) devices_.emplace_back(ReadingsOf(k), fields_);
  }
  CCI_FloorFieldSensor* Sensor(std::size_t k) override { return &devices_[k]; }
  void Update(const ChannelView&) override
  {
    const FloorFields& fields = space_->Fields();
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      if (!space_->IsPresent(robots_[k])) continue;
      Read(fields, space_->GetPose(robots_[k]), ReadingsOf(k));
      AddNoise(k);
    }
  }
  void Expose(std::size_t k, ExposedValues& values) override
  {
    for (Reading& reading : ReadingsOf(k))
      for (double* number : {&reading.value, &reading.gradient_x, &reading.gradient_y}) values.Add(*number);
  }

private:
  using Reading = CCI_FloorFieldSensor::Reading;

  std::span<Reading> ReadingsOf(std::size_t k) { return std::span(readings_).subspan(k * of_robot_, of_robot_); }

  void Read(const FloorFields& fields, const Pose& pose, std::span<Reading> readings) const
  {
    // The direction of the robot's front in the plane, of length 1. A robot that stands on its front or back has that
    // of the x axis.
    const Vector3 axis = pose.orientation * Vector3::UnitX();
    const double length = __builtin_sqrt(axis.x() * axis.x() + axis.y() * axis.y());
    const Vector2 front = length > 0 ? Vector2(axis.x() / length, axis.y() / length) : Vector2(1, 0);
    auto reading = readings.begin();
    for (std::size_t field = 0; field < fields.size(); ++field)
      for (const Vector2& point : points_)
      {
        const Vector3 at = pose.Apply({point.x(), point.y(), 0});
        const Vector2 gradient = fields[field].GradientAt(at.x(), at.y());
        *reading++ = {fields[field].ValueAt(at.x(), at.y()), gradient.x() * front.x() + gradient.y() * front.y(),
                      gradient.y() * front.x() - gradient.x() * front.y()};
      }
  }

  void AddNoise(std::size_t k)
  {
    if (value_noise_.IsActive())
    {
      RandomStream random = value_streams_.Of(k);
      for (Reading& reading : ReadingsOf(k)) reading.value += value_noise_.Sample(random);
    }
    if (!gradient_noise_.IsActive()) return;
    RandomStream random = gradient_streams_.Of(k);
    for (Reading& reading : ReadingsOf(k))
    {
      reading.gradient_x += gradient_noise_.Sample(random);
      reading.gradient_y += gradient_noise_.Sample(random);
    }
  }

  const CSwarmanoidSpace* space_ = nullptr;
  std::vector<std::uint32_t> robots_;
  std::vector<std::string> fields_;
  std::vector<Vector2> points_;  // m, in the frame of the robot
  NoiseModel value_noise_, gradient_noise_;
  DeviceStreams value_streams_, gradient_streams_;
  std::size_t of_robot_ = 0;  // readings of one robot
  std::vector<Reading> readings_;
  std::vector<Reader> devices_;
};

}  // namespace

const DeviceCode kFloorFieldCode(
    []
    {
      BindActuator<FloorFieldActuator>("floor_field", "generic_floor_field");
      BindSensor<FloorFieldSensor>("floor_field", "generic_floor_field");
    });

}  // namespace swarmanoid
