// A controller that draws in each of its steps and appends the numbers to a file of its robot: step, tick, numbers. It
// drives by them, and by what its proximity sensors see.
#include <cstdio>
#include <memory>
#include <string>

#include "ci_controller.h"
#include "footbot/ci_footbot_proximity_sensor.h"
#include "footbot/ci_footbot_wheels_actuator.h"

class COutsideRandom : public CCI_Controller
{
public:
  int Init(const TConfigurationTree tree) override
  {
    folder_ = tree.GetText("folder");
    proximity_ = &GetRobot()->Sensor<CCI_FootBotProximitySensor>("footbot_proximity");
    wheels_ = &GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
    Draw("Init");
    return RETURN_OK;
  }
  void ControlStep() override
  {
    const double drawn = Draw("ControlStep");
    const double seen = proximity_->GetProximitySensorReading(0);
    wheels_->SetFootBotWheelsAngularVelocity(5 * drawn, 5 * seen);
  }
  void Destroy() override { Draw("Destroy"); }
  bool HasState() const override { return true; }

private:
  double Draw(const char* step)
  {
    auto& random = GetRobot()->GetRandom();
    const double first = random.Uniform();
    const double second = GetRobot()->GetRandom().Uniform();
    const std::string path = folder_ + "/" + GetRobot()->GetId() + ".txt";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "a"), &std::fclose);
    std::fprintf(file.get(), "%s %llu %a %a\n", step, static_cast<unsigned long long>(GetRobot()->GetTick()), first,
                 second);
    return first;
  }

  CCI_FootBotProximitySensor* proximity_ = nullptr;
  CCI_FootBotWheelsActuator* wheels_ = nullptr;
  std::string folder_;
};

REGISTER_CONTROLLER(COutsideRandom, "outside_random")
