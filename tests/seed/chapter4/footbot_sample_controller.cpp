// The controller that the listing of <controllers> configures: it uses what is listed there, and drives straight on.
#include "ci_controller.h"
#include "ci_pie_camera_sensor.h"
#include "footbot/ci_footbot_gripper_actuator.h"
#include "footbot/ci_footbot_proximity_sensor.h"
#include "footbot/ci_footbot_wheels_actuator.h"

class CFootbotSampleController : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override
  {
    wheels_ = &GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
    GetRobot()->Actuator<CCI_FootBotGripperActuator>("footbot_gripper").SetGripper(0);
    GetRobot()->Sensor<CCI_FootBotProximitySensor>("footbot_proximity");
    GetRobot()->Sensor<CCI_PieCameraSensor>("pie_camera");
    speed_ = t_tree.GetNumber("wheels_speed");
    return t_tree.GetNumber("min_distance") == 7 ? RETURN_OK : RETURN_ERROR;
  }
  void ControlStep() override { wheels_->SetFootBotWheelsAngularVelocity(speed_, speed_); }

private:
  CCI_FootBotWheelsActuator* wheels_ = nullptr;
  double speed_ = 0;
};

REGISTER_CONTROLLER(CFootbotSampleController, "footbot_sample_controller")
