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
#include "common/messages/robot_status.h"
#include "common/messages/run_status.h"
#include "common/plugins/registry.h"

#ifndef SWARMANOID_OWN_SOURCES
#include <common/space/space.h>  // for plug-ins, which mostly need it
#endif

namespace swarmanoid
{

class CSwarmanoidSpace;

struct ControlOrder;

// What a user asks of the experiment through a renderer. The space server, or the runner of a single process, executes
// it between two ticks. RunMonitor::Notes has the reply. For the thread of Draw and Idle. The functions are virtual so
// that renderers in libraries of their own need no symbol for them.
class ExperimentControl
{
public:
  virtual ~ExperimentControl() = default;
  // Any request of common/messages/control_verbs.h; the others are shorter ways to some of them.
  virtual void Ask(const ControlOrder& order) = 0;
  virtual void Pause();
  virtual void Resume();
  virtual void Step(unsigned ticks);
  virtual void SetSpeed(double real_time_factor);  // 0: as fast as possible
  virtual void MoveEntity(const std::string& id, const Pose& pose);
  // Puts an entity that is not in the arena into it: the one of that id, or the next one of the <reserve> of that id.
  virtual void AddEntity(const std::string& id, const Pose& pose);
  virtual void RemoveEntity(const std::string& id);
  // For the experiment functions: a key by its name (UserInput), pressed or released, and an entity that is selected
  // (its id; empty: none is).
  virtual void PressKey(const std::string& key, bool pressed);
  virtual void SelectEntity(const std::string& id);
  virtual void Stop();   // the run ends at its tick
  virtual void Reset();  // and begins again at tick 0, with the same seed
};

// What a renderer can know of the run beyond its space. For the thread of Draw and Idle; nothing here waits, and what a
// renderer never asks for costs nothing. References are valid until the next call of the same function.
class RunMonitor
{
public:
  virtual ~RunMonitor() = default;
  // As it is known now; phase kUnknown before anything has been heard.
  virtual const RunStatus& Status() = 0;
  // What users asked of the run since this renderer came, oldest first; the last hundred.
  virtual std::span<const RunNote> Notes() = 0;
  // The robots (entity indices) whose inside is wanted from now on, instead of those named before. Entities without a
  // controller are ignored.
  virtual void Watch(std::span<const std::uint32_t> robots) = 0;
  // The latest of a watched robot; nullptr while nothing has come.
  virtual const RobotStatus* Robot(std::uint32_t robot) = 0;
  // The folder of the run, if it is on this machine and the run keeps a journal there; otherwise empty.
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
  // True once the user wants the experiment (synchronous) or the watching (attached) to end.
  virtual bool Terminate() { return false; }
  // Called between ticks of a paused or slow experiment, so that windows stay alive; every 10 to 20 ms, also before the
  // first Draw. The space may have changed since: entities that were moved while the run is paused.
  virtual void Idle() {}
  // After the last Draw: close files.
  virtual void Finish() {}
  // A window or a page, through which a user may resume a paused run. Attached, it stays after the end of the run, with
  // calls of Idle, until it terminates.
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

// REGISTER_RENDER(CMyRender, description): for renderers in a user's library.
#define REGISTER_RENDER(CLASS, ...)                                                                             \
  namespace                                                                                                     \
  {                                                                                                             \
  const ::swarmanoid::RenderRegistration registration_of_##CLASS(__VA_ARGS__,                                   \
                                                                 []() -> std::unique_ptr<::swarmanoid::CRender> \
                                                                 { return std::make_unique<CLASS>(); });        \
  }
