// The ground sensors: those of the footbot (all eight in grey, those of its base, those of its motors), and those of
// any robot whose kind has them. They read the brightness of the floor under some points and its colour under the
// middle. Patches cover each other in the order of the experiment file, and some have a picture. Holes in the floor or
// in terrain are black. Generic.
#include <algorithm>

#include "common/control_interface/ci_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_base_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_motor_ground_sensor.h"
#include "common/math/cells.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/kind_of_batch.h"
#include "controller_host/devices/sensing/engine_membership.h"
#include "controller_host/devices/sensing/floor_patches.h"
#include "controller_host/devices/sensing/sensor_world.h"
#include "controller_host/devices/value_devices.h"
#include "controller_host/split_sensor.h"

namespace swarmanoid
{
namespace
{

constexpr double kNearFloor = 0.1;  // m: a robot higher above a patch does not see it
constexpr double kMargin = 1e-9;    // m

// The colour stands behind the readings.
class FootbotGround : public CCI_FootBotGroundSensor
{
public:
  FootbotGround(const double* values, std::size_t) : values_(values) {}
  std::span<const double, NUM_SENSORS> GetAllSensorReadings() const override
  {
    return std::span<const double, NUM_SENSORS>(values_, NUM_SENSORS);
  }
  std::uint32_t GetFloorColour() const override { return static_cast<std::uint32_t>(values_[NUM_SENSORS]); }

private:
  const double* values_;
};

class AnyGround : public CCI_GroundSensor
{
public:
  AnyGround(const double* values, std::size_t count) : readings_(values, count), colour_(values + count) {}
  std::span<const double> GetAllSensorReadings() const override { return readings_; }
  std::uint32_t GetFloorColour() const override { return static_cast<std::uint32_t>(*colour_); }

private:
  std::span<const double> readings_;
  const double* colour_;
};

template <class Interface>
class FixedGround : public ReadingsOf<Interface, Interface::NUM_SENSORS>
{
public:
  FixedGround(const double* values, std::size_t) : ReadingsOf<Interface, Interface::NUM_SENSORS>(values) {}
};

// The positions of the sensors, and their reading for a brightness.
struct AsTheKindSays
{
  static std::vector<Vector2> Points(const DeviceSetup& setup) { return KindOfBatch(setup).ground_points; }
  static double Reading(double brightness) { return brightness; }
};

template <class Interface, bool kBlackOrWhite>
struct AsTheInterfaceSays
{
  static std::vector<Vector2> Points(const DeviceSetup&)
  {
    std::vector<Vector2> points;
    for (const auto& [x, y] : Interface::PLACES_M) points.emplace_back(x, y);
    return points;
  }
  static double Reading(double brightness) { return kBlackOrWhite ? (brightness < 0.5 ? 0.0 : 1.0) : brightness; }
};

// Returns the luma of Rec. 601.
double Brightness(std::uint32_t colour)
{
  return (0.299 * (colour >> 16 & 0xff) + 0.587 * (colour >> 8 & 0xff) + 0.114 * (colour & 0xff)) / 255;
}

template <class Device, class Model = AsTheKindSays>
class GroundSensor : public ValueSensor, public SplitSensor
{
public:
  void Init(const DeviceSetup& setup) override
  {
    points_ = Model::Points(setup);
    Reset(setup, points_.size() + 1);
    ground_noise_ = NoiseFrom(setup.parameters);
    floor_colour_ = setup.parameters.Colour("floor_colour");
    world_ = SensorWorld::Of(setup.space);
    patches_ = FloorPatchesOf(setup.space);
    for (const Vector2& point : points_) reach_ = std::max(reach_, point.norm() + kMargin);
    for (std::size_t k = 0; k < robots_.size(); ++k) devices_.emplace_back(ValuesOf(k), points_.size());
  }

  Device* Sensor(std::size_t k) override { return &devices_[k]; }

  // Patches of the floor are there for everybody.
  double Reach() const override { return 0; }

  void RefreshShared(WorkerPool* pool) override { world_->Refresh(pool); }
  void Update(const ChannelView&) override
  {
    SortPatches();
    for (std::size_t k = 0; k < robots_.size(); ++k) Sense(k);
  }

private:
  // Lists each patch in the cells from which some robot may see it. They seldom move.
  void SortPatches()
  {
    const auto stands = [this](const FloorPatch& patch)
    {
      const Pose pose = space_->GetPose(patch.entity);
      return pose.position == patch.pose.position && pose.orientation.coeffs() == patch.pose.orientation.coeffs();
    };
    if (is_sorted_ && std::ranges::all_of(patches_, stands)) return;
    is_sorted_ = true;
    Vector2 low = Vector2::Constant(1e9), high = -low;
    for (FloorPatch& patch : patches_)
    {
      patch.pose = space_->GetPose(patch.entity);
      const Vector2 at(patch.pose.position.x(), patch.pose.position.y());
      const Vector2 reach = Vector2::Constant(patch.radius + reach_);
      low = low.cwiseMin(at - reach);
      high = high.cwiseMax(at + reach);
    }
    if (patches_.empty()) low = high = Vector2::Zero();
    constexpr double kSmallest = 0.1;  // m
    constexpr double kMost = 16384;
    const Vector2 size = high - low;
    cells_ = {low.x(), low.y(), size.x(), size.y(), CellEdge<2>({size.x(), size.y()}, kSmallest, kMost)};
    patches_in_ = {};
    for (std::uint32_t p = 0; p < patches_.size(); ++p)
    {
      const Vector3& at = patches_[p].pose.position;
      const double reach = patches_[p].radius + reach_;
      cells_.ForEachRow(at.x() - reach, at.y() - reach, at.x() + reach, at.y() + reach,
                        [&](std::uint32_t first, std::uint32_t last)
                        {
                          for (std::uint32_t cell = first; cell <= last; ++cell) patches_in_.Add(cell, p);
                        });
    }
    patches_in_.Close(cells_.Count());
  }

  void Sense(std::size_t k)
  {
    const Pose pose = space_->GetPose(robots_[k]);
    double* values = ValuesOf(k);
    std::fill_n(values, points_.size(), Brightness(floor_colour_));
    values[points_.size()] = floor_colour_;
    if (!world_->Terrain().IsEmpty() && !IsOnPlane(robots_[k])) SenseTerrain(robots_[k], pose, values);
    // The patches are in the order of the experiment file.
    for (const std::uint32_t p : patches_in_.In(cells_.CellOf(pose.position.x(), pose.position.y())))
    {
      const FloorPatch& patch = patches_[p];
      const Pose& place = patch.pose;
      const double reach = patch.radius + reach_;
      const Vector3 offset = pose.position - place.position;
      if (offset.x() * offset.x() + offset.y() * offset.y() > reach * reach) continue;
      if (__builtin_fabs(offset.z()) > kNearFloor) continue;
      const std::uint32_t tint =
          patch.is_hole ? 0 : static_cast<std::uint32_t>(space_->Attributes()[patch.colour_slot]);
      const Pose relative = place.Inverse().Compose(pose);
      for (std::size_t i = 0; i < points_.size(); ++i)
      {
        const Vector3 point = relative.Apply({points_[i].x(), points_[i].y(), 0});
        if (patch.Contains(point.x(), point.y())) values[i] = Brightness(patch.Colour(tint, point.x(), point.y()));
      }
      const auto [x, y] = std::pair(relative.position.x(), relative.position.y());
      if (patch.Contains(x, y)) values[points_.size()] = patch.Colour(tint, x, y);
    }
    if (ground_noise_.IsActive())
    {
      samples_.resize(points_.size());
      streams_.Sample(ground_noise_, k, samples_);
      for (std::size_t i = 0; i < points_.size(); ++i) values[i] = std::clamp(values[i] + samples_[i], 0.0, 1.0);
    }
    for (std::size_t i = 0; i < points_.size(); ++i) values[i] = Model::Reading(values[i]);
  }

  // There is a hole if no terrain of the robot's world has ground near it, and the floor z = 0 is not near either.
  // Engines of planes have ground everywhere.
  void SenseTerrain(std::uint32_t robot, const Pose& pose, double* values) const
  {
    const auto counts = [&](std::uint32_t terrain) { return world_->CanHideFrom(robot, terrain); };
    const auto is_hole = [&](const Vector2& local)
    {
      const Vector3 point = pose.Apply({local.x(), local.y(), kNearFloor});
      const std::optional<double> depth = world_->Terrain().DepthOfGround(point, counts);
      return __builtin_fabs(point.z() - kNearFloor) > kNearFloor && !(depth && *depth <= 2 * kNearFloor);
    };
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (is_hole(points_[i])) values[i] = 0;
    if (is_hole({0, 0})) values[points_.size()] = 0;
  }

  bool IsOnPlane(std::uint32_t robot) const
  {
    const auto& engines = space_->GetExperiment().engines;
    const auto holds = [robot](const EngineConfiguration& engine)
    {
      const bool is_plane = IsPlane(engine);
      return is_plane && std::binary_search(engine.entities.begin(), engine.entities.end(), robot);
    };
    return std::any_of(engines.begin(), engines.end(), holds);
  }

  std::shared_ptr<SensorWorld> world_;
  std::uint32_t floor_colour_ = 0;
  NoiseModel ground_noise_;
  std::vector<FloorPatch> patches_;
  bool is_sorted_ = false;
  PlaneCells<double> cells_;
  CellLists patches_in_;         // by cell
  std::vector<Vector2> points_;  // m, in the frame of the robot
  double reach_ = 0;             // m: of the farthest of them
  std::vector<double> samples_;  // of noise
  std::vector<Device> devices_;
};

}  // namespace

const DeviceCode kGroundCode(
    []
    {
      BindSensor<GroundSensor<FootbotGround>>("footbot_ground", "generic_footbot_ground");
      using Base = CCI_FootBotBaseGroundSensor;
      BindSensor<GroundSensor<FixedGround<Base>, AsTheInterfaceSays<Base, true>>>("footbot_base_ground",
                                                                                  "generic_footbot_base_ground");
      using Motor = CCI_FootBotMotorGroundSensor;
      BindSensor<GroundSensor<FixedGround<Motor>, AsTheInterfaceSays<Motor, false>>>("footbot_motor_ground",
                                                                                     "generic_footbot_motor_ground");
      BindSensor<GroundSensor<AnyGround>>("ground", "generic_ground");
    });

}  // namespace swarmanoid
