// Controllers for the benchmark's scenes. Footbots drive on and turn away from bodies in front, or towards the side on
// which their cameras see most robots; eyebots fly circles. All send messages and light their LEDs.
#include <array>
#include <cmath>

#include "ci_colour_blob_sensor.h"
#include "ci_controller.h"
#include "ci_floor_field.h"
#include "ci_proximity_sensor.h"
#include "ci_radio.h"
#include "ci_range_and_bearing.h"
#include "ci_wheels_actuator.h"
#include "common/math/elementary.h"
#include "eyebot/ci_eyebot_propellers_actuator.h"
#include "footbot/ci_footbot_ground_sensor.h"
#include "footbot/ci_footbot_leds_actuator.h"
#include "footbot/ci_footbot_light_sensor.h"
#include "footbot/ci_footbot_proximity_sensor.h"
#include "footbot/ci_footbot_wheels_actuator.h"

using namespace swarmanoid;

class CBenchSwarm : public CCI_Controller
{
public:
  int Init(const TConfigurationTree tree) override
  {
    const CCI_Robot& robot = *GetRobot();
    rounds_ = static_cast<int>(tree.GetInteger("rounds"));
    if (tree.GetBoolean("steer_by_all"))
      for (const char* sensor : {"footbot_proximity", "footbot_light", "footbot_ground",
                                 "footbot_omnidirectional_camera", "footbot_distance_scanner", "range_and_bearing"})
        if (robot.HasSensor(sensor)) steered_by_.push_back(robot.GetSensor(sensor));
    if (tree.GetBoolean("read_all"))
    {
      if (robot.HasSensor("footbot_light")) light_ = &robot.Sensor<CCI_FootBotLightSensor>("footbot_light");
      if (robot.HasSensor("footbot_ground")) ground_ = &robot.Sensor<CCI_FootBotGroundSensor>("footbot_ground");
      if (robot.HasSensor("range_and_bearing")) heard_ = &robot.Sensor<CCI_RangeAndBearingSensor>("range_and_bearing");
      looks_always_ = true;
    }
    if (robot.HasActuator("footbot_wheels")) wheels_ = &robot.Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
    if (robot.HasActuator("eyebot_propellers"))
      propellers_ = &robot.Actuator<CCI_EyeBotPropellersActuator>("eyebot_propellers");
    if (robot.HasActuator("wheels")) any_wheels_ = &robot.Actuator<CCI_WheelsActuator>("wheels");
    if (robot.HasSensor("proximity")) any_proximity_ = &robot.Sensor<CCI_ProximitySensor>("proximity");
    if (robot.HasActuator("radio")) radio_ = &robot.Actuator<CCI_RadioActuator>("radio");
    if (robot.HasSensor("radio")) packets_ = &robot.Sensor<CCI_RadioSensor>("radio");
    if (robot.HasSensor("footbot_proximity"))
      proximity_ = &robot.Sensor<CCI_FootBotProximitySensor>("footbot_proximity");
    if (robot.HasSensor("footbot_omnidirectional_camera"))
      camera_ = &robot.Sensor<CCI_ColourBlobSensor>("footbot_omnidirectional_camera");
    if (robot.HasActuator("footbot_leds"))
      robot.Actuator<CCI_FootBotLedsActuator>("footbot_leds").SetAllColours(CCI_Colour::RED);
    if (robot.HasActuator("floor_field")) robot.Actuator<CCI_FloorFieldActuator>("floor_field").SetRate(1);
    if (robot.HasSensor("floor_field")) smell_ = &robot.Sensor<CCI_FloorFieldSensor>("floor_field");
    if (robot.HasActuator("range_and_bearing"))
      robot.Actuator<CCI_RangeAndBearingActuator>("range_and_bearing").SetMessage({1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
    return RETURN_OK;
  }

  void ControlStep() override
  {
    for (int k = 0; k < rounds_; ++k) thought_ = std::sqrt(thought_ + k);
    // Readings are made on demand.
    if (light_ != nullptr) read_ = light_->GetAllSensorReadings()[0];
    if (ground_ != nullptr) read_ = ground_->GetAllSensorReadings()[0];
    if (smell_ != nullptr) read_ = smell_->GetReadings()[0].value;
    if (heard_ != nullptr) read_ = static_cast<double>(heard_->GetAllPackets().size());
    if (camera_ != nullptr && looks_always_) read_ = static_cast<double>(camera_->GetAllBlobs().size());
    if (propellers_ != nullptr) propellers_->SetVelocity(0.1, 0, 0, 0.2);
    if (radio_ != nullptr) radio_->Send(std::array<std::uint8_t, 4>{1, 2, 3, 4});
    if (packets_ != nullptr) read_ = static_cast<double>(packets_->GetAllPackets().size());
    if (any_wheels_ != nullptr && any_proximity_ != nullptr) DriveByAnyProximity();
    if (wheels_ == nullptr) return;
    double turn = 0;
    if (proximity_ != nullptr)
    {
      const auto readings = proximity_->GetAllSensorReadings();
      for (unsigned i = 0; i < 4; ++i) turn -= readings[i] - readings[23 - i];
    }
    if (camera_ != nullptr && turn == 0)
      for (const CCI_ColourBlob& blob : camera_->GetAllBlobs()) turn += blob.angle_rad > 0 ? 0.1 : -0.1;
    wheels_->SetFootBotWheelsLinearVelocity(turn > 0 ? 0 : kSpeed, turn < 0 ? 0 : kSpeed);
    if (!steered_by_.empty()) SteerByAll();
  }
  bool HasState() const override { return true; }
  bool StepsInParallel() const override { return true; }

private:
  // Turns away from the side of the ring, left or right, that reads more.
  void DriveByAnyProximity()
  {
    const auto readings = any_proximity_->GetAllSensorReadings();
    double turn = 0;
    for (std::size_t i = 0; i < readings.size() / 2; ++i) turn -= readings[i] - readings[readings.size() - 1 - i];
    any_wheels_->SetLinearVelocity(turn > 0 ? 0 : kSpeed, turn < 0 ? 0 : kSpeed);
  }

  // So that every bit that any sensor reads changes the way of the robot.
  void SteerByAll()
  {
    readings_.clear();
    for (const CCI_Sensor* sensor : steered_by_) sensor->Describe(readings_);
    double sum = 0;
    for (std::size_t i = 0; i < readings_.size(); ++i) sum += static_cast<double>(i % 7 + 1) * readings_[i].value;
    wheels_->SetFootBotWheelsLinearVelocity(0.05 + 0.02 * Sin(sum), 0.05 + 0.02 * Cos(sum));
  }

  static constexpr double kSpeed = 0.05;  // m/s

  int rounds_ = 0;
  volatile double thought_ = 0;  // keeps the compiler from removing the computation
  volatile double read_ = 0;     // keeps the compiler from removing the reading
  bool looks_always_ = false;
  CCI_FootBotLightSensor* light_ = nullptr;
  CCI_FootBotGroundSensor* ground_ = nullptr;
  CCI_RangeAndBearingSensor* heard_ = nullptr;
  CCI_FloorFieldSensor* smell_ = nullptr;
  std::vector<CCI_Sensor*> steered_by_;
  std::vector<CCI_Reading> readings_;
  CCI_FootBotWheelsActuator* wheels_ = nullptr;
  CCI_EyeBotPropellersActuator* propellers_ = nullptr;
  CCI_FootBotProximitySensor* proximity_ = nullptr;
  CCI_ColourBlobSensor* camera_ = nullptr;
  CCI_WheelsActuator* any_wheels_ = nullptr;
  CCI_ProximitySensor* any_proximity_ = nullptr;
  CCI_RadioActuator* radio_ = nullptr;
  CCI_RadioSensor* packets_ = nullptr;
};

REGISTER_CONTROLLER(CBenchSwarm, {.label = "bench_swarm",
                                  .brief = "robots of the benchmark's scenes",
                                  .parameters = {{.name = "steer_by_all",
                                                  .type = ParameterType::kBoolean,
                                                  .default_value = "false",
                                                  .description = "Whether all that its sensors read steers it."},
                                                 {.name = "read_all",
                                                  .type = ParameterType::kBoolean,
                                                  .default_value = "true",
                                                  .description = "Whether each step reads all sensors, or only those "
                                                                 "that steer it: proximity, and the camera where "
                                                                 "nothing is near."},
                                                 {.name = "rounds",
                                                  .type = ParameterType::kInteger,
                                                  .default_value = "0",
                                                  .description = "Square roots that each step computes: its work.",
                                                  .minimum = 0,
                                                  .maximum = 1e9}}})
