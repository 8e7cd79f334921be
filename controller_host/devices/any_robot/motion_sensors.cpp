// Positioning, gyroscope and battery: what follows from how a robot stands and moved since the last tick. Generic.
#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "common/control_interface/ci_battery_sensor.h"
#include "common/control_interface/ci_gyroscope_sensor.h"
#include "common/control_interface/ci_positioning_sensor.h"
#include "common/math/elementary.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

class Positioning : public CCI_PositioningSensor
{
public:
  explicit Positioning(const double* values) : values_(values) {}
  Vector3 GetPosition() const override { return {values_[0], values_[1], values_[2]}; }
  Quaternion GetOrientation() const override { return {values_[3], values_[4], values_[5], values_[6]}; }

private:
  const double* values_;  // x, y, z; w, x, y, z
};

class PositioningSensor : public SensorsOf<ValueSensor, Positioning>
{
public:
  double Reach() const override { return 0; }
  void Init(const DeviceSetup& setup) override
  {
    Reset(setup, 7);
    position_noise_ = NoiseFrom(setup.parameters, "position_");
    heading_noise_ = NoiseFrom(setup.parameters, "heading_");
    heading_streams_ = DeviceStreams(setup, "heading");
    for (std::size_t k = 0; k < robots_.size(); ++k) ValuesOf(k)[3] = 1;
    MakeDevices();
  }
  // A dead one reads the origin, not turned.
  void Expose(std::size_t k, ExposedValues& values) override
  {
    for (std::size_t i = 0; i < width_; ++i) values.Add(ValuesOf(k)[i], i == 3 ? 1 : 0);
  }
  void Update(const ChannelView&) override
  {
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      Pose pose = space_->GetPose(robots_[k]);
      if (position_noise_.IsActive())
      {
        RandomStream random = streams_.Of(k);
        for (Eigen::Index axis = 0; axis < 3; ++axis) pose.position[axis] += position_noise_.Sample(random);
      }
      if (heading_noise_.IsActive())
        pose.orientation = QuaternionFromYaw(heading_noise_.Sample(heading_streams_.Of(k))) * pose.orientation;
      const std::array<double, 7> values{pose.position.x(),    pose.position.y(),    pose.position.z(),
                                         pose.orientation.w(), pose.orientation.x(), pose.orientation.y(),
                                         pose.orientation.z()};
      std::copy(values.begin(), values.end(), ValuesOf(k));
    }
  }

private:
  NoiseModel position_noise_, heading_noise_;
  DeviceStreams heading_streams_;
};

// The poses of the robots one tick before. Robots that were outside the arena have none.
class LastPoses
{
public:
  void Reset(std::size_t robots) { poses_.assign(robots, {}); }
  // How robot k moved since the last call, in its own frame as it was then; nothing at the first one and outside the
  // arena.
  std::optional<Pose> Motion(std::size_t k, const Pose& now, bool is_present)
  {
    Last& last = poses_[k];
    std::optional<Pose> motion;
    if (is_present && last.is_known != 0)
      motion = Pose{{last.x, last.y, last.z}, Quaternion(last.qw, last.qx, last.qy, last.qz)}.Inverse().Compose(now);
    const Quaternion& q = now.orientation;
    last = {now.position.x(), now.position.y(), now.position.z(), q.w(), q.x(), q.y(), q.z(), is_present ? 1.0 : 0.0};
    return motion;
  }
  void SaveState(std::size_t k, ByteWriter& state) const { state.Put(poses_[k]); }
  void LoadState(std::size_t k, ByteReader& state) { poses_[k] = state.Get<Last>(); }

private:
  struct Last
  {
    double x = 0, y = 0, z = 0, qw = 1, qx = 0, qy = 0, qz = 0;
    double is_known = 0;
  };
  std::vector<Last> poses_;
};

// Returns axis and angle of a rotation as one vector, rad.
Vector3 RotationVector(const Quaternion& rotation)
{
  const Vector3 axis(rotation.x(), rotation.y(), rotation.z());
  const double sine = __builtin_sqrt(axis.squaredNorm());
  if (sine == 0) return Vector3::Zero();
  const double sign = rotation.w() < 0 ? -1 : 1;
  return axis * (sign * 2 * Atan2(sine, sign * rotation.w()) / sine);
}

class GyroscopeSensor : public SensorsOf<ValueSensor, ReadingsOf<CCI_GyroscopeSensor, 3>>
{
public:
  double Reach() const override { return 0; }
  void Init(const DeviceSetup& setup) override
  {
    Reset(setup, 3);
    noise_ = NoiseFrom(setup.parameters);
    last_.Reset(robots_.size());
    MakeDevices();
  }
  void Update(const ChannelView&) override
  {
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      const auto motion = last_.Motion(k, space_->GetPose(robots_[k]), space_->IsPresent(robots_[k]));
      const Vector3 turned = motion ? RotationVector(motion->orientation) : Vector3::Zero();
      for (Eigen::Index axis = 0; axis < 3; ++axis) ValuesOf(k)[axis] = turned[axis] / space_->GetTickSeconds();
    }
    AddNoise();
  }
  void SaveState(std::size_t k, ByteWriter& state) const override { last_.SaveState(k, state); }
  void LoadState(std::size_t k, ByteReader& state) override { last_.LoadState(k, state); }

private:
  LastPoses last_;
};

class Battery : public CCI_BatterySensor
{
public:
  explicit Battery(const double* values) : values_(values) {}
  double GetCharge() const override { return values_[0]; }
  double GetTimeLeft() const override { return values_[1]; }

private:
  const double* values_;
};

// The charge falls with time, way and angle, as in battery_equipped_entity.cpp of ARGoS3.
class BatterySensor : public SensorsOf<ValueSensor, Battery>
{
public:
  double Reach() const override { return 0; }
  void Init(const DeviceSetup& setup) override
  {
    Reset(setup, 2);
    noise_ = NoiseFrom(setup.parameters);
    per_tick_ = setup.parameters.Number("per_second") * setup.space.GetTickSeconds();
    per_metre_ = setup.parameters.Number("per_metre");
    per_radian_ = setup.parameters.Number("per_radian");
    charges_.assign(robots_.size(), setup.parameters.Number("start_charge"));
    last_.Reset(robots_.size());
    MakeDevices();
  }
  void Update(const ChannelView&) override
  {
    if (std::exchange(first_tick_, space_->FirstTick()) != space_->FirstTick()) return BeginAgain();
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      const auto motion = last_.Motion(k, space_->GetPose(robots_[k]), space_->IsPresent(robots_[k]));
      double used = 0;
      if (motion)
        used = per_tick_ + per_metre_ * __builtin_sqrt(motion->position.squaredNorm()) +
               per_radian_ * __builtin_sqrt(RotationVector(motion->orientation).squaredNorm());
      charges_[k] = std::max(charges_[k] - used, 0.0);
      Tell(k, used);
    }
    if (space_->GetTick() <= 1) first_charges_ = charges_;
  }
  void SaveState(std::size_t k, ByteWriter& state) const override
  {
    last_.SaveState(k, state);
    state.Put(charges_[k]);
  }
  void LoadState(std::size_t k, ByteReader& state) override
  {
    last_.LoadState(k, state);
    charges_[k] = state.Get<double>();
  }

private:
  // Restores the charge of the first tick. Moving the robots to their new positions counts as no way.
  void BeginAgain()
  {
    charges_ = first_charges_;
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      last_.Motion(k, space_->GetPose(robots_[k]), space_->IsPresent(robots_[k]));
      Tell(k, per_tick_);
    }
  }
  void Tell(std::size_t k, double used)
  {
    const double noise = noise_.IsActive() ? noise_.Sample(streams_.Of(k)) : 0;
    ValuesOf(k)[0] = std::clamp(charges_[k] + noise, 0.0, 1.0);
    ValuesOf(k)[1] = used > 0 ? charges_[k] / used * space_->GetTickSeconds() : std::numeric_limits<double>::infinity();
  }

  double per_tick_ = 0, per_metre_ = 0, per_radian_ = 0;
  std::uint64_t first_tick_ = 0;  // of the space, as far as it knows
  std::vector<double> charges_, first_charges_;
  LastPoses last_;
};

}  // namespace

const DeviceCode kMotionSensorsCode(
    []
    {
      BindSensor<PositioningSensor>("positioning", "generic_positioning");
      BindSensor<GyroscopeSensor>("gyroscope", "generic_gyroscope");
      BindSensor<BatterySensor>("battery", "generic_battery");
    });

}  // namespace swarmanoid
