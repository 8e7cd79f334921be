// CRender: the thin interface of all visualisations. Draw shows the space; Terminate says whether the user wants to
// stop.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "common/configuration/output_file.h"
#include "common/configuration/parameter.h"
#include "common/math/pose.h"
#include "common/messages/assignment.h"
#include "common/messages/run_status.h"
#include "common/plugins/registry.h"
#include "idl/robot_status.h"

#ifndef SWARMANOID_OWN_SOURCES
#include <common/space/space.h>  // for plug-ins, which mostly need it
#endif

namespace swarmanoid
{

class CSwarmanoidSpace;

struct ControlOrder;

// The requests of a user to the experiment through a renderer. The space server, or the runner of a single process,
// executes them between two ticks, and RunMonitor::Notes has the replies. They are for the thread of Draw and Idle, and
// return at once. The functions are virtual so that renderers in libraries of their own need no symbol for them.
class ExperimentControl
{
public:
  virtual ~ExperimentControl() = default;
  // Sends any request of common/messages/control_verbs.h. The other functions are shorter ways to some of them.
  virtual void Ask(const ControlOrder& order) = 0;
  // Pauses the run after its tick.
  virtual void Pause();
  // Continues a paused run.
  virtual void Resume();
  // Runs this many ticks of a paused run.
  virtual void Step(unsigned ticks);
  // Sets the pace as a multiple of real time; 0 is as fast as possible.
  virtual void SetSpeed(double real_time_factor);
  // Moves an entity to a pose in the space (m).
  virtual void MoveEntity(const std::string& id, const Pose& pose);
  // Puts an entity into the arena that is outside: the one of that id, or the next one of the <reserve> of that id.
  virtual void AddEntity(const std::string& id, const Pose& pose);
  // Takes an entity out of the arena.
  virtual void RemoveEntity(const std::string& id);
  // Passes a key to the experiment functions, by its name (UserInput), pressed or released.
  virtual void PressKey(const std::string& key, bool pressed);
  // Tells the experiment functions which entity is selected, by its id; an empty id selects none.
  virtual void SelectEntity(const std::string& id);
  // Ends the run at its tick.
  virtual void Stop();
  // Begins the run again at tick 0, with the same seed.
  virtual void Reset();
};

// The knowledge about the run that a renderer gets beyond its space. It is for the thread of Draw and Idle. No function
// waits, and data that a renderer never requests costs nothing. References are valid until the next call of the same
// function.
class RunMonitor
{
public:
  virtual ~RunMonitor() = default;
  // Returns the last known status. Its phase is kUnknown before the first message of the run.
  virtual const RunStatus& Status() = 0;
  // Returns the last hundred requests of users since this renderer started, oldest first.
  virtual std::span<const RunNote> Notes() = 0;
  // Requests the status of these robots (entity indices) instead of those named before. Entities without a controller
  // are ignored.
  virtual void Watch(std::span<const std::uint32_t> robots) = 0;
  // Returns the latest status of a watched robot, or nullptr before the first one.
  virtual const RobotStatus* Robot(std::uint32_t robot) = 0;
  // Returns the folder of the run if it is on this machine and the run keeps a journal there; otherwise an empty text.
  virtual std::string RunFolder() { return {}; }
};

struct RenderSetup
{
  Parameters parameters;
  const CSwarmanoidSpace& space;
  const Assignment& assignment;          // who owns what: OwnerName, HostNameOf
  std::string output_folder;             // relative output paths start here
  ExperimentControl* control = nullptr;  // nullptr if the renderer may only watch
  RunMonitor* monitor = nullptr;         // nullptr only if a renderer is used outside a run

  // Makes the file that a parameter names and returns its path for writing. Throws ConfigurationError, at the value of
  // the parameter, if the file must not be written (docs/security.md).
  std::string MakeOutputFile(const char* parameter) const
  {
    CheckFile(parameter, parameters.Text(parameter));
    return Files().Claim(parameters.Text(parameter));
  }
  // The same in two steps, for renderers whose files have names of their own or are written later.
  OutputFiles Files() const { return OutputFiles(output_folder); }
  void CheckFile(const char* parameter, const std::string& name) const
  {
    try
    {
      Files().Check(name);
    }
    catch (const OutputFileError& error)
    {
      throw ConfigurationError(parameters.Tree().ValueLocation(parameter),
                               std::string(parameter) + ": " + error.what());
    }
  }
};

class CRender
{
public:
  virtual ~CRender() = default;
  // Throws ConfigurationError or std::runtime_error with a clear text if it cannot start.
  virtual void Init(const RenderSetup& setup) = 0;
  // Shows the space at its tick. Synchronous visualisations are waited for.
  virtual void Draw() = 0;
  // Returns true once the user wants the experiment (synchronous) or the watching (attached) to end.
  virtual bool Terminate() { return false; }
  // Called between ticks of a paused or slow experiment, so that windows stay alive; every 10 to 20 ms, also before the
  // first Draw. The space may have changed since: entities that were moved while the run is paused.
  virtual void Idle() {}
  // Called after the last Draw, to close files. Throws std::runtime_error if a file cannot be written.
  virtual void Finish() {}
  // Returns true for a window or a page, through which a user may resume a paused run. Attached, it stays after the end
  // of the run, with calls of Idle, until it terminates.
  virtual bool IsInteractive() const { return false; }
};

template <>
PluginRegistry<CRender>& PluginRegistry<CRender>::Instance();

// Adds the renderers of this folder that are part of the build to the registry. Idempotent.
void RegisterBuiltinRenderers();

struct RenderRegistration
{
  RenderRegistration(const PluginDescription& description, std::unique_ptr<CRender> (*create)())
  {
    PluginRegistry<CRender>::Instance().Add(description, create);
  }
};

}  // namespace swarmanoid

using swarmanoid::CRender;

// REGISTER_RENDER(CMyRender, description) registers a renderer of a user's library.
#define REGISTER_RENDER(CLASS, ...)                                                                             \
  namespace                                                                                                     \
  {                                                                                                             \
  const ::swarmanoid::RenderRegistration registration_of_##CLASS(__VA_ARGS__,                                   \
                                                                 []() -> std::unique_ptr<::swarmanoid::CRender> \
                                                                 { return std::make_unique<CLASS>(); });        \
  }
