// Loop functions, and a controller that they look into. Robots drive straight on. Half of the floor is grey, and a
// robot that is there long enough is moved back. The output file has one line for each tick.
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/core/utility/configuration/argos_configuration.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_motor_ground_sensor.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_positioning_sensor.h>
#include <argos3/plugins/simulator/entities/box_entity.h>

using namespace argos;

class CRunner : public CCI_Controller
{
public:
  void Init(TConfigurationNode&) override
  {
    wheels_ = GetActuator<CCI_DifferentialSteeringActuator>("differential_steering");
    ground_ = GetSensor<CCI_FootBotMotorGroundSensor>("footbot_motor_ground");
    place_ = GetSensor<CCI_PositioningSensor>("positioning");
  }
  void ControlStep() override
  {
    ++steps_;
    wheels_->SetLinearVelocity(10, 10);
    on_grey_ = 0;
    for (const auto& reading : ground_->GetReadings())
      if (std::abs(reading.Value - CColor::GRAY50.GetRed() / 255.0) < 1e-6) ++on_grey_;
    seen_ = place_->GetReading().Position;
  }
  int Steps() const { return steps_; }
  int OnGrey() const { return on_grey_; }
  const CVector3& Seen() const { return seen_; }

private:
  CCI_DifferentialSteeringActuator* wheels_ = nullptr;
  CCI_FootBotMotorGroundSensor* ground_ = nullptr;
  CCI_PositioningSensor* place_ = nullptr;
  int steps_ = 0;
  int on_grey_ = 0;
  CVector3 seen_;
};

class CCollector : public CLoopFunctions
{
public:
  void Init(TConfigurationNode& node) override
  {
    std::string file;
    GetNodeAttribute(GetNode(node, "output"), "file", file);
    GetNodeAttribute(GetNode(node, "home"), "x", home_);
    file_.open(file);
    file_ << "# clock\tphase\tid\tsteps\tgrey\tx\tseen\tagree\n";
    Write("init");
    CBoxEntity& box = *any_cast<CBoxEntity*>(GetSpace().GetEntitiesByType("box")["crate"]);
    file_ << "# crate " << box.GetEmbodiedEntity().GetOriginAnchor().Position << " " << box.GetSize() << "\n";
  }
  void PreStep() override
  {
    Write("pre");
    for (auto& [id, any] : GetSpace().GetEntitiesByType("foot-bot"))
    {
      CEmbodiedEntity& body = any_cast<CFootBotEntity*>(any)->GetEmbodiedEntity();
      CVector3 at = body.GetOriginAnchor().Position;
      if (at.GetX() < home_ + 0.6) continue;
      at.SetX(home_);
      if (MoveEntity(body, at, body.GetOriginAnchor().Orientation)) ++moved_;
    }
  }
  void PostStep() override { Write("post"); }
  bool IsExperimentFinished() override { return moved_ == 4; }
  void PostExperiment() override { file_ << "# moved " << moved_ << "\n"; }
  CColor GetFloorColor(const CVector2& place) override
  {
    return place.GetX() > home_ + 0.3 ? CColor::GRAY50 : CColor::WHITE;
  }

private:
  void Write(const char* phase)
  {
    for (auto& [id, any] : GetSpace().GetEntitiesByType("foot-bot"))
    {
      CFootBotEntity& robot = *any_cast<CFootBotEntity*>(any);
      auto& runner = dynamic_cast<CRunner&>(robot.GetControllableEntity().GetController());
      const CVector3& at = robot.GetEmbodiedEntity().GetOriginAnchor().Position;
      file_ << GetSpace().GetSimulationClock() << '\t' << phase << '\t' << id << '\t' << runner.Steps() << '\t'
            << runner.OnGrey() << '\t' << at.GetX() << '\t' << runner.Seen().GetX() << '\t' << (runner.Seen() == at)
            << '\n';
    }
  }

  std::ofstream file_;
  Real home_ = 0;
  int moved_ = 0;
};

// Takes a robot out and puts it back elsewhere.
class CKeeper : public CLoopFunctions
{
public:
  void Init(TConfigurationNode&) override { file_.open("kept.tsv"); }
  void PreStep() override
  {
    const UInt32 clock = GetSpace().GetSimulationClock();
    CSpace::TMapPerType& robots = GetSpace().GetEntitiesByType("foot-bot");
    file_ << clock << '\t' << robots.size();
    if (robots.count("fb5") != 0)
      file_ << '\t' << any_cast<CFootBotEntity*>(robots["fb5"])->GetEmbodiedEntity().GetOriginAnchor().Position.GetY();
    file_ << '\n';
    if (clock == 3) RemoveEntity("fb5");
    if (clock == 6)
    {
      auto* robot = new CFootBotEntity("fb5", "r", CVector3(-0.5, 1.2, 0));
      AddEntity(*robot);
      if (robot->GetId() != "fb5") THROW_ARGOSEXCEPTION("the robot that was added is gone");
    }
    if (clock == 10) GetSimulator().Terminate();
  }

private:
  std::ofstream file_;
};

REGISTER_LOOP_FUNCTIONS(CKeeper, "keeper")
REGISTER_CONTROLLER(CRunner, "runner")
REGISTER_LOOP_FUNCTIONS(CCollector, "collector")
