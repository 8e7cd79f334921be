// Loop functions that read entities: their parts, anchors, bounding boxes, and which robots hear each other.
#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_sensor.h>
#include <argos3/plugins/simulator/entities/box_entity.h>
#include <argos3/plugins/simulator/entities/light_entity.h>
#include <argos3/plugins/simulator/media/rab_medium.h>

using namespace argos;

// Reports the first bytes of the messages that it receives, in the order of the distances.
class CHearer : public CCI_Controller
{
public:
  void ControlStep() override
  {
    std::map<Real, int> heard;
    for (const auto& packet : GetSensor<CCI_RangeAndBearingSensor>("range_and_bearing")->GetReadings())
      heard[packet.Range] = packet.Data[0];
    heard_.clear();
    for (const auto& one : heard) heard_ += " " + std::to_string(one.second);
  }
  std::string heard_;
};

class CLooker : public CLoopFunctions
{
public:
  void Init(TConfigurationNode&) override
  {
    file_.open("looks.txt");
    auto& robot = Robot("a");
    SAnchor& mast = robot.GetEmbodiedEntity().AddAnchor("mast", CVector3(0.1, 0, 0.2));
    file_ << "anchor " << Rounded(mast.Position) << " " << robot.GetEmbodiedEntity().IsAnchorEnabled("mast") << "\n";
    robot.GetEmbodiedEntity().EnableAnchor("mast");
    file_ << "enabled " << robot.GetEmbodiedEntity().IsAnchorEnabled("mast") << "\n";
    Refused("anchor", [&] { robot.GetEmbodiedEntity().GetAnchor("mist"); });
    Box("a", robot.GetEmbodiedEntity());
    Box("turned", dynamic_cast<CBoxEntity&>(GetSpace().GetEntity("turned")).GetEmbodiedEntity());

    file_ << "parts " << robot.GetComponentVector().size() << " " << robot.HasComponent("leds.led[led_12]")
          << robot.HasComponent("leds.led[led_13]") << robot.HasComponent("body.none") << "\n";
    auto& led = robot.GetComponent<CLEDEntity>("leds.led[led_3]");
    file_ << "led " << led.GetId() << " " << led.GetParent().GetTypeDescription() << " " << led.GetContext() << "\n";
    Refused("part", [&] { robot.GetComponent("wings"); });
    CPhysicsModel& model = robot.GetEmbodiedEntity().GetPhysicsModel(0);
    file_ << "model " << model.GetEngine().GetId() << " "
          << (&model == &model.GetEmbodiedEntity().GetPhysicsModel("dyn2d")) << model.IsCollidingWithSomething()
          << "\n";
    Refused("model", [&] { robot.GetEmbodiedEntity().GetPhysicsModel(1); });
    auto& proximity = robot.GetProximitySensorEquippedEntity();
    auto& first = proximity.GetSensor(0);
    CVector3 end = first.Offset + first.Direction;
    end.Rotate(first.Anchor.Orientation);
    end += first.Anchor.Position;
    file_ << "sensor " << proximity.GetNumSensors() << " " << Rounded(first.Offset) << " " << Rounded(end) << "\n";
    auto& ground = robot.GetComponent<CGroundSensorEquippedEntity>("ground_sensors");
    file_ << "ground " << ground.GetSensors().size() << " " << ground.GetSensor(4).Offset << " "
          << ground.GetSensor(3).Type << ground.GetSensor(4).Type << "\n";
    auto& light = robot.GetLightSensorEquippedEntity();
    file_ << "light " << light.GetNumSensors() << " " << light.GetSensor(0).Direction.Length() << "\n";
    Refused("sensor", [&] { proximity.GetSensor(24); });
    const CLightEntity nowhere;
    file_ << "nowhere " << nowhere.GetIntensity() << "\n";
    Refused("parent", [&] { robot.GetParent(); });
    file_ << "order " << Robot("a").GetIndex() << " " << led.GetIndex() << " "
          << SEntityComparator()(&Robot("a"), &Robot("b")) << "\n";
    std::string word;
    GetNodeAttribute(GetNode(GetSimulator().GetConfigForController("h"), "params"), "word", word);
    file_ << "word " << word << "\n";
    Refused("controller", [&] { GetSimulator().GetConfigForController("x"); });
    const Real drawn = GetSimulator().GetRNG()->Uniform(CRange<Real>(0, 1));
    file_ << "drawn " << (drawn >= 0 && drawn < 1) << "\n";
    file_ << "engines " << GetSimulator().GetPhysicsEngines().size() << " "
          << GetSimulator().GetPhysicsEngine("dyn2d").GetId() << "\n";
  }
  void PreStep() override
  {
    const UInt32 clock = GetSpace().GetSimulationClock();
    auto& medium = GetSimulator().GetMedium<CRABMedium>("rab");
    if (clock == 2)
    {
      for (const char* id : {"a", "b", "hidden", "far"})
      {
        file_ << "hears " << id << ":";
        for (CRABEquippedEntity* other : medium.GetRABsCommunicatingWith(Robot(id).GetRABEquippedEntity()))
          file_ << " " << other->GetRootEntity().GetId();
        file_ << "\n";
      }
      const CSet<CRABEquippedEntity*> copied = medium.GetRABsCommunicatingWith(Robot("a").GetRABEquippedEntity());
      file_ << "copied " << copied.size() << " " << medium.GetId() << "\n";
      const auto& place = Robot("a").GetRABEquippedEntity();
      file_ << "antenna " << place.GetPosition() << " " << (&place.GetEntityBody() == &Robot("a").GetEmbodiedEntity())
            << "\n";
      // The value is written through the reference.
      CByteArray& data = Robot("b").GetRABEquippedEntity().GetData();
      data[0] = 76;
      file_ << "written " << Robot("b").GetRABEquippedEntity().GetData() << "\n";
      data[0] = 77;
    }
    if (clock == 3)
    {
      MoveEntity(Robot("a").GetEmbodiedEntity(), CVector3(0, -1, 0), CQuaternion());
      file_ << "moved " << Rounded(Robot("a").GetEmbodiedEntity().GetAnchor("mast").Position) << "\n";
    }
  }
  void PostStep() override
  {
    auto& controller = dynamic_cast<CHearer&>(Robot("a").GetControllableEntity().GetController());
    file_ << "heard " << GetSpace().GetSimulationClock() << ":" << controller.heard_ << "\n";
  }

private:
  CFootBotEntity& Robot(const std::string& id) { return dynamic_cast<CFootBotEntity&>(GetSpace().GetEntity(id)); }
  static CVector3 Rounded(const CVector3& vector)
  {
    const auto round = [](Real value) { return std::round(value * 1e4) / 1e4 + 0.0; };
    return {round(vector.GetX()), round(vector.GetY()), round(vector.GetZ())};
  }
  void Box(const char* name, const CEmbodiedEntity& body)
  {
    const SBoundingBox& box = body.GetBoundingBox();
    file_ << "box " << name << " " << Rounded(box.MinCorner) << " " << Rounded(box.MaxCorner) << "\n";
  }
  template <class Call>
  void Refused(const char* what, Call call)
  {
    try
    {
      call();
    }
    catch (const CARGoSException& error)
    {
      file_ << "refused " << what << ": " << error.what() << "\n";
    }
  }

  std::ofstream file_;
};

REGISTER_CONTROLLER(CHearer, "hearer")
REGISTER_LOOP_FUNCTIONS(CLooker, "looker")
