// Turns until the compass reads 90 degrees, then drives on.
#include "ci_controller.h"
#include "devices/compass/footbot_compass.h"
#include "footbot/ci_footbot_wheels_actuator.h"

class CNorthbound : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override
  {
    wheels_ = &GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
    compass_ = &GetRobot()->Sensor<CCI_FootBotCompassSensor>("footbot_compass");
    return RETURN_OK;
  }
  void ControlStep() override
  {
    const double left_to_turn = 1.5707963267948966 - compass_->GetHeading();
    wheels_->SetFootBotWheelsLinearVelocity(0.1 - 0.05 * left_to_turn, 0.1 + 0.05 * left_to_turn);
  }

private:
  CCI_FootBotWheelsActuator* wheels_ = nullptr;
  CCI_FootBotCompassSensor* compass_ = nullptr;
};

REGISTER_CONTROLLER(CNorthbound, "northbound", "drives along the y axis by its compass")
