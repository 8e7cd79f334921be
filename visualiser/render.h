// CRender: the interface of all visualisations. Draw shows the space; Terminate says whether the user wants to stop.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "common/configuration/output_file.h"
#include "common/configuration/parameter.h"
#include "common/math/pose.h"
#include "common/messages/assignment.h"
#include "common/messages/robot_status.h"
#include "common/messages/run_status.h"
#include "common/plugins/registry.h"

#ifndef SWARMANOID_OWN_SOURCES
#include <common/space/space.h>  // for plug-ins, most of which need it
#endif

namespace swarmanoid
{

class CSwarmanoidSpace;

// Requests of a user to the experiment through a renderer. The space server, or the runner of a single process, decides
// on them between two ticks. RunMonitor::Notes has the results. For the thread of Draw and Idle.
class ExperimentControl
{
public:
  virtual ~ExperimentControl() = default;
  // Pauses the run before its next tick.
  virtual void Pause() = 0;
  // Resumes a paused run.
  virtual void Resume() = 0;
  // Runs this number of ticks and pauses again.
  virtual void Step(unsigned ticks) = 0;
  virtual void SetSpeed(double real_time_factor) = 0;  // times real time; 0: as fast as possible
  // Moves an entity to a pose, in metres in the frame of the arena. The run refuses it with a note if the pose is not
  // possible.
  virtual void MoveEntity(const std::string& id, const Pose& pose) = 0;
  // Adds an entity that is outside the arena: the one of that id, or the next one of the <reserve> of that id. The pose
  // is in metres in the frame of the arena.
  virtual void AddEntity(const std::string& id, const Pose& pose) = 0;
  // Takes an entity that can move, or is of a <reserve>, out of the arena.
  virtual void RemoveEntity(const std::string& id) = 0;
  // Input for the experiment functions: a key by its name (UserInput), pressed or released, and the id of a selected
  // entity (empty: none).
  virtual void PressKey(const std::string& key, bool pressed) = 0;
  virtual void SelectEntity(const std::string& id) = 0;
  virtual void Stop() = 0;   // ends the run at its current tick
  virtual void Reset() = 0;  // starts the run again at tick 0, with the same seed
};

// The state of the run that a renderer can read beside its space. For the thread of Draw and Idle. No function waits,
// and unused data costs nothing. References are valid until the next call of the same function.
class RunMonitor
{
public:
  virtual ~RunMonitor() = default;
  // Returns the current status; its phase is kUnknown before anything has been received.
  virtual const RunStatus& Status() = 0;
  // Returns the results of users' requests since this renderer started, oldest first; at most the last hundred.
  virtual std::span<const RunNote> Notes() = 0;
  // Sets the robots (entity indices) whose status is wanted from now on; it replaces the earlier list. Entities without
  // a controller are ignored.
  virtual void Watch(std::span<const std::uint32_t> robots) = 0;
  // Returns the latest status of a watched robot; nullptr while none has come.
  virtual const RobotStatus* Robot(std::uint32_t robot) = 0;
  // Returns the folder of the run, if it is on this machine and the run keeps a journal there; otherwise an empty text.
  virtual std::string RunFolder() { return {}; }
};

struct RenderSetup
{
  Parameters parameters;
  const CSwarmanoidSpace& space;
  const Assignment& assignment;          // the owners of entities: OwnerName, HostNameOf
  std::string output_folder;             // the start of relative output paths
  ExperimentControl* control = nullptr;  // nullptr if the renderer may only watch
  RunMonitor* monitor = nullptr;         // nullptr only if a renderer is used outside a run

  // Makes the file that a parameter names and returns its path for writing. Throws ConfigurationError, at the value of
  // the parameter, if the file must not be written (docs/security.md).
  std::string MakeOutputFile(const char* parameter) const
  {
    CheckFile(parameter, parameters.Text(parameter));
    return Files().Claim(parameters.Text(parameter));
  }
  // Do the same in two steps, for renderers whose files have other names or are written later.
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
  // Called once before the first Draw. Throws ConfigurationError or std::runtime_error with a clear text if the
  // renderer cannot start.
  virtual void Init(const RenderSetup& setup) = 0;
  // Shows the space at its tick. The run waits for synchronous visualisations.
  virtual void Draw() = 0;
  // Returns true once the user wants the experiment (synchronous) or the watching (attached) to end.
  virtual bool Terminate() { return false; }
  // Called between ticks of a paused or slow experiment every 10 to 20 ms, also before the first Draw, so that windows
  // respond. The space may have changed since the last call, by entities that were moved while the run is paused.
  virtual void Idle() {}
  // Called after the last Draw, to close files.
  virtual void Finish() {}
  // Returns whether the renderer is a window or a page, through which a user may resume a paused run. An attached one
  // stays after the end of the run, with calls of Idle, until it terminates.
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
