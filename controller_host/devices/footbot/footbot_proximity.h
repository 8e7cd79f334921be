// The 24 infrared proximity sensors of footbots, all robots of a batch at once: a grid finds the bodies in range, 24
// rays per robot against their exact outlines give distances, a response curve gives readings. Generic.
#pragma once

#include <memory>
#include <vector>

#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "controller_host/device.h"
#include "controller_host/devices/device_streams.h"
#include "controller_host/devices/footbot/footbot_proximity_rays.h"
#include "controller_host/devices/noise.h"
#include "controller_host/devices/sensing/sensor_world.h"
#include "controller_host/devices/value_devices.h"
#include "controller_host/on_demand_sensor.h"

namespace swarmanoid
{

// Distances, and all but the response curve. Derived classes turn distances into readings.
class FootbotProximity : public SensorBatch, public OnDemandSensor
{
public:
  void Init(const DeviceSetup& setup) override;
  CCI_FootBotProximitySensor* Sensor(std::size_t k) override { return &sensors_[k]; }
  void Update(const ChannelView&) override
  {
    Forget();
    MakeAhead();
  }
  void RefreshShared(WorkerPool* pool) override;
  double Reach() const override { return rays_.Reach() + kHeight; }
  void Expose(std::size_t k, ExposedValues& values) override;

protected:
  // Computes readings from distances in m (beyond the range if the ray meets nothing), before noise and the limits
  // 0..1.
  virtual void Respond(const double* distances, double* readings) const = 0;

  double Range() const { return rays_.Range(); }  // m

private:
  static constexpr double kHeight = FootbotProximityRays::kHeight;
  // The shared readings of robots that sense nothing.
  static constexpr FootbotProximityRays::Values kNoReadings{};

  class Readings : public ReadingsOnDemand<CCI_FootBotProximitySensor, FootbotProximityRays::kRays>
  {
  public:
    Readings(OnDemandSensor& batch, std::size_t k) : ReadingsOnDemand(kNoReadings.values, batch, k) {}
    void Show(const double* values) { values_ = values; }
    const double* Shown() const { return values_; }
  };

  void MakeDue() override;
  // Ends all readings: no robot senses anything.
  void Forget();
  // Returns ReusedMemory for the readings of a robot until Forget. The readings of other robots stay where they are.
  double* NewReadings(std::size_t k);
  // These functions need upright bodies without moving parts. FindNear finds the neighbours of each robot, valid while
  // MovedSince holds. SenseNear computes the readings from them.
  bool KnowsNear() const;
  void FindNear();
  void SenseNear();
  // Computes the readings by a search around each robot, if the neighbours are not known.
  void SenseAll();
  // Lists all robots of the batch, or only those with readings due, in the order of the grid.
  void ListOwn(bool all);
  // Fetches what Sense will read of robots that come later in that order.
  void Prefetch(std::size_t later) const;
  // Sense computes the readings of the robot at this position of the list. SenseUpright searches around several robots
  // at once and needs upright bodies.
  void Sense(std::size_t listed);
  void SenseUpright(std::size_t first, std::size_t last);
  // Adds a body near a robot whose sensors are at this height.
  void LookAt(std::uint32_t robot, const Vector3& sensors, bool upright, std::uint32_t body, const BodyShape& shape,
              const Vector3& at, bool body_upright);
  void FinishReadings(std::size_t k);
  double* ReadingsAt(std::size_t place) { return blocks_[place / kBlock][place % kBlock].values; }
  // Returns whether a body that never moves is an upright box out of reach of a robot until neighbours are searched
  // for again.
  bool StaysBeyond(std::uint32_t robot, std::uint32_t body) const;
  // Adds noise to the readings of robots that have none yet.
  void Disturb();
  void AddAny(std::uint32_t robot, const Shape& shape, const Pose& other);
  template <class HitOf>
  void AddRays(std::uint32_t robot, const Vector3& centre, double radius, const HitOf& hit_of);
  void AddParts(std::uint32_t robot, std::uint32_t body);
  void AddTerrain(std::uint32_t robot);

  std::shared_ptr<SensorWorld> world_;
  std::vector<std::uint32_t> robots_;
  bool in_one_run_ = false;                    // robot k is entity robots_[0] + k
  std::vector<std::int32_t> place_of_entity_;  // k of an entity, or -1; only if they are not
  std::size_t listed_ = 0;
  std::vector<std::uint32_t> number_;  // k of each that is listed
  std::vector<std::int32_t> place_;    // and its place in the grid; both have kLanes more
  std::unique_ptr<FixedBodies> fixed_;
  // A robot and its neighbours in near_. From `fixed` on they are bodies that never move.
  struct Surroundings
  {
    std::uint32_t k, first, count, fixed;
  };
  bool remembers_ = false;
  std::uint64_t near_since_ = 0;  // MovedSince::Number
  // The entries ascend by robot. Robots without neighbours are left out if nothing else can be sensed.
  std::vector<Surroundings> surroundings_;
  std::vector<std::uint32_t> near_;              // entities
  std::unique_ptr<FixedBodies> fixed_for_long_;  // bodies that may come near while MovedSince holds
  NoiseModel noise_;
  DeviceStreams streams_;
  FootbotProximityRays rays_;  // of the robot being sensed
  // Readings that are not all 0, in the order of their computation. That is the order of the grid, so neighbours are
  // close in memory.
  static constexpr std::size_t kBlock = 256;
  std::vector<std::unique_ptr<FootbotProximityRays::Values[]>>
      blocks_;                         // of kBlock each; room for all from the start, as others read meanwhile
  std::vector<std::uint32_t> seeing_;  // k of the robots that have readings
  std::size_t disturbed_ = 0;          // how many of them have noise
  std::vector<std::uint8_t> saw_;      // whether robot k had readings before
  std::vector<Readings> sensors_;
};

// The reading is y = 1 below a contact distance, else a / (d + b). ARGoS3 fitted this curve to the robot.
class RayCastProximity : public FootbotProximity
{
protected:
  void Respond(const double* distances, double* readings) const override;
};

// The reading is y = c0 + c1 d + c2 d^2 + ..., with coefficients from the experiment file.
class PolynomialProximity : public FootbotProximity
{
public:
  void Init(const DeviceSetup& setup) override;

protected:
  void Respond(const double* distances, double* readings) const override;

private:
  std::vector<double> coefficients_;
};

}  // namespace swarmanoid
