// Experiments for ARGoS3 in this process, as programs of users run them. Tests give the code of controllers and of loop
// functions as functions.
#pragma once

#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/simulator/loop_functions.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "test_folders.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid::test
{

// The code of the experiment that runs.
struct Argos3Code
{
  // Control steps, by the id of the robot.
  std::map<std::string, std::function<void(argos::CCI_Controller&)>> steps{};
  std::function<argos::CColor(const argos::CVector2&)> floor{};
  std::function<bool()> is_over{};
  std::function<void(argos::CLoopFunctions&)> init{};
  // The calls of controllers and loop functions, without control steps.
  std::string calls{};
};
inline Argos3Code& TheCode()
{
  static Argos3Code code;
  return code;
}

// The content of the elements with these names.
struct Argos3Text
{
  std::string controllers{};
  std::string arena{};
  std::string size = "8,8,2";
  std::string engines = "<dummy_engine id='d'/>";
  std::string media = "<range_and_bearing id='rab'/><led id='leds'/>";
  std::string experiment = "length='0' ticks_per_second='10' random_seed='1'";
  // The library that the file names; its functions decide which entities are kept ready.
  std::string library = SWARMANOID_BUILD_FOLDER "/lib/swarmanoid/libargos3_box.so";
  // If there are names, a library that has them takes its place.
  std::vector<std::string> names{};
  // Scripts and other files beside the experiment.
  std::map<std::string, std::string> files{};
};

// Returns a controller whose robots run Argos3Code::steps.
inline std::string Coded(const std::string& id, const std::string& actuators, const std::string& sensors,
                         const std::string& library = Argos3Text().library)
{
  return "<coded id='" + id + "' library='" + library + "'><actuators>" + actuators + "</actuators><sensors>" +
         sensors + "</sensors><params word='spoken'/></coded>";
}

// Returns an entity at a place ("x,y,z") with an orientation ("z,y,x", degrees). `more`: further attributes.
inline std::string Placed(const std::string& tag, const std::string& id, const std::string& place,
                          const std::string& controller = "", const std::string& orientation = "0,0,0",
                          const std::string& more = "", const std::string& elements = "")
{
  return "<" + tag + " id='" + id + "' " + more + "><body position='" + place + "' orientation='" + orientation +
         "'/>" + (controller.empty() ? "" : "<controller config='" + controller + "'/>") + elements + "</" + tag + ">";
}

class Argos3Run
{
public:
  explicit Argos3Run(const Argos3Text& text, Argos3Code code = {})
  {
    TheCode() = std::move(code);
    for (const auto& [name, content] : text.files) folder_.Write(name, content);
    const std::string library = text.names.empty() ? text.library : WriteLibrary(text.names);
    ticpp::Document document(folder_.Path() + "/test.argos");
    document.Parse("<argos-configuration><framework><experiment " + text.experiment + "/></framework><controllers>" +
                   text.controllers + "</controllers><loop_functions library='" + library +
                   "' label='coded'/><arena size='" + text.size + "' center='0,0," +
                   std::to_string(argos::FromString<double>(text.size.substr(text.size.rfind(',') + 1)) / 2) + "'>" +
                   text.arena + "</arena><physics_engines>" + text.engines + "</physics_engines><media>" + text.media +
                   "</media></argos-configuration>");
    Simulator().Load(document);
  }
  ~Argos3Run() { Simulator().Destroy(); }
  Argos3Run(const Argos3Run&) = delete;
  Argos3Run& operator=(const Argos3Run&) = delete;

  static argos::CSimulator& Simulator() { return argos::CSimulator::GetInstance(); }
  static argos::CSpace& Space() { return Simulator().GetSpace(); }
  static argos::CLoopFunctions& Functions() { return Simulator().GetLoopFunctions(); }
  void Step(int steps = 1)
  {
    for (int step = 0; step < steps; ++step) Simulator().UpdateSpace();
  }
  // Gives a robot its code and does a step.
  void Step(const std::string& robot, std::function<void(argos::CCI_Controller&)> code)
  {
    TheCode().steps[robot] = std::move(code);
    Step();
    TheCode().steps.erase(robot);
  }
  template <class Entity = argos::CRobotWithController>
  Entity& Get(const std::string& id)
  {
    return dynamic_cast<Entity&>(Space().GetEntity(id));
  }
  const argos::CVector3& PlaceOf(const std::string& id)
  {
    return Get<argos::CBodyEntity>(id).GetEmbodiedEntity().GetPosition();
  }
  const TemporaryFolder& Folder() const { return folder_; }

private:
  // Returns a library without any code, whose file has these names.
  std::string WriteLibrary(const std::vector<std::string>& names) const
  {
    std::string bytes = TextOf(SWARMANOID_BUILD_FOLDER "/lib/libswarmanoid_version.so");
    for (const std::string& name : names) bytes += '\0' + name + '\0';
    return folder_.Write("libcode.so", bytes);
  }

  TemporaryFolder folder_;
};

}  // namespace swarmanoid::test
