// A controller that computes its commands with <cmath> from all that it senses, its clock and its random numbers, and
// writes both to files of its robot, a line a step, in all their bits: what recorded_drivers.cpp gives to a robot.
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "ci_controller.h"
#include "footbot/ci_footbot_encoders_sensor.h"
#include "footbot/ci_footbot_leds_actuator.h"
#include "footbot/ci_footbot_omnidirectional_camera_sensor.h"
#include "footbot/ci_footbot_proximity_sensor.h"
#include "footbot/ci_footbot_wheels_actuator.h"

class COutsideSenses : public CCI_Controller
{
public:
  int Init(const TConfigurationTree tree) override
  {
    proximity_ = &GetRobot()->Sensor<CCI_FootBotProximitySensor>("footbot_proximity");
    encoders_ = &GetRobot()->Sensor<CCI_FootBotEncodersSensor>("footbot_encoders");
    camera_ = &GetRobot()->Sensor<CCI_FootBotOmnidirectionalCameraSensor>("footbot_omnidirectional_camera");
    wheels_ = &GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
    leds_ = &GetRobot()->Actuator<CCI_FootBotLedsActuator>("footbot_leds");
    record_ = tree.GetText("record") + "/" + GetRobot()->GetId();
    return RETURN_OK;
  }

  void ControlStep() override
  {
    double ahead = 0.1 * std::sin(GetRobot()->GetTime());
    double aside = GetRobot()->GetRandom().Uniform(-0.1, 0.1);
    for (unsigned i = 0; i < CCI_FootBotProximitySensor::NUM_SENSORS; ++i)
    {
      const double reading = proximity_->GetAllSensorReadings()[i];
      ahead += std::tanh(reading) * std::cos(CCI_FootBotProximitySensor::AngleOf(i));
      aside += std::pow(reading, 0.3) * std::sin(CCI_FootBotProximitySensor::AngleOf(i));
    }
    double seen = std::atan2(encoders_->GetLeftVelocity(), encoders_->GetRightVelocity());
    for (const CCI_ColourBlob& blob : camera_->GetAllBlobs())
      seen += std::exp(-blob.distance_m) * std::log1p(blob.colour) + std::tan(0.4 * blob.angle_rad);
    const double left = std::fmod(3 + std::hypot(ahead, seen), 5) - aside;
    const double right = std::cbrt(ahead) + std::erf(seen) + aside;
    const auto colour = static_cast<std::uint32_t>(std::fabs(std::sin(1e6 * left)) * 0xffffff);

    Record("footbot_proximity", proximity_->GetAllSensorReadings());
    Record("footbot_encoders", encoders_->GetAllSensorReadings());
    std::vector<double> blobs;
    for (const CCI_ColourBlob& blob : camera_->GetAllBlobs())
      blobs.insert(blobs.end(), {static_cast<double>(blob.colour), blob.distance_m, blob.angle_rad});
    Record("footbot_omnidirectional_camera", blobs);
    Record("footbot_wheels", std::vector{left, right});
    Record("footbot_leds", std::vector<double>(CCI_FootBotLedsActuator::NUM_LEDS, colour));
    wheels_->SetFootBotWheelsAngularVelocity(left, right);
    leds_->SetAllColours(colour);
  }

private:
  template <class Numbers>
  void Record(const char* device, const Numbers& numbers) const
  {
    const std::string path = record_ + "." + device + ".txt";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "a"), &std::fclose);
    if (!file) throw std::runtime_error("cannot write " + path);
    for (const double number : numbers) std::fprintf(file.get(), "%a ", number);
    std::fprintf(file.get(), "\n");
  }

  CCI_FootBotProximitySensor* proximity_ = nullptr;
  CCI_FootBotEncodersSensor* encoders_ = nullptr;
  CCI_FootBotOmnidirectionalCameraSensor* camera_ = nullptr;
  CCI_FootBotWheelsActuator* wheels_ = nullptr;
  CCI_FootBotLedsActuator* leds_ = nullptr;
  std::string record_;
};

REGISTER_CONTROLLER(COutsideSenses, "outside_senses")
