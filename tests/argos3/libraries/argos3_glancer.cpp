// A controller that reads its sensors in some steps only, and says what it reads. With keep="true" it keeps references
// from its Init.
#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/utility/logging/argos_log.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_proximity_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_colored_blob_omnidirectional_camera_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_leds_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_positioning_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_sensor.h>

using namespace argos;

class CGlancer : public CCI_Controller
{
public:
  void Init(TConfigurationNode& node) override
  {
    Real speed = 0;
    bool keeps = false;
    GetNodeAttributeOrDefault(node, "speed", speed, speed);
    GetNodeAttributeOrDefault(node, "every", every_, every_);
    GetNodeAttributeOrDefault(node, "enable_at", enable_at_, enable_at_);
    GetNodeAttributeOrDefault(node, "keep", keeps, keeps);
    GetActuator<CCI_DifferentialSteeringActuator>("differential_steering")->SetLinearVelocity(speed, speed);
    GetActuator<CCI_LEDsActuator>("leds")->SetAllColors(CColor::RED);
    proximity_ = GetSensor<CCI_FootBotProximitySensor>("footbot_proximity");
    camera_ = GetSensor<CCI_ColoredBlobOmnidirectionalCameraSensor>("colored_blob_omnidirectional_camera");
    radio_ = GetSensor<CCI_RangeAndBearingSensor>("range_and_bearing");
    place_ = GetSensor<CCI_PositioningSensor>("positioning");
    if (keeps) kept_ = &proximity_->GetReadings();
  }

  void ControlStep() override
  {
    ++step_;
    if (step_ == enable_at_) camera_->Enable();
    if (step_ % every_ != 0 && step_ != enable_at_) return;
    const auto& readings = kept_ != nullptr ? *kept_ : proximity_->GetReadings();
    Real sum = 0;
    for (const auto& reading : readings) sum += reading.Value;
    const auto& picture = camera_->GetReadings();
    const auto& packets = radio_->GetReadings();
    LOG << "step " << step_ << ": " << sum << " picture " << picture.Counter << " of " << picture.BlobList.size()
        << " radio " << packets.size() << " from " << (packets.empty() ? 0 : packets[0].Range) << " at "
        << place_->GetReading().Position << std::endl;
  }

private:
  CCI_FootBotProximitySensor* proximity_ = nullptr;
  CCI_ColoredBlobOmnidirectionalCameraSensor* camera_ = nullptr;
  CCI_RangeAndBearingSensor* radio_ = nullptr;
  CCI_PositioningSensor* place_ = nullptr;
  const CCI_FootBotProximitySensor::TReadings* kept_ = nullptr;
  UInt32 step_ = 0;
  UInt32 every_ = 1;
  UInt32 enable_at_ = 3;
};

REGISTER_CONTROLLER(CGlancer, "glancer")
