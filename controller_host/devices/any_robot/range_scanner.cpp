// Problem: hundreds of beams for each of many robots against all bodies in range.
//
// Method: not each beam looks for bodies, but each body for the beams that can meet it: those between two angles around
// its middle. Few beams of an upright scanner meet an upright body that is far away. Tilted scanners and bodies, moving
// parts and terrain are met beam by beam, as by other sensors.
//
// Invariants: the distance of a beam is the least over all bodies of one exact test, so neither the order of bodies nor
// tests of further bodies change a bit. Generic.
#include <algorithm>
#include <limits>
#include <memory>

#include "common/control_interface/ci_range_scanner_sensor.h"
#include "common/plugin_descriptions/range_scanner_beams.h"
#include "common/space/space.h"
#include "controller_host/devices/any_robot/beam_fan.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/sensing/sensor_world.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

class RangeScanner : public CCI_RangeScannerSensor
{
public:
  RangeScanner(const double* distances, const RangeScannerBeams& beams, OnDemandSensor& batch, std::size_t k)
      : distances_(distances), beams_(beams), batch_(batch), k_(k)
  {
  }
  unsigned GetBeams() const override { return static_cast<unsigned>(beams_.angles.size()); }
  unsigned GetLayers() const override { return static_cast<unsigned>(beams_.elevations.size()); }
  double GetAngle(unsigned beam) const override { return beams_.angles.at(beam) + beams_.pan; }
  double GetElevation(unsigned layer) const override { return beams_.elevations.at(layer); }
  double GetNearest() const override { return beams_.nearest_m; }
  double GetRange() const override { return beams_.range_m; }
  const Vector3& GetPosition() const override { return beams_.position; }
  std::span<const double> GetAllDistances() const override
  {
    batch_.Want(k_);
    return {distances_, beams_.angles.size() * beams_.elevations.size()};
  }

private:
  const double* distances_;
  const RangeScannerBeams& beams_;
  OnDemandSensor& batch_;
  std::size_t k_;
};

class RangeScannerSensor : public ValueSensor, public OnDemandSensor
{
public:
  void Init(const DeviceSetup& setup) override
  {
    beams_ = std::make_unique<RangeScannerBeams>(setup.parameters);
    Reset(setup, beams_->angles.size() * beams_->elevations.size());
    noise_ = NoiseFrom(setup.parameters);
    pan_ = SinCosOf(beams_->pan);
    fan_.Configure(*beams_);
    for (std::size_t layer = 0; layer < beams_->elevations.size(); ++layer)
      for (std::size_t beam = 0; beam < beams_->angles.size(); ++beam)
        directions_.push_back(beams_->DirectionOf(beam, layer));
    world_ = SensorWorld::Of(setup.space);
    fixed_ = std::make_unique<FixedBodies>(setup.space, world_->Bodies(), Reach());
    near_.reserve(setup.space.Size());
    discs_.reserve(setup.space.Size());
    for (std::vector<double>* values : {&x_, &y_, &angles_}) values->resize(setup.space.Size());
    InitDemand(robots_.size());
    scanners_.reserve(robots_.size());
    for (std::size_t k = 0; k < robots_.size(); ++k) scanners_.emplace_back(ValuesOf(k), *beams_, *this, k);
  }
  RangeScanner* Sensor(std::size_t k) override { return &scanners_[k]; }
  // A dead scanner sees nothing.
  void Expose(std::size_t k, ExposedValues& values) override
  {
    for (std::size_t i = 0; i < width_; ++i) values.Add(ValuesOf(k)[i], kNothing);
  }
  double Reach() const override { return beams_->position.norm() + beams_->range_m; }
  void RefreshShared(WorkerPool* pool) override { world_->Refresh(pool); }
  void Update(const ChannelView&) override { MakeAhead(); }

private:
  static constexpr double kNothing = std::numeric_limits<double>::infinity();

  void MakeDue() override
  {
    for (std::size_t k = 0; k < robots_.size(); ++k)
      if (IsDue(k)) Scan(k);
  }
  bool MakeAlone(std::size_t k) override
  {
    Scan(k);
    return true;
  }

  void Scan(std::size_t k)
  {
    const std::uint32_t robot = robots_[k];
    const Pose pose = space_->GetPose(robot);
    FindNear(robot, pose);
    // The height of the fan's beams is that of the space, if the robot is upright.
    const Vector3 eye = pose.Apply(beams_->position);
    fan_.Begin(eye.z(), ValuesOf(k));
    if (IsUpright(space_->Poses(), robot))
      ScanUpright(robot, eye);
    else
      MeetFloor(pose, eye, ValuesOf(k));
    if (!near_.empty() || !world_->Terrain().IsEmpty()) ScanEachBeam(robot, pose, eye, ValuesOf(k));
    fan_.End(beams_->nearest_m, beams_->range_m);
    AddNoise(k);
  }

  // Lists all bodies of the robot's engines in reach.
  void FindNear(std::uint32_t robot, const Pose& pose)
  {
    near_.clear();
    const auto add = [&](std::uint32_t body)
    {
      if (body != robot && world_->Membership().ShareEngine(robot, body)) near_.push_back(body);
    };
    world_->Grid().ForEachNear(pose.position.x(), pose.position.y(), Reach(), add);
    for (const std::uint32_t body : fixed_->Near(pose.position.x(), pose.position.y())) add(body);
  }

  // Measures all upright bodies, and leaves the others in near_.
  void ScanUpright(std::uint32_t robot, const Vector3& eye)
  {
    const PoseArrays& poses = space_->Poses();
    const Heading heading = HeadingOf(poses, robot);
    const double c = heading.cos * pan_.cos - heading.sin * pan_.sin;
    const double s = heading.sin * pan_.cos + heading.cos * pan_.sin;
    std::size_t left = 0, discs = 0;
    discs_.clear();
    for (const std::uint32_t body : near_)
    {
      const BodyShape& shape = world_->Body(body);
      if (!IsUpright(poses, body) || world_->IsArticulated(body))
      {
        near_[left++] = body;
        continue;
      }
      const Heading own = HeadingOf(poses, body);
      const double dx = poses.x[body] + own.cos * shape.centre.x() - own.sin * shape.centre.y() - eye.x();
      const double dy = poses.y[body] + own.sin * shape.centre.x() + own.cos * shape.centre.y() - eye.y();
      const double low = poses.z[body] + shape.low - eye.z();
      const double high = poses.z[body] + shape.high - eye.z();
      const double x = c * dx + s * dy;
      const double y = c * dy - s * dx;
      if (shape.kind == Shape::Kind::kBox)
      {
        fan_.Add(BeamFan::Box{x, y, c * own.cos + s * own.sin, c * own.sin - s * own.cos, shape.half_size.x(),
                              shape.half_size.y(), low, high});
        continue;
      }
      x_[discs] = x;
      y_[discs++] = y;
      discs_.push_back({x, y, 0, shape.radius, low, high});
    }
    near_.resize(left);
    Atan2Each({y_.data(), discs}, {x_.data(), discs}, {angles_.data(), discs});
    for (std::size_t i = 0; i < discs; ++i)
    {
      discs_[i].angle = angles_[i];
      fan_.Add(discs_[i]);
    }
  }

  // Sets the beams of a tilted robot to the distances of the floor.
  void MeetFloor(const Pose& pose, const Vector3& eye, double* distances) const
  {
    for (std::size_t i = 0; i < directions_.size(); ++i)
    {
      const double down = -(pose.orientation * directions_[i]).z();
      distances[i] = eye.z() > 0 && down > 0 ? eye.z() / down : kNothing;
    }
  }

  // Measures the bodies of near_ and the terrain.
  void ScanEachBeam(std::uint32_t robot, const Pose& pose, const Vector3& eye, double* distances) const
  {
    const auto is_there = [&](std::uint32_t terrain) { return world_->Membership().ShareEngine(robot, terrain); };
    for (std::size_t i = 0; i < directions_.size(); ++i)
    {
      const Vector3 to = eye + pose.orientation * (beams_->range_m * directions_[i]);
      double first = 2;
      for (const std::uint32_t body : near_)
        if (const auto hit = world_->HitOn(body, eye, to)) first = std::min(first, *hit);
      if (!world_->Terrain().IsEmpty()) first = std::min(first, world_->Terrain().FirstHit(eye, to, is_there));
      if (first <= 1) distances[i] = std::min(distances[i], first * beams_->range_m);
    }
  }

  // Adds noise to what is measured.
  void AddNoise(std::size_t k)
  {
    if (!noise_.IsActive()) return;
    samples_.resize(width_);
    streams_.Sample(noise_, k, samples_);
    double* const distances = ValuesOf(k);
    for (std::size_t i = 0; i < width_; ++i)
      if (distances[i] > 0) distances[i] = std::max(distances[i] + samples_[i], 0.0);
  }

  std::unique_ptr<RangeScannerBeams> beams_;
  SinCos pan_{0, 1};
  BeamFan fan_;
  std::vector<Vector3> directions_;  // of all beams, in the frame of the robot
  std::shared_ptr<SensorWorld> world_;
  std::unique_ptr<FixedBodies> fixed_;
  std::vector<RangeScanner> scanners_;
  // These belong to the robot being scanned.
  std::vector<std::uint32_t> near_;
  std::vector<BeamFan::Disc> discs_;
  std::vector<double> x_, y_, angles_;
  std::vector<double> samples_;
};

}  // namespace

const DeviceCode kRangeScannerCode([] { BindSensor<RangeScannerSensor>("range_scanner", "generic_range_scanner"); });

}  // namespace swarmanoid
