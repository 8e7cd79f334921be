// The joints of any robot whose kind has them. Specific: the channel "joints" has a mode and a value for each joint,
// and to the host a position, a speed and an effort. It has room for the most joints of a robot in the experiment.
#include <cmath>
#include <stdexcept>

#include "common/control_interface/ci_joints_actuator.h"
#include "common/control_interface/ci_joints_sensor.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/kind_of_batch.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

const MovingLink& At(const std::vector<MovingLink>& links, unsigned joint)
{
  if (joint >= links.size())
    throw std::out_of_range("joint " + std::to_string(joint) + " of " + std::to_string(links.size()));
  return links[joint];
}

class Joints : public CCI_JointsActuator
{
public:
  // `values` has the value of each joint, then the mode of each.
  Joints(double* values, const std::vector<MovingLink>& links, bool are_velocities)
      : values_(values), links_(links), are_velocities_(are_velocities)
  {
  }
  unsigned GetNumJoints() const override { return static_cast<unsigned>(links_.size()); }
  const std::string& GetName(unsigned joint) const override { return At(links_, joint).joint; }
  bool Slides(unsigned joint) const override { return At(links_, joint).slides; }
  double GetLowest(unsigned joint) const override { return At(links_, joint).lowest; }
  double GetHighest(unsigned joint) const override { return At(links_, joint).highest; }
  double GetMaxSpeed(unsigned joint) const override { return At(links_, joint).max_speed; }
  bool AreColumnsVelocities() const override { return are_velocities_; }
  // NaN passes through, since the host reports it with the robot's name.
  void SetPosition(unsigned joint, double position) override
  {
    const MovingLink& link = At(links_, joint);
    Set(joint, JointCommand::Mode::kPosition, std::isnan(position) ? position : link.Within(position));
  }
  void SetVelocity(unsigned joint, double velocity) override
  {
    const double most = At(links_, joint).max_speed;
    Set(joint, JointCommand::Mode::kVelocity, std::clamp(velocity, -most, most));
  }

protected:
  void ReadSettings(std::vector<double>& values) const override
  {
    values.insert(values.end(), values_, values_ + links_.size());
  }

private:
  void Set(unsigned joint, JointCommand::Mode mode, double value)
  {
    values_[joint] = value;
    values_[links_.size() + joint] = static_cast<double>(mode);
  }

  double* values_;
  const std::vector<MovingLink>& links_;
  bool are_velocities_;
};

class JointsActuator : public ValueActuator
{
public:
  void Init(const DeviceSetup& setup) override
  {
    const std::vector<MovingLink>& links = KindOfBatch(setup).links;
    count_ = links.size();
    Reset(setup, 2 * count_);
    noise_ = NoiseFrom(setup.parameters);
    for (std::size_t k = 0; k < Robots(); ++k)
    {
      for (std::size_t joint = 0; joint < count_; ++joint) ValuesOf(k)[joint] = links[joint].Start();
      joints_.emplace_back(ValuesOf(k), links, setup.parameters.Text("control") == "velocity");
    }
  }
  Joints* Actuator(std::size_t k) override { return &joints_[k]; }
  // Faults change the values, not the modes.
  void Expose(std::size_t k, ExposedValues& values) override { values.Add({ValuesOf(k), count_}); }
  void Commit(const ChannelView& channel, AttributeChanges&) override
  {
    for (std::size_t k = 0; k < Robots(); ++k)
    {
      const double* values = ValuesOf(k);
      double* target = &channel.values[channel.offsets[k]];
      RandomStream random = streams_.Of(k);
      for (std::size_t joint = 0; joint < count_; ++joint, target += kJointCommandWidth)
      {
        target[0] = values[count_ + joint];
        target[1] = values[joint];
        if (!noise_.IsActive()) continue;
        const double noise = noise_.Sample(random);
        const bool stands = target[0] == static_cast<double>(JointCommand::Mode::kVelocity) && target[1] == 0;
        if (target[0] != 0 && !stands) target[1] += noise;
      }
    }
  }

private:
  std::size_t count_ = 0;  // joints of a robot
  NoiseModel noise_;
  std::vector<Joints> joints_;
};

class JointReadings : public CCI_JointsSensor
{
public:
  JointReadings(const double* values, const std::vector<MovingLink>& links) : values_(values), links_(links) {}
  unsigned GetNumJoints() const override { return static_cast<unsigned>(links_.size()); }
  const std::string& GetName(unsigned joint) const override { return At(links_, joint).joint; }
  bool Slides(unsigned joint) const override { return At(links_, joint).slides; }
  std::span<const double> GetAllSensorReadings() const override { return {values_, NUM_PER_JOINT * links_.size()}; }

private:
  const double* values_;
  const std::vector<MovingLink>& links_;
};

class JointsSensor : public ChannelSensor
{
public:
  void Init(const DeviceSetup& setup) override
  {
    static_assert(CCI_JointsSensor::NUM_PER_JOINT == kJointReadingWidth);
    const std::vector<MovingLink>& links = KindOfBatch(setup).links;
    Reset(setup, CCI_JointsSensor::NUM_PER_JOINT * links.size());
    noise_ = NoiseFrom(setup.parameters);
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      for (std::size_t joint = 0; joint < links.size(); ++joint)
        ValuesOf(k)[CCI_JointsSensor::NUM_PER_JOINT * joint] = links[joint].Start();
      joints_.emplace_back(ValuesOf(k), links);
    }
  }
  JointReadings* Sensor(std::size_t k) override { return &joints_[k]; }

private:
  std::vector<JointReadings> joints_;
};

}  // namespace

const DeviceCode kJointsCode(
    []
    {
      BindActuator<JointsActuator>("joints", "generic_joints");
      BindSensor<JointsSensor>("joints", "generic_joints");
    });

}  // namespace swarmanoid
