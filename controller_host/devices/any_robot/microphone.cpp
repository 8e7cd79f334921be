// Microphones: the pressure of each sound source falls with its distance (a free field without echoes). The three
// models are a directional array in the free field, an array with bodies that muffle sources behind them, and a single
// capsule. Generic.
#include <algorithm>
#include <memory>

#include "common/control_interface/ci_microphone_sensor.h"
#include "common/math/elementary.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/sensing/sensor_world.h"

namespace swarmanoid
{
namespace
{

constexpr double kNearest = 0.01;  // m: nearer sources are as loud as there

struct Microphone : public CCI_MicrophoneSensor
{
  double GetLoudness() const override { return loudness; }
  std::span<const Sound> GetAllSounds() const override { return sounds; }

  double loudness = 0;
  std::vector<Sound> sounds;
};

enum class MicrophoneModel
{
  kFreeField,
  kShadowed,
  kCapsule
};

template <MicrophoneModel kModel>
class MicrophoneSensor : public SensorBatch
{
public:
  void Init(const DeviceSetup& setup) override
  {
    space_ = &setup.space;
    robots_ = setup.robots;
    world_ = SensorWorld::Of(setup.space);
    height_ = setup.parameters.Number("height");
    threshold_ = setup.parameters.Number("threshold");
    loudness_noise_ = NoiseFrom(setup.parameters, "loudness_");
    loudness_streams_ = DeviceStreams(setup, "loudness");
    if constexpr (kModel != MicrophoneModel::kCapsule)
    {
      angle_noise_ = NoiseFrom(setup.parameters, "angle_");
      angle_streams_ = DeviceStreams(setup, "angle");
    }
    if constexpr (kModel == MicrophoneModel::kShadowed) shadow_ = setup.parameters.Number("shadow");
    for (std::uint32_t e = 0; e < setup.space.Size(); ++e)
      if (const CSwarmanoidSpaceEntity& entity = setup.space.GetEntity(e);
          DescriptionOf(entity.GetKind()).role == EntityRole::kSound)
        sources_.push_back({e, entity.SlotOf("intensity"), StreamName(entity.GetId())});
    microphones_.resize(robots_.size());
    for (Microphone& microphone : microphones_) microphone.sounds.reserve(sources_.size());
  }
  Microphone* Sensor(std::size_t k) override { return &microphones_[k]; }
  void Expose(std::size_t k, ExposedValues& values) override
  {
    values.Add(microphones_[k].loudness);
    if constexpr (kModel != MicrophoneModel::kCapsule) values.SetList(microphones_[k].sounds);
  }

  void Update(const ChannelView&) override
  {
    world_->Refresh();
    for (std::size_t k = 0; k < robots_.size(); ++k) Listen(k);
  }

private:
  struct Source
  {
    std::uint32_t entity;
    std::uint32_t intensity_slot;
    std::uint64_t name;
  };

  // Sounds of several sources are not coherent: the squares of their pressures add up.
  void Listen(std::size_t k)
  {
    Microphone& microphone = microphones_[k];
    microphone.sounds.clear();
    const Pose pose = space_->GetPose(robots_[k]);
    const Vector3 ear = pose.Apply({0, 0, height_});
    double power = 0;
    for (const Source& source : sources_)
    {
      if (!space_->IsPresent(source.entity)) continue;
      const Vector3 way = space_->GetPose(source.entity).position - ear;
      double loudness =
          space_->Attributes()[source.intensity_slot] / std::max(__builtin_sqrt(way.squaredNorm()), kNearest);
      if (loudness < threshold_) continue;
      if (kModel == MicrophoneModel::kShadowed && IsHidden(robots_[k], ear, ear + way)) loudness *= shadow_;
      if (loudness < threshold_) continue;
      if (loudness_noise_.IsActive())
        loudness = std::max(loudness + loudness_noise_.Sample(loudness_streams_.Of(k, source.name)), 0.0);
      power += loudness * loudness;
      if (kModel != MicrophoneModel::kCapsule) microphone.sounds.push_back(Located(k, source, pose, way, loudness));
    }
    microphone.loudness = __builtin_sqrt(power);
  }

  CCI_MicrophoneSensor::Sound Located(std::size_t k, const Source& source, const Pose& pose, const Vector3& way,
                                      double loudness) const
  {
    const Vector3 local = pose.orientation.conjugate() * way;
    CCI_MicrophoneSensor::Sound sound{loudness, Atan2(local.y(), local.x()),
                                      Atan2(local.z(), __builtin_sqrt(local.x() * local.x() + local.y() * local.y()))};
    if (!angle_noise_.IsActive()) return sound;
    RandomStream random = angle_streams_.Of(k, source.name);
    sound.bearing_rad = WrapAngle(sound.bearing_rad + angle_noise_.Sample(random));
    sound.elevation_rad = std::clamp(sound.elevation_rad + angle_noise_.Sample(random), -kPi / 2, kPi / 2);
    return sound;
  }

  bool IsHidden(std::uint32_t robot, const Vector3& from, const Vector3& to) const
  {
    const auto hides = [&](std::uint32_t body) { return body != robot && world_->CanHideFrom(robot, body); };
    return world_->FirstHit(from, to, hides) <= 1;
  }

  const CSwarmanoidSpace* space_ = nullptr;
  std::vector<std::uint32_t> robots_;
  std::shared_ptr<SensorWorld> world_;
  double height_ = 0, threshold_ = 0, shadow_ = 1;
  NoiseModel loudness_noise_, angle_noise_;
  DeviceStreams loudness_streams_, angle_streams_;
  std::vector<Source> sources_;
  std::vector<Microphone> microphones_;
};

}  // namespace

const DeviceCode kMicrophonesCode(
    []
    {
      BindSensor<MicrophoneSensor<MicrophoneModel::kFreeField>>("microphone", "generic_microphone");
      BindSensor<MicrophoneSensor<MicrophoneModel::kShadowed>>("microphone", "shadowed_microphone");
      BindSensor<MicrophoneSensor<MicrophoneModel::kCapsule>>("microphone", "capsule_microphone");
    });

}  // namespace swarmanoid
