// Distance scanners: the two short and two long beams of the footbot, on a head that turns at a given speed, and the
// ring of the eyebot. Rays against the bodies and the terrain of the robot's own engines. Generic.
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "common/control_interface/ci_distance_scanner_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turning_scanner_sensor.h"
#include "common/math/elementary.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/kind_of_batch.h"
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

// The values are those of footbot_distance_scanner_rotzonly_sensor.cpp of ARGoS3.
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

// The values are those of eyebot_distance_scanner_sensor.cpp of ARGoS 2.
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

Reading Measured(const SensorWorld& world, std::uint32_t robot, const Pose& pose, const Beam& beam, double height,
                 double angle)
{
  const SinCos direction = SinCosOf(angle);
  const auto at = [&](double distance) {
    return pose.Apply({distance * direction.cos, distance * direction.sin, height});
  };
  const auto is_there = [&](std::uint32_t body)
  { return body != robot && world.Membership().ShareEngine(robot, body); };
  const double part = world.FirstHit(at(beam.start), at(beam.start + beam.longest), is_there);
  if (part > 1) return {angle, beam.longest, Echo::kNothing};
  const double distance = part * beam.longest;
  if (distance <= beam.least && beam.least > 0) return {angle, 0, Echo::kTooNear};
  return {angle, distance, Echo::kMeasured};
}

void AddNoise(const NoiseModel& noise, DeviceStreams& streams, std::size_t k, std::vector<Reading>& readings,
              std::vector<double>& samples)
{
  if (!noise.IsActive()) return;
  samples.resize(readings.size());
  streams.Sample(noise, k, samples);
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (readings[i].echo == Echo::kMeasured)
      readings[i].distance_m = std::max(readings[i].distance_m + samples[i], 0.0);
}

struct DistanceScanner : public CCI_DistanceScannerSensor
{
  std::span<const Reading> GetAllReadings() const override { return readings; }
  std::vector<Reading> readings;
};

// The common part of the batches: each robot has a Scanner, which the derived class fills.
template <class Head, class Scanner>
class ScannerBatch : public SensorBatch
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
    scanners_.resize(robots_.size());
  }
  Scanner* Sensor(std::size_t k) override { return &scanners_[k]; }
  void Expose(std::size_t k, ExposedValues& values) override { values.SetList(scanners_[k].readings); }
  double Reach() const override
  {
    double reach = 0;
    for (const Beam& beam : beams_) reach = std::max(reach, beam.start + beam.longest + Head::kHeight);
    return reach;
  }
  void Update(const ChannelView&) override
  {
    world_->Refresh();
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      Scan(k, scanners_[k], space_->GetPose(robots_[k]));
      AddNoise(noise_, streams_, k, scanners_[k].readings, samples_);
    }
  }

protected:
  virtual void Scan(std::size_t k, Scanner& scanner, const Pose& pose) = 0;
  // Measures along a beam of the robot, after its head has turned by `turned` from the angle `head` (rad).
  Reading Measure(std::size_t k, const Pose& pose, const Beam& beam, double head, double turned) const
  {
    return Measured(*world_, robots_[k], pose, beam, Head::kHeight, WrapAngle(beam.angle + head + turned));
  }

  const CSwarmanoidSpace* space_ = nullptr;
  std::vector<Beam> beams_;
  std::shared_ptr<SensorWorld> world_;
  std::vector<Scanner> scanners_;

private:
  std::vector<std::uint32_t> robots_;
  NoiseModel noise_;
  DeviceStreams streams_;
  std::vector<double> samples_;
};

template <class Head>
class DistanceScannerSensor : public ScannerBatch<Head, DistanceScanner>, public SplitSensor
{
public:
  void Init(const DeviceSetup& setup) override
  {
    ScannerBatch<Head, DistanceScanner>::Init(setup);
    step_ = Head::Speed(setup.parameters) * setup.space.GetTickSeconds();
    count_ = this->beams_.size() * (step_ == 0 ? 1 : Head::kReadingsOfTick);
  }
  void RefreshShared(WorkerPool* pool) override { this->world_->Refresh(pool); }

private:
  // The head looks ahead at tick 0. The readings are those along its way since the last tick.
  void Scan(std::size_t k, DistanceScanner& scanner, const Pose& pose) override
  {
    std::vector<Reading>& readings = scanner.readings;
    readings.resize(count_);
    const std::size_t of_beam = count_ / this->beams_.size();
    const double head = step_ == 0 ? 0 : step_ * (static_cast<double>(this->space_->GetTick()) - 1);
    for (std::size_t i = 0; i < readings.size(); ++i)
    {
      const double part = static_cast<double>(i % of_beam) / static_cast<double>(of_beam);
      readings[i] = this->Measure(k, pose, this->beams_[i / of_beam], head, part * step_);
    }
  }

  double step_ = 0;        // rad in a tick
  std::size_t count_ = 0;  // readings of a tick
};

// The footbot's scanner with a head that the controller turns, as in ARGoS3.
class TurningScanner : public CCI_FootBotTurningScannerSensor
{
public:
  std::span<const Reading> GetAllReadings() const override { return readings; }
  void Turn(double speed_rad_s) override
  {
    Require(speed_rad_s);
    state = {Mode::kTurning, speed_rad_s, state.head};
  }
  void Look(double angle_rad) override
  {
    Require(angle_rad);
    state = {Mode::kStill, 0, WrapAngle(angle_rad)};
  }
  void SwitchOff() override { state.mode = Mode::kOff; }

  enum class Mode : std::uint8_t
  {
    kOff,
    kStill,
    kTurning
  };
  struct State
  {
    Mode mode = Mode::kOff;
    double speed = 0;  // rad/s
    double head = 0;   // rad
  };
  State state;
  std::vector<Reading> readings;

private:
  static void Require(double number)
  {
    if (!std::isfinite(number))
      throw std::invalid_argument("footbot_distance_scanner was told " + std::to_string(number) +
                                  ", which is no angle");
  }
};

class TurningScannerSensor : public ScannerBatch<FootbotHead, TurningScanner>
{
public:
  void SaveState(std::size_t k, ByteWriter& state) const override
  {
    state.Put(scanners_[k].state.mode);
    state.Put(scanners_[k].state.speed);
    state.Put(scanners_[k].state.head);
  }
  void LoadState(std::size_t k, ByteReader& state) override
  {
    scanners_[k].state.mode = state.Get<TurningScanner::Mode>();
    scanners_[k].state.speed = state.Get<double>();
    scanners_[k].state.head = state.Get<double>();
  }

private:
  void Scan(std::size_t k, TurningScanner& scanner, const Pose& pose) override
  {
    scanner.readings.clear();
    if (scanner.state.mode == TurningScanner::Mode::kOff) return;
    const bool turns = scanner.state.mode == TurningScanner::Mode::kTurning;
    const double way = turns ? scanner.state.speed * space_->GetTickSeconds() : 0;
    const std::size_t of_beam = turns ? FootbotHead::kReadingsOfTick : 1;
    for (const Beam& beam : beams_)
      for (std::size_t i = 0; i < of_beam; ++i)
      {
        const double part = static_cast<double>(i) / static_cast<double>(of_beam);
        scanner.readings.push_back(Measure(k, pose, beam, scanner.state.head, part * way));
      }
    scanner.state.head = WrapAngle(scanner.state.head + way);
  }
};

}  // namespace

const DeviceCode kDistanceScannersCode(
    []
    {
      BindSensor<DistanceScannerSensor<FootbotHead>>("footbot_distance_scanner", "generic_footbot_distance_scanner");
      BindSensor<TurningScannerSensor>("footbot_distance_scanner", "argos3_footbot_distance_scanner");
      BindSensor<DistanceScannerSensor<EyebotRing>>("eyebot_distance_scanner", "generic_eyebot_distance_scanner");
    });

}  // namespace swarmanoid
