// The ground sensors of the footbot: brightness of the floor under eight points, and its colour under the middle.
// Patches lie on one another in the order of the experiment file; holes, of the floor or of terrain, are black.
// Generic.
#include <algorithm>

#include "common/control_interface/footbot/ci_footbot_ground_sensor.h"
#include "common/math/elementary.h"
#include "controller_host/devices/builtin_devices.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/sensing/sensor_world.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kSensors = CCI_FootBotGroundSensor::NUM_SENSORS;
constexpr double kRingRadius = 0.08;            // m
constexpr double kNearFloor = 0.1;              // m: a robot higher above a patch does not see it
constexpr std::size_t kColourValue = kSensors;  // place of the colour behind the readings

class Ground : public CCI_FootBotGroundSensor
{
public:
  explicit Ground(const double* values) : values_(values) {}
  std::span<const double, NUM_SENSORS> GetAllSensorReadings() const override
  {
    return std::span<const double, NUM_SENSORS>(values_, NUM_SENSORS);
  }
  std::uint32_t GetFloorColour() const override { return static_cast<std::uint32_t>(values_[kColourValue]); }

private:
  const double* values_;
};

// Rec. 601 luma.
double Brightness(std::uint32_t colour)
{
  return (0.299 * (colour >> 16 & 0xff) + 0.587 * (colour >> 8 & 0xff) + 0.114 * (colour & 0xff)) / 255;
}

class GroundSensor : public SensorsOf<ValueSensor, Ground>
{
public:
  static std::vector<ParameterSpec> ParameterTable()
  {
    return Joined({{.name = "floor_colour",
                    .type = ParameterType::kColour,
                    .default_value = "#ffffff",
                    .description = "Colour of the floor outside all patches."}},
                  NoiseParameters("each brightness", ""));
  }

  void Init(const DeviceSetup& setup) override
  {
    Reset(setup, kSensors + 1);
    ground_noise_ = NoiseFrom(setup.parameters);
    floor_colour_ = setup.parameters.Colour("floor_colour");
    world_ = SensorWorld::Of(setup.space);
    patches_.clear();
    for (std::uint32_t e = 0; e < setup.space.Size(); ++e)
    {
      const CSwarmanoidSpaceEntity& entity = setup.space.GetEntity(e);
      const bool is_hole = entity.GetKind() == EntityKind::kHole;
      if (!is_hole && entity.GetKind() != EntityKind::kGroundPatch) continue;
      // A rectangle (x, y, 0), or a disc (radius, 0, 0).
      const Vector3& size = entity.GetSize();
      Patch patch{e, is_hole, size.y() == 0, is_hole ? 0 : entity.SlotOf("colour"), size.x() / 2, size.y() / 2, 0};
      if (patch.is_disc) patch.half_x = size.x();
      patch.radius = __builtin_sqrt(patch.half_x * patch.half_x + patch.half_y * patch.half_y);
      patches_.push_back(patch);
    }
    for (std::size_t i = 0; i < kSensors; ++i)
    {
      const SinCos angle = SinCosOf(static_cast<double>(i) * (2 * kPi / kSensors));
      points_[i] = {kRingRadius * angle.cos, kRingRadius * angle.sin};
    }
    MakeDevices();
  }

  void Update(const ChannelView&) override
  {
    for (std::size_t k = 0; k < robots_.size(); ++k) Sense(k);
  }

private:
  struct Patch
  {
    std::uint32_t entity;
    bool is_hole;
    bool is_disc;
    std::uint32_t colour_slot;
    double half_x, half_y;  // m; discs: radius in half_x
    double radius;          // m, of the circle around it

    bool Contains(double x, double y) const
    {
      if (is_disc) return x * x + y * y <= half_x * half_x;
      return __builtin_fabs(x) <= half_x && __builtin_fabs(y) <= half_y;
    }
  };

  void Sense(std::size_t k)
  {
    const Pose pose = space_->GetPose(robots_[k]);
    double* values = ValuesOf(k);
    std::fill_n(values, kSensors, Brightness(floor_colour_));
    values[kColourValue] = floor_colour_;
    if (!world_->Terrain().IsEmpty() && !IsOnPlane(robots_[k])) SenseTerrain(robots_[k], pose, values);
    for (const Patch& patch : patches_)
    {
      const Pose place = space_->GetPose(patch.entity);
      const double reach = patch.radius + kRingRadius;
      const Vector3 offset = pose.position - place.position;
      if (offset.x() * offset.x() + offset.y() * offset.y() > reach * reach) continue;
      if (__builtin_fabs(offset.z()) > kNearFloor) continue;
      const std::uint32_t colour =
          patch.is_hole ? 0 : static_cast<std::uint32_t>(space_->Attributes()[patch.colour_slot]);
      const Pose relative = place.Inverse().Compose(pose);
      for (std::size_t i = 0; i < kSensors; ++i)
      {
        const Vector3 point = relative.Apply({points_[i].x(), points_[i].y(), 0});
        if (patch.Contains(point.x(), point.y())) values[i] = Brightness(colour);
      }
      if (patch.Contains(relative.position.x(), relative.position.y())) values[kColourValue] = colour;
    }
    if (!ground_noise_.IsActive()) return;
    RandomStream random = streams_.Of(k);
    for (std::size_t i = 0; i < kSensors; ++i)
      values[i] = std::clamp(values[i] + ground_noise_.Sample(random), 0.0, 1.0);
  }

  // Where a terrain of the robot's world has no ground near it, and the floor z = 0 is not near either, there is a
  // hole. The engines of planes have ground everywhere.
  void SenseTerrain(std::uint32_t robot, const Pose& pose, double* values) const
  {
    const auto counts = [&](std::uint32_t terrain) { return world_->CanHideFrom(robot, terrain); };
    const auto is_hole = [&](const Vector2& local)
    {
      const Vector3 point = pose.Apply({local.x(), local.y(), kNearFloor});
      const std::optional<double> depth = world_->Terrain().DepthOfGround(point, counts);
      return __builtin_fabs(point.z() - kNearFloor) > kNearFloor && !(depth && *depth <= 2 * kNearFloor);
    };
    for (std::size_t i = 0; i < kSensors; ++i)
      if (is_hole(points_[i])) values[i] = 0;
    if (is_hole({0, 0})) values[kColourValue] = 0;
  }

  bool IsOnPlane(std::uint32_t robot) const
  {
    const auto& engines = space_->GetExperiment().engines;
    const auto holds = [robot](const EngineConfiguration& engine)
    {
      const bool is_plane = engine.tag == "dummy_engine" || engine.tag == "kinematics2d" || engine.tag == "dynamics2d";
      return is_plane && std::binary_search(engine.entities.begin(), engine.entities.end(), robot);
    };
    return std::any_of(engines.begin(), engines.end(), holds);
  }

  std::shared_ptr<SensorWorld> world_;
  std::uint32_t floor_colour_ = 0;
  NoiseModel ground_noise_;
  std::vector<Patch> patches_;
  std::array<Vector2, kSensors> points_;
};

}  // namespace

void RegisterFootbotGround()
{
  AddSensorPlugin<GroundSensor>({.label = "footbot_ground",
                                 .implementation = "generic_footbot_ground",
                                 .brief = "brightness and colour of the floor: finds the nest",
                                 .parameters = GroundSensor::ParameterTable(),
                                 .robots = {"footbot"}});
}

}  // namespace swarmanoid
