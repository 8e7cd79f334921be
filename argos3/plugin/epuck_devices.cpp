// The e-puck of ARGoS3 has no wheel encoders: its sensor repeats the commanded speeds, and noise is put on the commands
// instead. The adapters here do the same, so that controllers that integrate the readings drift by the same amount.
// Speeds are in cm/s, distances are in cm for the last tick.
#include "argos3/plugin/device_parts.h"

#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_ground_sensor.h>

#include <algorithm>

#include "argos3/kinds/epuck_ground.h"
#include "argos3/plugin/device_noise.h"
#include "common/control_interface/ci_ground_sensor.h"
#include "common/control_interface/ci_positioning_sensor.h"
#include "common/control_interface/ci_wheels_actuator.h"

namespace swarmanoid::argos3
{
namespace
{

// Adds ARGoS3's noise. While at least one wheel turns, each turns at factor * (speed + bias). The bias is drawn once,
// the factor in each step.
class EPuckWheels : public ActuatorBridge, public argos::CCI_DifferentialSteeringActuator
{
public:
  explicit EPuckWheels(const DeviceSetup& setup)
      : robot_(setup.robot),
        wheels_(robot_.Actuator<CCI_WheelsActuator>("wheels")),
        told_(setup.told_wheels),
        left_(setup, "_left"),
        right_(setup, "_right")
  {
    TheRunning().wheels[robot_.GetId()] = told_.get();
  }
  ~EPuckWheels() override { TheRunning().wheels.erase(robot_.GetId()); }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void Reset() override { SetLinearVelocity(0, 0); }
  void SetLinearVelocity(Real left, Real right) override
  {
    wanted_ = {left, right};
    Turn(wanted_);
  }
  void Commit() override
  {
    if (wanted_.left == 0 && wanted_.right == 0) return;
    if (left_.IsActive() || right_.IsActive())
      Turn({left_.Disturbed(robot_.GetRandom(), wanted_.left), right_.Disturbed(robot_.GetRandom(), wanted_.right)});
  }

private:
  class Noise
  {
  public:
    Noise(const DeviceSetup& setup, const std::string& side)
        : factor_(setup.options.GetNumber("factor_avg" + side, 1)),
          factor_deviation_(setup.options.GetNumber("factor_stddev" + side, 0))
    {
      const double bias = setup.options.GetNumber("bias_avg" + side, 0);
      const double deviation = setup.options.GetNumber("bias_stddev" + side, 0);
      bias_ = kCentimetres * (deviation > 0 ? setup.robot.GetRandom().Gaussian(bias, deviation) : bias);
    }
    bool IsActive() const { return factor_ != 1 || factor_deviation_ > 0 || bias_ != 0; }
    // Returns a speed with noise, in cm/s.
    double Disturbed(RandomStream& random, double speed) const
    {
      return (factor_deviation_ > 0 ? random.Gaussian(factor_, factor_deviation_) : factor_) * (speed + bias_);
    }

  private:
    double factor_, factor_deviation_;
    double bias_ = 0;  // cm/s
  };

  void Turn(const WheelSpeeds& speeds)
  {
    wheels_.SetLinearVelocity(speeds.left / kCentimetres, speeds.right / kCentimetres);
    *told_ = speeds;
  }

  CCI_Robot& robot_;
  CCI_WheelsActuator& wheels_;
  const std::shared_ptr<WheelSpeeds> told_;
  const Noise left_, right_;
  WheelSpeeds wanted_;
};

// Gives the commanded wheel speeds, as ARGoS3 does; this robot has no encoders.
class EPuckEncoders : public SensorBridge, public argos::CCI_DifferentialSteeringSensor
{
public:
  explicit EPuckEncoders(const DeviceSetup& setup)
      : robot_(setup.robot), noise_(setup.options), tick_s_(setup.robot.GetTickSeconds()), told_(setup.told_wheels)
  {
    if (setup.robot.HasActuator("wheels"))
      m_sReading.WheelAxisLength =
          kCentimetres * setup.robot.Actuator<CCI_WheelsActuator>("wheels").GetInterwheelDistance();
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override
  {
    m_sReading.VelocityLeftWheel = told_->left;
    m_sReading.VelocityRightWheel = told_->right;
    m_sReading.CoveredDistanceLeftWheel = told_->left * tick_s_;
    m_sReading.CoveredDistanceRightWheel = told_->right * tick_s_;
    noise_.Add(robot_.GetRandom(), m_sReading);
  }

private:
  CCI_Robot& robot_;
  const WheelNoise noise_;
  const double tick_s_;
  const std::shared_ptr<const WheelSpeeds> told_;
};

class EPuckGround : public SensorBridge, public argos::CCI_GroundSensor
{
public:
  explicit EPuckGround(const DeviceSetup& setup)
      : robot_(setup.robot), translation_(setup.translation), noise_(setup.options.GetNumber("ground_noise", 0))
  {
    if (setup.options.GetText("floor", "") == "loop_functions")
      positioning_ = &robot_.Sensor<swarmanoid::CCI_PositioningSensor>("positioning");
    else
      ours_ = &robot_.Sensor<swarmanoid::CCI_GroundSensor>("ground");
    m_tReadings.resize(kEPuckGround.size());
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void BeforeStep() override
  {
    if (positioning_ != nullptr && noise_ > 0)
      Update();
    else
      OnDemand();
  }
  void Update() override
  {
    if (positioning_ == nullptr)
    {
      std::ranges::copy(ours_->GetAllSensorReadings(), m_tReadings.begin());
      return;
    }
    const PaintedFloor floor(translation_, *positioning_);
    for (std::size_t i = 0; i < kEPuckGround.size(); ++i)
    {
      const double noise = noise_ > 0 ? robot_.GetRandom().Uniform(-noise_, noise_) : 0;
      m_tReadings[i] = std::clamp(floor.GreyAt(kEPuckGround[i].x, kEPuckGround[i].y) + noise, 0.0, 1.0);
    }
  }

private:
  CCI_Robot& robot_;
  const Translation& translation_;
  const double noise_;
  const swarmanoid::CCI_PositioningSensor* positioning_ = nullptr;
  const swarmanoid::CCI_GroundSensor* ours_ = nullptr;
};

}  // namespace

std::unique_ptr<SensorBridge> MakeEPuckSensor(const std::string& tag, const DeviceSetup& setup)
{
  if (tag == "differential_steering") return std::make_unique<EPuckEncoders>(setup);
  if (tag == "ground") return std::make_unique<EPuckGround>(setup);
  return nullptr;
}

std::unique_ptr<ActuatorBridge> MakeEPuckActuator(const std::string& tag, const DeviceSetup& setup)
{
  if (tag == "differential_steering") return std::make_unique<EPuckWheels>(setup);
  return nullptr;
}

}  // namespace swarmanoid::argos3
