// The sensors that Khepera IVs alone have, with the responses of argos3-kheperaiv. Its ultrasound sensors are the beams
// of our ring of infrared sensors in five directions, which then looks further; the lidar is our range scanner.
#include "argos3/plugin/device_parts.h"

#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_lidar_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_light_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_proximity_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_ultrasound_sensor.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "argos3/converter/robot_rows.h"
#include "common/control_interface/ci_light_sensor.h"
#include "common/control_interface/ci_range_scanner_sensor.h"

namespace swarmanoid::argos3
{
namespace
{

// Returns the reading of an infrared sensor at a distance in m (kheperaiv_proximity_default_sensor.cpp).
double KheperaResponse(double distance)
{
  constexpr double kSaturated = 0.04, kFarthest = 0.12;
  if (distance < kSaturated) return 1;
  return distance > kFarthest ? 0 : 4.14 * std::exp(-33 * distance) - 0.085;
}

class KheperaUltrasound : public SensorBridge, public argos::CCI_KheperaIVUltrasoundSensor
{
public:
  explicit KheperaUltrasound(const DeviceSetup& setup)
      : robot_(setup.robot),
        ours_(robot_.Sensor<swarmanoid::CCI_ProximitySensor>("proximity")),
        noise_(setup.options.GetNumber("ultrasound_noise", 0))
  {
    for (const unsigned sensor : kSensors)
      m_tReadings.emplace_back(0, argos::CRadians(ours_.GetAngle(sensor)).SignedNormalize());
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override
  {
    const auto readings = ours_.GetAllSensorReadings();
    for (std::size_t i = 0; i < kSensors.size(); ++i)
    {
      const double reading = readings[kSensors[i]];
      const double noise = noise_ > 0 ? robot_.GetRandom().Uniform(-noise_, noise_) : 0;
      m_tReadings[i].Value =
          std::clamp((reading > 0 ? Response(kUltrasoundReach * (1 - reading)) : 0) + noise, 0.0, 1.0);
    }
  }

private:
  // The numbers of the infrared sensors with the same directions.
  static constexpr std::array<unsigned, 5> kSensors{0, 1, 2, 6, 7};

  // `distance`: from the ring, in m. ARGoS3 measures from the gap on, and normalises the range 0.25 m to 2 m.
  static double Response(double distance)
  {
    constexpr double kLeast = 0.25, kMost = 2;
    return std::clamp((distance - kUltrasoundGap - kLeast) / (kMost - kLeast), 0.0, 1.0);
  }

  CCI_Robot& robot_;
  const swarmanoid::CCI_ProximitySensor& ours_;
  const double noise_;
};

class KheperaLight : public SensorBridge, public argos::CCI_KheperaIVLightSensor
{
public:
  explicit KheperaLight(const DeviceSetup& setup) : ours_(setup.robot.Sensor<swarmanoid::CCI_LightSensor>("light"))
  {
    for (unsigned i = 0; i < ours_.GetAllSensorReadings().size(); ++i)
      m_tReadings.emplace_back(0, argos::CRadians(ours_.GetAngle(i)).SignedNormalize());
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override
  {
    const auto readings = ours_.GetAllSensorReadings();
    for (std::size_t i = 0; i < readings.size(); ++i) m_tReadings[i].Value = readings[i];
  }

private:
  const swarmanoid::CCI_LightSensor& ours_;
};

class KheperaLidar : public SensorBridge, public argos::CCI_KheperaIVLIDARSensor
{
public:
  explicit KheperaLidar(const DeviceSetup& setup)
      : robot_(setup.robot),
        ours_(robot_.Sensor<swarmanoid::CCI_RangeScannerSensor>("range_scanner")),
        noise_(setup.options.GetNumber("lidar_noise", 0)),
        readings_(ours_.GetBeams())
  {
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Reset() override { std::ranges::fill(readings_, 0); }
  void Update() override
  {
    if (!has_power_ || !has_laser_) return;
    const auto distances = ours_.GetAllDistances();
    for (std::size_t i = 0; i < readings_.size(); ++i)
    {
      const bool is_hit = distances[i] > 0 && std::isfinite(distances[i]);
      readings_[i] = is_hit ? static_cast<long>((distances[i] - kLidarStart) * kCentimetres) : 0;
      if (noise_ > 0)
        readings_[i] =
            static_cast<long>(static_cast<double>(readings_[i]) + robot_.GetRandom().Uniform(-noise_, noise_));
    }
  }
  long GetReading(UInt32 beam) const override
  {
    if (beam >= readings_.size())
      THROW_ARGOSEXCEPTION("there is no reading " << beam << " of the lidar; they are 0 to " << readings_.size() - 1);
    return readings_[beam];
  }
  size_t GetNumReadings() const override { return readings_.size(); }
  void PowerOn() override { has_power_ = true; }
  void PowerOff() override { has_power_ = false; }
  void LaserOn() override { has_laser_ = true; }
  void LaserOff() override { has_laser_ = false; }

private:
  CCI_Robot& robot_;
  const swarmanoid::CCI_RangeScannerSensor& ours_;
  const double noise_;  // cm
  std::vector<long> readings_;
  bool has_power_ = true, has_laser_ = true;
};

}  // namespace

std::unique_ptr<SensorBridge> MakeKheperaSensor(const std::string& tag, const DeviceSetup& setup)
{
  if (tag == "kheperaiv_proximity")
    return std::make_unique<Proximity<argos::CCI_KheperaIVProximitySensor>>(setup, KheperaResponse);
  if (tag == "kheperaiv_ultrasound") return std::make_unique<KheperaUltrasound>(setup);
  if (tag == "kheperaiv_light") return std::make_unique<KheperaLight>(setup);
  if (tag == "kheperaiv_lidar") return std::make_unique<KheperaLidar>(setup);
  return nullptr;
}

}  // namespace swarmanoid::argos3
