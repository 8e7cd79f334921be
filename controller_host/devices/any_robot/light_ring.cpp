// Light sensors in a ring around the body, as ARGoS3 has them on robots. Generic.
//
// generic_light (light_default_sensor.cpp of ARGoS3): each sensor adds up (I / d)^2 of the lights of intensity I that
// it sees at a distance of d m, at any angle. The own body hides lights on the other side.
//
// argos3_light (the sensors of robots of its plug-ins): all sensors are at one point, which the own body does not hide.
// Each adds up exp(-2 d / I) of the lights, less by the angle between the light and the direction of the sensor.
#include <algorithm>
#include <memory>

#include "common/configuration/configuration_tree.h"
#include "common/control_interface/ci_light_sensor.h"
#include "common/math/elementary.h"
#include "common/space/space.h"
#include "controller_host/devices/any_robot/ring_readings.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/sensing/sensor_world.h"
#include "controller_host/devices/sensing/shadows.h"
#include "controller_host/devices/value_devices.h"
#include "controller_host/on_demand_sensor.h"

namespace swarmanoid
{
namespace
{

// Finds the lights that a ring sees. The classes derived from it have the points and the response of the sensors.
class LightRing : public ValueSensor, public OnDemandSensor
{
public:
  void Init(const DeviceSetup& setup) override
  {
    angles_ = AnglesFrom(setup.parameters);
    Reset(setup, angles_.size());
    noise_ = NoiseFrom(setup.parameters);
    world_ = SensorWorld::Of(setup.space);
    for (std::uint32_t e = 0; e < setup.space.Size(); ++e)
      if (DescriptionOf(setup.space.GetEntity(e).GetKind()).role == EntityRole::kLight)
        bulbs_.push_back({e, setup.space.GetEntity(e).SlotOf("intensity")});
    fixed_.resize(bulbs_.size());
    shadows_ = std::make_unique<MovingShadows>(*world_);
    InitDemand(robots_.size());
    devices_.reserve(robots_.size());
    for (std::size_t k = 0; k < robots_.size(); ++k) devices_.emplace_back(ValuesOf(k), angles_, *this, k);
    Configure(setup.parameters);
  }
  RingReadings<CCI_LightSensor>* Sensor(std::size_t k) override { return &devices_[k]; }

  void RefreshShared(WorkerPool* pool) override { world_->Refresh(pool); }
  void Update(const ChannelView&) override { MakeAhead(); }

protected:
  // Returns the directions of the sensors, rad.
  virtual std::vector<double> AnglesFrom(const Parameters& parameters) const = 0;
  virtual void Configure(const Parameters& parameters) = 0;
  // Fills points_ with the points of robots that are due, from which a light at `source` may be seen.
  virtual void CollectPoints(const Vector3& source) = 0;
  // Returns the distance (m) at which a light is not seen any more.
  virtual double ReachOf(double intensity) const = 0;
  // Adds a light that is seen from these of points_.
  virtual void Shine(const std::vector<std::uint32_t>& seen, const Vector3& source, double intensity) = 0;

  // Darker lights are not seen: this is half a step of a 12-bit converter.
  static constexpr double kNegligible = 1e-4;

  Vector3 PointOf(std::uint32_t p) const { return {points_.x[p], points_.y[p], points_.z[p]}; }
  void AddPoint(std::size_t k, const Vector3& point)
  {
    points_.x[points_.count] = point.x();
    points_.y[points_.count] = point.y();
    points_.z[points_.count] = point.z();
    points_.robot[points_.count++] = robots_[k];
  }

  std::vector<double> angles_;
  SightedPoints points_;  // of the bulb in turn

private:
  struct Bulb
  {
    std::uint32_t entity;
    std::uint32_t intensity_slot;
  };

  void MakeDue() override
  {
    for (std::size_t k = 0; k < robots_.size(); ++k)
      if (IsDue(k)) std::fill_n(ValuesOf(k), width_, 0.0);
    for (std::size_t b = 0; b < bulbs_.size(); ++b) AddBulb(b);
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      if (!IsDue(k)) continue;
      if (noise_.IsActive()) AddNoise(k);
      for (std::size_t i = 0; i < width_; ++i) ValuesOf(k)[i] = std::clamp(ValuesOf(k)[i], 0.0, 1.0);
    }
  }

  void AddBulb(std::size_t b)
  {
    const double intensity = space_->Attributes()[bulbs_[b].intensity_slot];
    if (intensity <= 0 || !space_->IsPresent(bulbs_[b].entity)) return;
    const Vector3 source = space_->GetPose(bulbs_[b].entity).position;
    points_.count = 0;
    CollectPoints(source);
    fixed_[b].Place(*world_, source);
    shadows_->Sort(source, ReachOf(intensity));
    seen_.clear();
    shadows_->Look(points_, fixed_[b], seen_);
    Shine(seen_, source, intensity);
  }

  std::shared_ptr<SensorWorld> world_;
  std::vector<Bulb> bulbs_;
  std::vector<FixedShadows> fixed_;  // by bulb
  std::unique_ptr<MovingShadows> shadows_;
  std::vector<std::uint32_t> seen_;
  std::vector<RingReadings<CCI_LightSensor>> devices_;
};

class InverseSquareRing : public LightRing
{
private:
  std::vector<double> AnglesFrom(const Parameters& parameters) const override
  {
    const auto count = static_cast<std::size_t>(parameters.Integer("sensors"));
    const double first = DegreesToRadians(parameters.Number("first_angle"));
    std::vector<double> angles;
    for (std::size_t i = 0; i < count; ++i)
      angles.push_back(WrapAngle(first + 2 * kPi * static_cast<double>(i) / static_cast<double>(count)));
    return angles;
  }
  void Configure(const Parameters& parameters) override
  {
    for (const double angle : angles_)
    {
      const SinCos direction = SinCosOf(angle);
      outwards_.emplace_back(direction.cos, direction.sin, 0);
    }
    radius_ = parameters.Number("radius");
    height_ = parameters.Number("height");
    points_.Reserve(robots_.size() * width_);
    sensor_of_point_.resize(robots_.size() * width_);
  }
  double ReachOf(double intensity) const override { return intensity / __builtin_sqrt(kNegligible); }

  // Collects the sensors on the side of their bodies that faces the source.
  void CollectPoints(const Vector3& source) override
  {
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      if (!IsDue(k)) continue;
      const Pose pose = space_->GetPose(robots_[k]);
      for (std::size_t i = 0; i < width_; ++i)
      {
        const Vector3 point = pose.Apply(Vector3(radius_ * outwards_[i] + Vector3(0, 0, height_)));
        if ((source - point).dot(pose.orientation * outwards_[i]) <= 0) continue;
        sensor_of_point_[points_.count] = k * width_ + i;
        AddPoint(k, point);
      }
    }
  }

  void Shine(const std::vector<std::uint32_t>& seen, const Vector3& source, double intensity) override
  {
    for (const std::uint32_t p : seen)
    {
      const double square = (source - PointOf(p)).squaredNorm();
      const double brightness = intensity * intensity / std::max(square, 1e-12);
      if (brightness >= kNegligible) values_[sensor_of_point_[p]] += brightness;
    }
  }

  std::vector<Vector3> outwards_;  // in the frame of the robot, of length 1
  double radius_ = 0, height_ = 0;
  std::vector<std::size_t> sensor_of_point_;
};

class ExponentialRing : public LightRing
{
private:
  std::vector<double> AnglesFrom(const Parameters& parameters) const override
  {
    std::vector<double> angles = *ParseNumbers(parameters.Text("directions"));
    for (double& angle : angles) angle = WrapAngle(DegreesToRadians(angle));
    return angles;
  }
  void Configure(const Parameters& parameters) override
  {
    position_ = parameters.Vector3Of("position");
    half_angle_ = DegreesToRadians(parameters.Number("half_angle"));
    index_step_ = DegreesToRadians(parameters.Number("index_step"));
    points_.Reserve(robots_.size());
    k_of_point_.resize(robots_.size());
  }
  double ReachOf(double intensity) const override { return kEnds * intensity; }

  void CollectPoints(const Vector3&) override
  {
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      if (!IsDue(k)) continue;
      k_of_point_[points_.count] = k;
      AddPoint(k, space_->GetPose(robots_[k]).Apply(position_));
    }
  }

  void Shine(const std::vector<std::uint32_t>& seen, const Vector3& source, double intensity) override
  {
    for (const std::uint32_t p : seen) ShineOn(k_of_point_[p], source - PointOf(p), intensity);
  }

  // Adds a light whose direction and distance in the space are `to_light`.
  void ShineOn(std::size_t k, const Vector3& to_light, double intensity)
  {
    const Vector3 way = space_->GetPose(robots_[k]).orientation.conjugate() * to_light;
    const double scaled = way.norm() / intensity;
    if (scaled > kEnds) return;
    const double brightness = Exp(-2 * scaled);
    const double bearing = Atan2(way.y(), way.x());
    double* const readings = ValuesOf(k);
    const auto shine = [&](std::size_t i)
    {
      const double off = __builtin_fabs(WrapAngle(bearing - angles_[i]));
      readings[i] += brightness * std::max(1 - off / half_angle_, 0.0);
    };
    if (index_step_ == 0)
    {
      for (std::size_t i = 0; i < width_; ++i) shine(i);
      return;
    }
    const auto count = static_cast<long long>(width_);
    const auto nearest = static_cast<long long>(bearing / index_step_ + (bearing > 0 ? 0.5 : -0.5));
    for (long long offset = -2; offset <= 2; ++offset)
      shine(static_cast<std::size_t>(((nearest + offset) % count + count) % count));
  }

  static constexpr double kEnds = 2.5;  // distance / intensity

  Vector3 position_ = Vector3::Zero();  // in the frame of the robot
  double half_angle_ = 0, index_step_ = 0;
  std::vector<std::size_t> k_of_point_;
};

}  // namespace

const DeviceCode kLightRingCode(
    []
    {
      BindSensor<InverseSquareRing>("light", "generic_light");
      BindSensor<ExponentialRing>("light", "argos3_light");
    });

}  // namespace swarmanoid
