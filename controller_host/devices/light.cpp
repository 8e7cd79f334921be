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

inline DoubleLanes Magnitude(DoubleLanes lanes)
{
  constexpr std::int64_t kAllButSign = 0x7fffffffffffffff;
  return reinterpret_cast<DoubleLanes>(reinterpret_cast<LongLanes>(lanes) & kAllButSign);
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
    const std::size_t room = points_.x.size();
    for (std::vector<std::uint32_t>* values : {&k_of_point_, &lit_}) values->resize(room);
    for (std::vector<double>* values :
         {&turned_z_, &turned_w_, &ahead_, &beside_, &square_, &lit_ahead_, &lit_beside_, &bearing_, &brightness_})
      values->resize(room);
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
      const std::int32_t k = place_of_entity_[robot];
      if (k < 0 || !IsDue(static_cast<std::size_t>(k))) continue;
      constexpr double kHeight = Model::template kHeight<Interface>;
      const Vector3 point = IsUpright(poses, robot) ? Vector3(poses.x[robot], poses.y[robot], poses.z[robot] + kHeight)
                                                    : this->space_->GetPose(robot).Apply({0, 0, kHeight});
      const std::size_t i = points_.count++;
      points_.x[i] = point.x();
      points_.y[i] = point.y();
      points_.z[i] = point.z();
      points_.robot[i] = robot;
      k_of_point_[i] = static_cast<std::uint32_t>(k);
      turned_z_[i] = poses.qz[robot];
      turned_w_[i] = poses.qw[robot];
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
    FindWays(source);

    // The lit points are compacted, so that many bearings are computed at a time.
    std::size_t lit = 0;
    for (const std::uint32_t p : seen_)
    {
      brightness_[lit] = Model::Brightness(intensity, square_[p]);
      lit_ahead_[lit] = ahead_[p];
      lit_beside_[lit] = beside_[p];
      lit_[lit] = k_of_point_[p];
      lit += brightness_[lit] >= kNegligible ? 1 : 0;
    }
    const std::size_t whole = (lit + kLanes - 1) / kLanes * kLanes;
    Atan2Each({lit_beside_.data(), whole}, {lit_ahead_.data(), whole}, {bearing_.data(), whole});
    for (std::size_t i = 0; i < lit; ++i) Shine(this->ValuesOf(lit_[i]), bearing_[i], brightness_[i]);
  }

  // Finds the way from each point to a source in the frame of its robot. For an upright robot the quaternion has
  // x = y = 0, which shortens the product.
  void FindWays(const Vector3& source)
  {
    for (std::size_t i = 0; i < points_.count; i += kDoubleLanes)
    {
      const DoubleLanes x = source.x() - LoadLanes(&points_.x[i]);
      const DoubleLanes y = source.y() - LoadLanes(&points_.y[i]);
      const DoubleLanes up = source.z() - LoadLanes(&points_.z[i]);
      const DoubleLanes z = -LoadLanes(&turned_z_[i]);
      const DoubleLanes w = LoadLanes(&turned_w_[i]);
      const DoubleLanes x2 = -z * y + -z * y;
      const DoubleLanes y2 = z * x + z * x;
      const DoubleLanes ahead = x + w * x2 - z * y2;
      const DoubleLanes beside = y + w * y2 + z * x2;
      StoreLanes(ahead, &ahead_[i]);
      StoreLanes(beside, &beside_[i]);
      StoreLanes(ahead * ahead + (beside * beside + up * up), &square_[i]);
    }
    if (world_->Grid().AllUpright()) return;
    for (std::size_t i = 0; i < points_.count; ++i)
    {
      if (IsUpright(this->space_->Poses(), points_.robot[i])) continue;
      const Eigen::Quaterniond to_robot = this->space_->GetPose(points_.robot[i]).orientation.conjugate();
      const Vector3 way = to_robot * Vector3(source - points_.At(i));
      ahead_[i] = way.x();
      beside_[i] = way.y();
      square_[i] = way.squaredNorm();
    }
  }

  // Adds a light to the sensors that face it: at most kFacing neighbours, since a sensor sees a quarter turn to each
  // side. They begin left of the light's right side, but at it if rounding leaves this open.
  void Shine(double* readings, double bearing, double brightness) const
  {
    constexpr double kRounding = 1e-9;
    const double right = (bearing - kPi / 2 - Interface::FIRST_ANGLE) / Interface::SPACING + kSensors;
    const unsigned* group = &kGroups[static_cast<std::size_t>(right + (1 - kRounding)) / kDoubleLanes];
    constexpr unsigned kFacing = kSensors / 2 + 1;
    for (unsigned n = 0; n < (kFacing + kDoubleLanes - 2) / kDoubleLanes + 1; ++n, ++group)
    {
      const DoubleLanes turn = Magnitude(bearing - LoadLanes(&angles_[*group]));
      const DoubleLanes off = Minimum(turn, Magnitude(2 * kPi - turn));
      const DoubleLanes share = Maximum(1 - off / (kPi / 2), DoubleLanes{});
      StoreLanes(LoadLanes(&readings[*group]) + brightness * share, &readings[*group]);
    }
  }

  // The first sensor of each kDoubleLanes around the ring, for two turns.
  static constexpr auto kGroups = []
  {
    std::array<unsigned, 2 * kSensors / kDoubleLanes> groups{};
    for (unsigned n = 0; n < groups.size(); ++n) groups[n] = n * kDoubleLanes % kSensors;
    return groups;
  }();

  std::shared_ptr<SensorWorld> world_;
  std::vector<Bulb> bulbs_;
  std::vector<FixedShadows> fixed_;  // by bulb
  std::unique_ptr<MovingShadows> shadows_;
  std::vector<std::int32_t> place_of_entity_;  // k of an entity, or -1
  std::vector<std::uint32_t> made_;            // k of the robots whose readings were due
  // By point of this tick: the k and the orientation of its robot, and the way to the bulb in turn (m, m²).
  SightedPoints points_;
  std::vector<std::uint32_t> k_of_point_;
  std::vector<double> turned_z_, turned_w_;
  std::vector<double> ahead_, beside_, square_;
  std::vector<std::uint32_t> seen_;  // numbers of points that see the bulb in turn
  // By robot that the bulb in turn lights: k, the way to the bulb, and how it sees the bulb.
  std::vector<std::uint32_t> lit_;
  std::vector<double> lit_ahead_, lit_beside_, bearing_, brightness_;
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
