// CRender: the thin interface of all visualisations. Draw shows the space; Terminate says whether the user wants to
// stop.
#pragma once

#include <memory>
#include <string>

#include "common/configuration/parameter.h"
#include "common/plugins/registry.h"
#include "common/space/assignment.h"
#include "common/space/space.h"

namespace swarmanoid
{

// What a user asks of the experiment through a renderer; sent to the space server's control service.
class ExperimentControl
{
public:
  virtual ~ExperimentControl() = default;
  virtual void Pause() = 0;
  virtual void Resume() = 0;
  virtual void Step(unsigned ticks) = 0;
  virtual void SetSpeed(double real_time_factor) = 0;  // 0: as fast as possible
  virtual void MoveEntity(const std::string& id, const Pose& pose) = 0;
};

struct RenderSetup
{
  Parameters parameters;
  const CSwarmanoidSpace& space;
  const Assignment& assignment;          // who owns what, for display
  std::string output_folder;             // relative output paths start here
  ExperimentControl* control = nullptr;  // nullptr where the renderer may only watch
};

class CRender
{
public:
  virtual ~CRender() = default;
  // Throws ConfigurationError or std::runtime_error with a clear text where it cannot start.
  virtual void Init(const RenderSetup& setup) = 0;
  // Shows the space at its tick. Synchronous visualisations are waited for.
  virtual void Draw() = 0;
  // True once the user wants the experiment (synchronous) or the watching (attached) to end.
  virtual bool Terminate() { return false; }
  // Called between ticks of a paused or slow experiment, so that windows stay alive. At most every 10 ms.
  virtual void Idle() {}
  // After the last Draw: close files.
  virtual void Finish() {}
};

template <>
PluginRegistry<CRender>& PluginRegistry<CRender>::Instance();

// Adds the renderers of this folder that are part of the build to the registry. Idempotent.
void RegisterBuiltinRenderers();

struct RenderRegistration
{
  RenderRegistration(PluginDescription description, std::unique_ptr<CRender> (*create)())
  {
    PluginRegistry<CRender>::Instance().Add(std::move(description), create);
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
