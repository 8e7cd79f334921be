// The devices of e-pucks and of the robots of plug-ins. They have no wheel encoders in ARGoS3: the sensor repeats the
// commanded speeds, and noise is put on the commands instead. The adapters here do the same, so that controllers that
// integrate the readings drift by the same amount. Speeds are in cm/s, distances are in cm for the last tick. The
// numbers and places of sensors are those of the robot's kind.
#include "argos3/plugin/device_parts.h"

#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_ground_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_ground_sensor.h>

#include <algorithm>

#include "argos3/plugin/device_noise.h"
#include "common/control_interface/ci_ground_sensor.h"
#include "common/control_interface/ci_positioning_sensor.h"
#include "common/control_interface/ci_wheels_actuator.h"
#include "common/experiment/entity_kind.h"

namespace swarmanoid::argos3
{
namespace
{

// Adds ARGoS3's noise. While at least one wheel turns, each turns at factor * (speed + bias). The bias is drawn once,
// the factor in each step.
class GenericWheels : public ActuatorBridge, public argos::CCI_DifferentialSteeringActuator
{
public:
  explicit GenericWheels(const DeviceSetup& setup)
      : robot_(setup.robot),
        wheels_(robot_.Actuator<CCI_WheelsActuator>("wheels")),
        told_(setup.told_wheels),
        left_(setup, "_left"),
        right_(setup, "_right")
  {
    TheRunning().wheels[robot_.GetId()] = told_.get();
  }
  ~GenericWheels() override { TheRunning().wheels.erase(robot_.GetId()); }
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
class CommandedSpeeds : public SensorBridge, public argos::CCI_DifferentialSteeringSensor
{
public:
  explicit CommandedSpeeds(const DeviceSetup& setup)
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

// Readings are numbers, or structs with an offset in m.
template <class Theirs>
class GenericGround : public SensorBridge, public Theirs
{
public:
  explicit GenericGround(const DeviceSetup& setup)
      : robot_(setup.robot),
        translation_(setup.translation),
        noise_(setup.options.GetNumber("ground_noise", 0)),
        points_(DescriptionOf(*KindOfTag(robot_.GetKind())).ground_points)
  {
    if (setup.options.GetText("floor", "") == "loop_functions")
      positioning_ = &robot_.Sensor<swarmanoid::CCI_PositioningSensor>("positioning");
    else
      ours_ = &robot_.Sensor<swarmanoid::CCI_GroundSensor>("ground");
    this->m_tReadings.resize(points_.size());
    if constexpr (kHasOffsets)
      for (std::size_t i = 0; i < points_.size(); ++i)
        this->m_tReadings[i].Offset = argos::CVector2(points_[i].x(), points_[i].y());
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override
  {
    if (positioning_ == nullptr)
    {
      const auto readings = ours_->GetAllSensorReadings();
      for (std::size_t i = 0; i < points_.size(); ++i) Set(i, readings[i]);
      return;
    }
    const PaintedFloor floor(translation_, *positioning_);
    for (std::size_t i = 0; i < points_.size(); ++i)
    {
      const double noise = noise_ > 0 ? robot_.GetRandom().Uniform(-noise_, noise_) : 0;
      Set(i, std::clamp(floor.GreyAt(points_[i].x(), points_[i].y()) + noise, 0.0, 1.0));
    }
  }

private:
  static constexpr bool kHasOffsets = !std::is_same_v<typename Theirs::TReadings, std::vector<Real>>;

  void Set(std::size_t i, double reading)
  {
    if constexpr (kHasOffsets)
      this->m_tReadings[i].Value = reading;
    else
      this->m_tReadings[i] = reading;
  }

  CCI_Robot& robot_;
  const Translation& translation_;
  const double noise_;
  const std::vector<Vector2>& points_;  // m, in the frame of the robot
  const swarmanoid::CCI_PositioningSensor* positioning_ = nullptr;
  const swarmanoid::CCI_GroundSensor* ours_ = nullptr;
};

}  // namespace

std::unique_ptr<SensorBridge> MakeGenericSensor(const std::string& tag, const DeviceSetup& setup)
{
  if (tag == "differential_steering") return std::make_unique<CommandedSpeeds>(setup);
  if (tag == "ground") return std::make_unique<GenericGround<argos::CCI_GroundSensor>>(setup);
  if (tag == "kheperaiv_ground") return std::make_unique<GenericGround<argos::CCI_KheperaIVGroundSensor>>(setup);
  if (auto sensor = MakeKheperaSensor(tag, setup)) return sensor;
  if (auto sensor = MakePiPuckSensor(tag, setup)) return sensor;
  return MakeKilobotSensor(tag, setup);
}

std::unique_ptr<ActuatorBridge> MakeGenericActuator(const std::string& tag, const DeviceSetup& setup)
{
  if (tag == "differential_steering") return std::make_unique<GenericWheels>(setup);
  if (auto actuator = MakeEPuckActuator(tag, setup)) return actuator;
  if (auto actuator = MakePiPuckActuator(tag, setup)) return actuator;
  return MakeKilobotActuator(tag, setup);
}

}  // namespace swarmanoid::argos3
