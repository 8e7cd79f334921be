// Distance scanners: the two short and two long beams of the footbot, on a head that turns at a given speed, and the
// ring of the eyebot. Rays against the bodies and the terrain of the robot's own engines. Generic.
#include <algorithm>
#include <memory>

#include "common/control_interface/ci_distance_scanner_sensor.h"
#include "common/math/elementary.h"
#include "controller_host/devices/any_robot/kind_of_batch.h"
#include "controller_host/devices/builtin_devices.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/sensing/sensor_world.h"
#include "controller_host/split_sensor.h"

namespace swarmanoid
{
namespace
{

using Reading = CCI_DistanceScannerSensor::Reading;
using Echo = CCI_DistanceScannerSensor::Echo;

struct Beam
{
  double angle;  // rad, on the head
  double start;  // m from the axis of the robot
  double least;  // m from there: nearer is too near
  double longest;
};

// footbot_distance_scanner_rotzonly_sensor.cpp of ARGoS3.
struct FootbotHead
{
  static constexpr double kHeight = 0.123199866;
  static constexpr std::size_t kReadingsOfTick = 6;  // of each beam, while the head turns
  static std::vector<Beam> Beams(const EntityKindDescription& footbot)
  {
    const double radius = footbot.size.x();
    return {
        {0, radius, 0, 0.26}, {kPi, radius, 0, 0.26}, {kPi / 2, radius, 0.12, 1.42}, {-kPi / 2, radius, 0.12, 1.42}};
  }
  static double Speed(const Parameters& parameters) { return parameters.Number("rotation_speed"); }
};

// eyebot_distance_scanner_sensor.cpp of ARGoS 2.
struct EyebotRing
{
  static constexpr double kHeight = 0.1;
  static constexpr std::size_t kReadingsOfTick = 1;
  static std::vector<Beam> Beams(const EntityKindDescription&)
  {
    constexpr int kBeams = 32;
    std::vector<Beam> beams;
    for (int i = 0; i < kBeams; ++i) beams.push_back({2 * kPi / kBeams * i, 0, 0, 15});
    return beams;
  }
  static double Speed(const Parameters&) { return 0; }
};

struct DistanceScanner : public CCI_DistanceScannerSensor
{
  std::span<const Reading> GetAllReadings() const override { return readings; }
  std::vector<Reading> readings;
};

template <class Head>
class DistanceScannerSensor : public SensorBatch, public SplitSensor
{
public:
  void Init(const DeviceSetup& setup) override
  {
    space_ = &setup.space;
    robots_ = setup.robots;
    world_ = SensorWorld::Of(setup.space);
    noise_ = NoiseFrom(setup.parameters);
    streams_ = DeviceStreams(setup);
    beams_ = Head::Beams(KindOfBatch(setup));
    step_ = Head::Speed(setup.parameters) * setup.space.GetTickSeconds();
    scanners_.resize(robots_.size());
    const std::size_t count = beams_.size() * (step_ == 0 ? 1 : Head::kReadingsOfTick);
    for (DistanceScanner& scanner : scanners_) scanner.readings.resize(count);
  }
  CCI_Sensor* Sensor(std::size_t k) override { return &scanners_[k]; }

  void RefreshShared() override { world_->Refresh(); }
  void Update(const ChannelView&) override
  {
    world_->Refresh();
    for (std::size_t k = 0; k < robots_.size(); ++k) Scan(k);
  }

private:
  // The head starts ahead at tick 0; the readings are those of the way since the last tick.
  void Scan(std::size_t k)
  {
    std::vector<Reading>& readings = scanners_[k].readings;
    const Pose pose = space_->GetPose(robots_[k]);
    const std::size_t of_beam = readings.size() / beams_.size();
    const double head = step_ == 0 ? 0 : step_ * (static_cast<double>(space_->GetTick()) - 1);
    for (std::size_t i = 0; i < readings.size(); ++i)
    {
      const Beam& beam = beams_[i / of_beam];
      const double part = static_cast<double>(i % of_beam) / static_cast<double>(of_beam);
      readings[i] = Measured(robots_[k], pose, beam, WrapAngle(beam.angle + head + part * step_));
    }
    if (!noise_.IsActive()) return;
    samples_.resize(readings.size());
    streams_.Sample(noise_, k, samples_);
    for (std::size_t i = 0; i < readings.size(); ++i)
      if (readings[i].echo == Echo::kMeasured)
        readings[i].distance_m = std::max(readings[i].distance_m + samples_[i], 0.0);
  }

  Reading Measured(std::uint32_t robot, const Pose& pose, const Beam& beam, double angle) const
  {
    const SinCos direction = SinCosOf(angle);
    const auto at = [&](double distance) {
      return pose.Apply({distance * direction.cos, distance * direction.sin, Head::kHeight});
    };
    const auto is_there = [&](std::uint32_t body)
    { return body != robot && world_->Membership().ShareEngine(robot, body); };
    const double part = world_->FirstHit(at(beam.start), at(beam.start + beam.longest), is_there);
    if (part > 1) return {angle, beam.longest, Echo::kNothing};
    const double distance = part * beam.longest;
    if (distance <= beam.least && beam.least > 0) return {angle, 0, Echo::kTooNear};
    return {angle, distance, Echo::kMeasured};
  }

  const CSwarmanoidSpace* space_ = nullptr;
  std::vector<std::uint32_t> robots_;
  std::shared_ptr<SensorWorld> world_;
  NoiseModel noise_;
  DeviceStreams streams_;
  std::vector<Beam> beams_;
  double step_ = 0;  // rad in a tick
  std::vector<double> samples_;
  std::vector<DistanceScanner> scanners_;
};

}  // namespace

void RegisterDistanceScanners()
{
  BindSensor<DistanceScannerSensor<FootbotHead>>("footbot_distance_scanner", "generic_footbot_distance_scanner");
  BindSensor<DistanceScannerSensor<EyebotRing>>("eyebot_distance_scanner", "generic_eyebot_distance_scanner");
}

}  // namespace swarmanoid
