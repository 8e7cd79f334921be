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

protected:
  // From distances in m (more than the range: nothing there) to readings, before noise and the cut to 0..1.
  virtual void Respond(const double* distances, double* readings) const = 0;

  double Range() const { return rays_.Range(); }  // m

private:
  static constexpr double kHeight = FootbotProximityRays::kHeight;
  // Of robots that see nothing, with all others of them.
  static constexpr FootbotProximityRays::Values kNoReadings{};

  class Readings : public ReadingsOnDemand<CCI_FootBotProximitySensor, FootbotProximityRays::kRays>
  {
  public:
    Readings(OnDemandSensor& batch, std::size_t k) : ReadingsOnDemand(kNoReadings.values, batch, k) {}
    void Show(const double* values) { values_ = values; }
  };

  void MakeDue() override;
  // All see nothing: the readings before are over.
  void Forget();
  // ReusedMemory for the readings of a robot until Forget. What others have stays where it is.
  double* NewReadings(std::size_t k);
  // Where no body has parts that move by themselves, and all stand upright: finds out who is near whom, or will be as
  // long as MovedSince holds; and senses by what was found out.
  bool KnowsNear() const;
  void FindNear();
  void SenseNear();
  // Where that is not known: looks around each robot.
  void SenseAll();
  // Lists the robots of the batch, all or those that are due, in the order of the grid.
  void ListOwn(bool all);
  // Fetches what Sense will read of robots that come later in that order.
  void Prefetch(std::size_t later) const;
  // The robot that is listed there. SenseUpright: where nobody is tilted; what is near is looked for around several.
  void Sense(std::size_t listed);
  void SenseUpright(std::size_t first, std::size_t last);
  // Looks at a body near a robot whose sensors are at this height.
  void LookAt(std::uint32_t robot, const Vector3& sensors, bool upright, std::uint32_t body, const BodyShape& shape,
              const Vector3& at, bool body_upright);
  void FinishReadings(std::size_t k);
  double* ReadingsAt(std::size_t place) { return blocks_[place / kBlock][place % kBlock].values; }
  // Noise for those robots' readings that have none yet.
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
  // A robot, and those of near_ that are near it: from `fixed` on bodies that never move.
  struct Surroundings
  {
    std::uint32_t k, first, count, fixed;
  };
  bool remembers_ = false;
  std::uint64_t near_since_ = 0;            // MovedSince::Number
  std::vector<Surroundings> surroundings_;  // ascending; without those who have nobody near, if nothing else is seen
  std::vector<std::uint32_t> near_;         // entities
  std::unique_ptr<FixedBodies> fixed_for_long_;  // those that come near as long as MovedSince may hold
  NoiseModel noise_;
  DeviceStreams streams_;
  FootbotProximityRays rays_;  // of the robot being sensed
  // Those that are not all 0, in the order in which they were made: that of the grid, so that they come one after the
  // other in memory.
  static constexpr std::size_t kBlock = 256;
  std::vector<std::unique_ptr<FootbotProximityRays::Values[]>>
      blocks_;                         // of kBlock each; room for all from the start, as others read meanwhile
  std::vector<std::uint32_t> seeing_;  // k of those that have readings
  std::size_t disturbed_ = 0;          // how many of them have noise
  std::vector<std::uint8_t> saw_;      // whether robot k had readings before
  std::vector<Readings> sensors_;
};

// y = 1 below a contact distance, else a / (d + b): the curve that ARGoS3 fitted to the robot.
class RayCastProximity : public FootbotProximity
{
protected:
  void Respond(const double* distances, double* readings) const override;
};

// y = c0 + c1 d + c2 d^2 + ..., the coefficients given by the user.
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
