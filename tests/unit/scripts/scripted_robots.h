// Two foot-bots with a script, without the other processes of a run. Their commands and states are those of a host.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/space/space.h"
#include "controller_host/controller_host.h"
#include "simulation/register_all.h"
#include "tests/world/experiment_text.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{

struct ScriptText
{
  std::string script;
  std::string parameters{};  // content of <parameters> beside the script
  std::vector<std::string> actuators{"dummy_footbot_wheels"};
  std::vector<std::string> sensors{"generic_footbot_proximity"};
  std::map<std::string, std::string> files{};  // beside the script
  std::string file = "walk.lua";               // its name; the ending tells its language
};

// Two foot-bots, "a" and "b" half a metre in front of it, with the script.
class Scripted
{
public:
  explicit Scripted(const ScriptText& text, std::uint64_t seed = 7)
  {
    RegisterBuiltins();
    const std::string language = text.file.ends_with("py") ? "python" : "lua";
    folder_.Write("s/" + text.file, text.script);
    for (const auto& [name, content] : text.files) folder_.Write(name, content);
    loaded_ = LoadExperimentText(
        test::ExperimentText{
            .framework = "<seed>" + std::to_string(seed) + "</seed>",
            .controllers = test::Controller({.tag = language + "_controller",
                                             .actuators = text.actuators,
                                             .sensors = text.sensors,
                                             .parameters = "<script>s/" + text.file + "</script>" + text.parameters,
                                             .attributes = "library='" + language + "'"}),
            .arena = "<footbot id='a' position='1,1,0' controller='c'/><footbot id='b' position='1.5,1,0' "
                     "orientation='0,0,180' controller='c'/>"}
            .Text(),
        "walk.xml", folder_.Path());
    if (loaded_.experiment == nullptr) return;
    assignment_ = MakeAssignment(*loaded_.experiment, 1);
    space = std::make_unique<CSwarmanoidSpace>(*loaded_.experiment);
    host = std::make_unique<ControllerHost>(*space, assignment_, 0);
  }

  // Makes one tick. LEDs and other attributes that controllers set in it are visible in the next tick.
  const ControlCommands& Tick(std::uint64_t tick)
  {
    space->SetTick(tick);
    const ControlCommands& commands = host->Tick({});
    space->SetAttributes(commands.attributes);
    return commands;
  }
  // The global `status` of a script.
  std::string Status(std::uint32_t robot = 0) const
  {
    RobotStatus status;
    host->Describe(robot, status);
    return status.text;
  }
  std::string StatusAfter(std::uint64_t ticks)
  {
    for (std::uint64_t tick = 0; tick < ticks; ++tick) Tick(tick);
    return Status();
  }
  std::vector<char> Saved() const
  {
    ByteWriter bytes;
    host->SaveState(bytes);
    return bytes.Bytes();
  }
  void Load(const std::vector<char>& saved)
  {
    ByteReader bytes(saved);
    host->LoadState(bytes);
  }
  // The mistakes of the file.
  std::string Mistakes() const
  {
    std::string all;
    for (const Diagnostic& error : loaded_.errors) all += error.Text() + "\n";
    return all;
  }
  const std::string& Folder() const { return folder_.Path(); }

private:
  test::TemporaryFolder folder_;
  LoadedExperiment loaded_;
  Assignment assignment_;

public:
  std::unique_ptr<CSwarmanoidSpace> space;
  std::unique_ptr<ControllerHost> host;
};

// Returns what goes wrong while a script runs for two ticks.
inline std::string FailureOf(const ScriptText& text)
{
  return test::MessageOf<std::runtime_error>(
      [&]
      {
        Scripted scripted(text);
        if (scripted.host == nullptr) throw std::runtime_error(scripted.Mistakes());
        scripted.StatusAfter(2);
      });
}

}  // namespace swarmanoid
