#include "behavior_world.h"

#include <fmt/format.h>

#include <stdexcept>

#include "common/experiment/load_experiment.h"
#include "simulation/register_all.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid::test
{
namespace
{

void AddDevices(const std::string& kind, bool three_dimensional, ControllerText& controller)
{
  if (kind == "footbot")
  {
    controller.actuators = {"dummy_footbot_wheels", "dummy_footbot_gripper", "generic_footbot_leds"};
    controller.sensors = {"generic_footbot_proximity", "generic_footbot_light", "generic_footbot_ground",
                          "generic_footbot_gripper", "generic_footbot_omnidirectional_camera aperture='88'"};
  }
  else if (kind == "eyebot")
  {
    controller.actuators = {"dummy_eyebot_propellers", "generic_eyebot_laser"};
    controller.sensors = {"generic_eyebot_altitude", "generic_eyebot_camera aperture='60'"};
  }
  else
  {
    if (!three_dimensional) throw std::logic_error("handbots of these tests live in 3D");
    controller.actuators = {"dummy_handbot_arms", "dummy_handbot_hands", "dummy_handbot_rope"};
    controller.sensors = {"generic_handbot_joints"};
  }
}

}  // namespace

void BehaviorWorld::Robot(const std::string& kind, const std::string& id, const std::string& behavior,
                          const std::string& place)
{
  ControllerText controller{.tag = kind + "_probe", .id = kind + "_" + behavior};
  if (known_controllers_.insert(controller.id).second)
  {
    controller.attributes = "library='" PROBE_CONTROLLERS "'";
    controller.parameters = "<behavior>" + behavior + "</behavior>";
    AddDevices(kind, three_dimensional_, controller);
    text_.controllers += Controller(controller);
  }
  text_.arena += fmt::format("<{} id='{}' {} controller='{}'/>", kind, id, place, controller.id);
  (kind == "eyebot" && !three_dimensional_ ? sky_ : ground_) += fmt::format("<entity id=\"{}\"/>", id);
}

BehaviorWorld& BehaviorWorld::Footbot(const std::string& id, const std::string& behavior, double x, double y,
                                      double heading)
{
  Robot("footbot", id, behavior, fmt::format("position='{},{},0' orientation='0,0,{}'", x, y, heading));
  return *this;
}

BehaviorWorld& BehaviorWorld::Eyebot(const std::string& id, const std::string& behavior, double x, double y, double z)
{
  Robot("eyebot", id, behavior, fmt::format("position='{},{},{}'", x, y, z));
  return *this;
}

BehaviorWorld& BehaviorWorld::Handbot(const std::string& id, const std::string& behavior, double x, double y)
{
  Robot("handbot", id, behavior, fmt::format("position='{},{},0'", x, y));
  return *this;
}

BehaviorWorld& BehaviorWorld::Block(const std::string& id, const std::string& position, const std::string& size,
                                    const std::string& more)
{
  text_.arena += fmt::format("<block id='{}' position='{}' size='{}'>{}</block>", id, position, size, more);
  ground_ += fmt::format("<entity id=\"{}\"/>", id);
  if (!three_dimensional_) sky_ += fmt::format("<entity id=\"{}\"/>", id);
  return *this;
}

BehaviorWorld& BehaviorWorld::Prey(const std::string& id, double x, double y, const std::string& colour)
{
  text_.arena += fmt::format("<cylindric_prey id='{}' position='{},{},0' radius='0.1' height='0.1' colour='{}'/>", id,
                             x, y, colour);
  ground_ += fmt::format("<entity id=\"{}\"/>", id);
  return *this;
}

BehaviorWorld& BehaviorWorld::Light(const std::string& id, const std::string& position, double intensity)
{
  text_.arena += fmt::format("<light_bulb id='{}' position='{}' intensity='{}'/>", id, position, intensity);
  return *this;
}

BehaviorWorld& BehaviorWorld::Patch(const std::string& id, double x, double y, const std::string& colour)
{
  text_.arena += fmt::format("<nest id='{}' position='{},{},0' size='1,1' colour='{}'/>", id, x, y, colour);
  return *this;
}

BehaviorWorld& BehaviorWorld::Functions(const std::string& tag, const std::string& library)
{
  text_.functions = fmt::format("<{0} id='{0}' library='{1}'/>", tag, library);
  return *this;
}

std::string BehaviorWorld::End()
{
  simulator_->Finish();
  return folder_.Path();
}

BehaviorWorld& BehaviorWorld::Walls(double side)
{
  const auto wall = [this, side](const char* id, double x, double y, double size_x, double size_y)
  { Block(id, fmt::format("{},{},1", x, y), fmt::format("{},{},2", size_x, size_y)); };
  wall("west", 0.05, side / 2, 0.1, side);
  wall("east", side - 0.05, side / 2, 0.1, side);
  wall("south", side / 2, 0.05, side - 0.2, 0.1);
  wall("north", side / 2, side - 0.05, side - 0.2, 0.1);
  return *this;
}

BehaviorWorld& BehaviorWorld::Seed(int seed)
{
  seed_ = seed;
  return *this;
}

void BehaviorWorld::Start()
{
  const auto plane = [](const char* id, double distance)
  { return fmt::format("<dummy_engine id='{}' perpendicular_axis='z' distance='{}'/>", id, distance); };
  text_.framework = fmt::format("<maxclock>0</maxclock><seed>{}</seed>", seed_);
  text_.optimization = three_dimensional_ ? "3D" : "2D";
  text_.engines =
      three_dimensional_ ? "<dynamics3d id='ground' ceiling='true'/>" : plane("ground", 0) + plane("sky", 1.5);
  text_.physics = "<engine id='ground'>" + ground_ + "</engine>";
  if (!three_dimensional_) text_.physics += "<engine id='sky'>" + sky_ + "</engine>";
  RegisterBuiltins();
  experiment_ = text_.Load();
  if (!experiment_) throw std::runtime_error("the world of the test has mistakes");
  SimulatorOptions options;
  if (!text_.functions.empty()) options.output_folder = folder_.Path();
  simulator_ = std::make_unique<CSimulator>(*experiment_, options);
}

const CSwarmanoidSpace& BehaviorWorld::Space()
{
  if (simulator_ == nullptr) Start();
  return simulator_->GetSpace();
}

void BehaviorWorld::Run(int ticks)
{
  Space();
  for (int tick = 0; tick < ticks; ++tick) simulator_->Step();
}

double BehaviorWorld::Attribute(const std::string& id, const std::string& name, int element)
{
  return Space().FindEntity(id)->GetAttribute(name, element);
}

}  // namespace swarmanoid::test
