// The 24 light sensors around footbots and eyebots. Each bulb in line of sight adds its brightness to the sensors that
// face it, falling off linearly to nothing at 90 degrees. Generic.
#include <algorithm>
#include <array>
#include <memory>

#include "common/control_interface/eyebot/ci_eyebot_light_sensor.h"
#include "common/control_interface/footbot/ci_footbot_light_sensor.h"
#include "common/math/elementary.h"
#include "common/math/lanes.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/sensing/sensor_world.h"
#include "controller_host/devices/sensing/shadows.h"
#include "controller_host/devices/value_devices.h"
#include "controller_host/on_demand_sensor.h"

namespace swarmanoid
{
namespace
{

// A bulb that is less bright than this at a robot is not seen there: half a step of a converter of 12 bits.
constexpr double kNegligible = 1e-4;

// The brightness of a bulb from its intensity I and the square of its distance d in m. The model also has the distance
// up to which a bulb is seen, and the height of the sensors above the base.
struct InverseSquare  // (I / d)^2
{
  template <class Interface>
  static constexpr double kHeight = Interface::RING_HEIGHT_M;
  static double Brightness(double intensity, double square) { return intensity * intensity / std::max(square, 1e-12); }
  static double Reach(double intensity) { return 100 * intensity; }
};

struct Argos3  // exp(-2 d / I), nothing beyond d / I = 2.5: footbot_light_rotzonly_sensor.cpp of ARGoS3
{
  template <class Interface>
  static constexpr double kHeight = 0;
  static double Brightness(double intensity, double square)
  {
    const double scaled = __builtin_sqrt(square) / intensity;
    return scaled > kEnds ? 0 : Exp(-2 * scaled);
  }
  static double Reach(double intensity) { return kEnds * intensity; }
  static constexpr double kEnds = 2.5;
};

// Does what WrapAngle does, for lanes.
inline DoubleLanes Wrapped(DoubleLanes angle)
{
  constexpr double kRounder = 0x1.8p52;  // adding it leaves no fraction
  const DoubleLanes turns = (angle * (0.5 / kPi) + kRounder) - kRounder;
  return angle - turns * (2 * kPi);
}

template <class Interface, class Model>
class LightSensor : public ValueSensor, public OnDemandSensor
{
public:
  void Init(const DeviceSetup& setup) override
  {
    this->Reset(setup, Interface::NUM_SENSORS);
    this->noise_ = NoiseFrom(setup.parameters);
    world_ = SensorWorld::Of(setup.space);
    bulbs_.clear();
    for (std::uint32_t e = 0; e < setup.space.Size(); ++e)
      if (DescriptionOf(setup.space.GetEntity(e).GetKind()).role == EntityRole::kLight)
        bulbs_.push_back({e, setup.space.GetEntity(e).SlotOf("intensity")});
    fixed_.resize(bulbs_.size());
    shadows_ = std::make_unique<MovingShadows>(*world_);
    place_of_entity_.assign(setup.space.Size(), -1);
    for (std::size_t k = 0; k < this->robots_.size(); ++k)
      place_of_entity_[this->robots_[k]] = static_cast<std::int32_t>(k);
    points_.Reserve(this->robots_.size());
    for (unsigned i = 0; i < kSensors; ++i) angles_[i] = Interface::AngleOf(i);
    InitDemand(this->robots_.size());
    devices_.reserve(this->robots_.size());
    for (std::size_t k = 0; k < this->robots_.size(); ++k) devices_.emplace_back(this->ValuesOf(k), *this, k);
  }
  Interface* Sensor(std::size_t k) override { return &devices_[k]; }

  void RefreshShared(WorkerPool* pool) override { world_->Refresh(pool); }
  void Update(const ChannelView&) override { MakeAhead(); }

private:
  struct Bulb
  {
    std::uint32_t entity;
    std::uint32_t intensity_slot;
  };

  static constexpr unsigned kSensors = Interface::NUM_SENSORS;
  static_assert(kSensors % kDoubleLanes == 0);

  // Makes all readings together, so that the bodies around a bulb are sorted once.
  void MakeDue() override
  {
    for (std::size_t k = 0; k < this->robots_.size(); ++k)
      if (IsDue(k)) std::fill_n(this->ValuesOf(k), kSensors, 0.0);
    CollectPoints();
    for (std::size_t b = 0; b < bulbs_.size(); ++b) AddBulb(b);
    made_.clear();
    for (std::size_t k = 0; k < this->robots_.size(); ++k)
    {
      if (!IsDue(k)) continue;
      made_.push_back(static_cast<std::uint32_t>(k));
      double* const values = this->ValuesOf(k);
      for (unsigned i = 0; i < kSensors; ++i) values[i] = std::min(values[i], 1.0);
    }
    if (!this->noise_.IsActive()) return;
    this->AddNoise(made_);
    for (const std::uint32_t k : made_)
    {
      double* const values = this->ValuesOf(k);
      for (unsigned i = 0; i < kSensors; ++i) values[i] = std::clamp(values[i], 0.0, 1.0);
    }
  }

  // Collects the sensor positions of robots that are due, in the order of the grid's cells, so that neighbours stay in
  // the cache.
  void CollectPoints()
  {
    points_.count = 0;
    const PoseArrays& poses = this->space_->Poses();
    for (const std::uint32_t robot : world_->Grid().Sorted())
    {
      if (const std::int32_t k = place_of_entity_[robot]; k < 0 || !IsDue(static_cast<std::size_t>(k))) continue;
      constexpr double kHeight = Model::template kHeight<Interface>;
      const Vector3 point = IsUpright(poses, robot) ? Vector3(poses.x[robot], poses.y[robot], poses.z[robot] + kHeight)
                                                    : this->space_->GetPose(robot).Apply({0, 0, kHeight});
      points_.x[points_.count] = point.x();
      points_.y[points_.count] = point.y();
      points_.z[points_.count] = point.z();
      points_.robot[points_.count++] = robot;
    }
  }

  void AddBulb(std::size_t b)
  {
    const CSwarmanoidSpace& space = *this->space_;
    const double intensity = space.Attributes()[bulbs_[b].intensity_slot];
    if (intensity <= 0 || !space.IsPresent(bulbs_[b].entity)) return;
    const Vector3 source = space.GetPose(bulbs_[b].entity).position;
    fixed_[b].Place(*world_, source);
    shadows_->Sort(source, Model::Reach(intensity));
    seen_.clear();
    shadows_->Look(points_, fixed_[b], seen_);

    const std::size_t whole = (seen_.size() + kLanes - 1) / kLanes * kLanes;
    for (std::vector<double>* values : {&ahead_, &beside_, &brightness_, &bearing_}) values->resize(whole);
    for (std::size_t i = 0; i < seen_.size(); ++i)
    {
      const std::uint32_t p = seen_[i];
      const Vector3 way = source - Vector3(points_.x[p], points_.y[p], points_.z[p]);
      const Vector3 place = InFrameOf(points_.robot[p], way);
      ahead_[i] = place.x();
      beside_[i] = place.y();
      brightness_[i] = Model::Brightness(intensity, place.squaredNorm());
    }
    Atan2Each(beside_, ahead_, bearing_);
    for (std::size_t i = 0; i < seen_.size(); ++i)
      if (brightness_[i] >= kNegligible)
        Shine(this->ValuesOf(static_cast<std::size_t>(place_of_entity_[points_.robot[seen_[i]]])), bearing_[i],
              brightness_[i]);
  }

  // Turns a direction into the frame of a robot. For an upright robot the quaternion has x = y = 0, which shortens the
  // product.
  Vector3 InFrameOf(std::uint32_t robot, const Vector3& way) const
  {
    const PoseArrays& poses = this->space_->Poses();
    if (!IsUpright(poses, robot)) return this->space_->GetPose(robot).orientation.conjugate() * way;
    const double z = -poses.qz[robot];
    const double w = poses.qw[robot];
    const double x2 = -z * way.y() + -z * way.y();
    const double y2 = z * way.x() + z * way.x();
    return {way.x() + w * x2 - z * y2, way.y() + w * y2 + z * x2, way.z()};
  }

  void Shine(double* readings, double bearing, double brightness) const
  {
    for (unsigned i = 0; i < kSensors; i += kDoubleLanes)
    {
      const DoubleLanes turn = Wrapped(LoadLanes(&angles_[i]) - bearing);
      const DoubleLanes off = Maximum(turn, -turn);
      const DoubleLanes share = Maximum(1 - off / (kPi / 2), DoubleLanes{});
      StoreLanes(LoadLanes(&readings[i]) + brightness * share, &readings[i]);
    }
  }

  std::shared_ptr<SensorWorld> world_;
  std::vector<Bulb> bulbs_;
  std::vector<FixedShadows> fixed_;  // by bulb
  std::unique_ptr<MovingShadows> shadows_;
  std::vector<std::int32_t> place_of_entity_;  // k of an entity, or -1
  std::vector<std::uint32_t> made_;            // k of the robots whose readings were due
  SightedPoints points_;                       // of this tick
  std::vector<std::uint32_t> seen_;            // of them, by the bulb in turn
  std::vector<double> ahead_, beside_, bearing_, brightness_;
  std::array<double, kSensors> angles_{};
  std::vector<ReadingsOnDemand<Interface, kSensors>> devices_;
};

}  // namespace

const DeviceCode kLightCode(
    []
    {
      BindSensor<LightSensor<CCI_FootBotLightSensor, InverseSquare>>("footbot_light", "generic_footbot_light");
      BindSensor<LightSensor<CCI_FootBotLightSensor, Argos3>>("footbot_light", "argos3_footbot_light");
      BindSensor<LightSensor<CCI_EyeBotLightSensor, InverseSquare>>("eyebot_light", "generic_eyebot_light");
      BindSensor<LightSensor<CCI_EyeBotLightSensor, Argos3>>("eyebot_light", "argos3_eyebot_light");
    });

}  // namespace swarmanoid
