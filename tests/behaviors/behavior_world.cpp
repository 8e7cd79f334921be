#include "behavior_world.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "common/experiment/load_experiment.h"
#include "simulation/register_all.h"

namespace swarmanoid::test
{
namespace
{

std::string Device(const std::string& type, const std::string& implementation, const std::string& parameters = "")
{
  return fmt::format("<{0}><implementation>{1}</implementation>{2}</{0}>", type, implementation, parameters);
}

std::string Devices(const std::string& kind, bool three_dimensional)
{
  if (kind == "footbot")
    return "<actuators>" + Device("footbot_wheels", "dummy_footbot_wheels") +
           Device("footbot_gripper", "dummy_footbot_gripper") + Device("footbot_leds", "generic_footbot_leds") +
           "</actuators><sensors>" + Device("footbot_proximity", "generic_footbot_proximity") +
           Device("footbot_light", "generic_footbot_light") + Device("footbot_ground", "generic_footbot_ground") +
           Device("footbot_gripper", "generic_footbot_gripper") +
           Device("footbot_omnidirectional_camera", "generic_footbot_omnidirectional_camera",
                  "<aperture>88</aperture>") +
           "</sensors>";
  if (kind == "eyebot")
    return "<actuators>" + Device("eyebot_propellers", "dummy_eyebot_propellers") +
           Device("eyebot_laser", "generic_eyebot_laser") + "</actuators><sensors>" +
           Device("eyebot_altitude", "generic_eyebot_altitude") +
           Device("eyebot_camera", "generic_eyebot_camera", "<aperture>60</aperture>") + "</sensors>";
  if (!three_dimensional) throw std::logic_error("handbots of these tests live in 3D");
  return "<actuators>" + Device("handbot_arms", "dummy_handbot_arms") + Device("handbot_hands", "dummy_handbot_hands") +
         Device("handbot_rope", "dummy_handbot_rope") + "</actuators><sensors>" +
         Device("handbot_joints", "generic_handbot_joints") + "</sensors>";
}

}  // namespace

void BehaviorWorld::Robot(const std::string& kind, const std::string& id, const std::string& behavior,
                          const std::string& place)
{
  const std::string controller = kind + "_" + behavior;
  if (known_controllers_.insert(controller).second)
    controllers_ += fmt::format(
        "<{0}_probe id=\"{1}\" library=\"{2}\">{3}<parameters><behavior>{4}</behavior></parameters></{0}_probe>\n",
        kind, controller, PROBE_CONTROLLERS, Devices(kind, three_dimensional_), behavior);
  arena_ += fmt::format("<{0} id=\"{1}\">{2}<controller>{3}</controller></{0}>\n", kind, id, place, controller);
  (kind == "eyebot" && !three_dimensional_ ? sky_ : ground_) += fmt::format("<entity id=\"{}\"/>", id);
}

BehaviorWorld& BehaviorWorld::Footbot(const std::string& id, const std::string& behavior, double x, double y,
                                      double heading)
{
  Robot("footbot", id, behavior,
        fmt::format("<position>{},{},0</position><orientation>0,0,{}</orientation>", x, y, heading));
  return *this;
}

BehaviorWorld& BehaviorWorld::Eyebot(const std::string& id, const std::string& behavior, double x, double y, double z)
{
  Robot("eyebot", id, behavior, fmt::format("<position>{},{},{}</position><orientation>0,0,0</orientation>", x, y, z));
  return *this;
}

BehaviorWorld& BehaviorWorld::Handbot(const std::string& id, const std::string& behavior, double x, double y)
{
  Robot("handbot", id, behavior, fmt::format("<position>{},{},0</position><orientation>0,0,0</orientation>", x, y));
  return *this;
}

BehaviorWorld& BehaviorWorld::Block(const std::string& id, const std::string& position, const std::string& size,
                                    const std::string& more)
{
  arena_ +=
      fmt::format("<block id=\"{}\"><position>{}</position><orientation>0,0,0</orientation><size>{}</size>{}</block>\n",
                  id, position, size, more);
  ground_ += fmt::format("<entity id=\"{}\"/>", id);
  if (!three_dimensional_) sky_ += fmt::format("<entity id=\"{}\"/>", id);
  return *this;
}

BehaviorWorld& BehaviorWorld::Prey(const std::string& id, double x, double y, const std::string& colour)
{
  arena_ += fmt::format(
      "<cylindric_prey id=\"{}\"><position>{},{},0</position><orientation>0,0,0</orientation><radius>0.1</radius>"
      "<height>0.1</height><colour>{}</colour></cylindric_prey>\n",
      id, x, y, colour);
  ground_ += fmt::format("<entity id=\"{}\"/>", id);
  return *this;
}

BehaviorWorld& BehaviorWorld::Light(const std::string& id, const std::string& position, double intensity)
{
  arena_ += fmt::format("<light_bulb id=\"{}\"><position>{}</position><intensity>{}</intensity></light_bulb>\n", id,
                        position, intensity);
  return *this;
}

BehaviorWorld& BehaviorWorld::Patch(const std::string& id, double x, double y, const std::string& colour)
{
  arena_ += fmt::format(
      "<nest "
      "id=\"{}\"><position>{},{},0</position><orientation>0,0,0</orientation><size>1,1</size><colour>{}</colour></"
      "nest>\n",
      id, x, y, colour);
  return *this;
}

BehaviorWorld& BehaviorWorld::Functions(const std::string& tag, const std::string& library)
{
  functions_ =
      fmt::format("<experiment_functions><{0} id=\"{0}\" library=\"{1}\"/></experiment_functions>", tag, library);
  return *this;
}

BehaviorWorld::~BehaviorWorld()
{
  simulator_.reset();
  if (!folder_.empty()) std::filesystem::remove_all(folder_);
}

std::string BehaviorWorld::End()
{
  simulator_->Finish();
  return folder_;
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
  constexpr const char* kPlane =
      "<dummy_engine id=\"{}\"><subclock>1</subclock><perpendicular_axis>z</perpendicular_axis><distance>{}</distance>"
      "</dummy_engine>";
  std::string engines = "<dynamics3d id=\"ground\"><ceiling>true</ceiling></dynamics3d>";
  if (!three_dimensional_)
    engines = fmt::format(fmt::runtime(kPlane), "ground", 0) + fmt::format(fmt::runtime(kPlane), "sky", 1.5);
  std::string physics = "<engine id=\"ground\">" + ground_ + "</engine>";
  if (!three_dimensional_) physics += "<engine id=\"sky\">" + sky_ + "</engine>";
  const std::string text = fmt::format(
      "<ahss-config><framework><clocktick>100</clocktick><maxclock>0</maxclock><seed>{}</seed></framework>\n"
      "<controllers>{}</controllers>\n<arena size=\"{}\" optimization=\"{}\">{}</arena>\n<engines>{}</engines>\n"
      "<arena_physics>{}</arena_physics>{}</ahss-config>",
      seed_, controllers_, size_, three_dimensional_ ? "3D" : "2D", arena_, engines, physics, functions_);
  RegisterBuiltins();
  LoadedExperiment loaded = LoadExperimentText(text, "behaviors.xml", ".");
  if (!loaded.experiment) throw std::runtime_error(loaded.errors.front().Text());
  experiment_ = std::move(loaded.experiment);
  SimulatorOptions options;
  if (!functions_.empty())
  {
    folder_ = (std::filesystem::temp_directory_path() / fmt::format("swarmanoid_behaviors_{}", getpid())).string();
    std::filesystem::create_directories(folder_);
    options.output_folder = folder_;
  }
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
