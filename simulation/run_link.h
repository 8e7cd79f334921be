// RunLink: connects a run in one process with users outside of it, who watch and steer it as they do a cluster. The
// launcher implements it over the bus; the simulator knows no bus. The thread of the run calls it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "controller_host/controller_host.h"
#include "idl/control_request_message.h"
#include "idl/run_status.h"
#include "space_server/space_server.h"
#include "visualiser/render.h"

namespace swarmanoid
{

class RunLink
{
public:
  // The roles of the run, which exist until Detach.
  struct Roles
  {
    SpaceServer& server;
    const Assignment& assignment;
    const ControllerHost& host;
    // Any thread may call these: a request of a user, and a line of the event log for what happened elsewhere.
    std::function<void(const ControlRequestMessage&)> ask;
    std::function<void(const ControlRequestMessage&)> note;
  };

  virtual ~RunLink() = default;
  // Lets users find the run, which is at its first tick. Errors of the bus leave the run without users outside.
  virtual void Open(const Roles& roles) = 0;
  // Returns whether users outside can find the run.
  virtual bool IsOpen() const = 0;
  // Sends what is due. Call it between two ticks, again and again while the run waits.
  virtual void Publish(RunMonitor& run) = 0;
  // Sends the reply to a request.
  virtual void Reply(const ControlRequestMessage& request, bool done, std::uint64_t tick, const std::string& text) = 0;
  // Returns the visualisers that are attached.
  virtual std::vector<ProcessStatus> Attached() const = 0;
  // The roles end, after Close or because the run failed: none of them is used any more.
  virtual void Detach() = 0;
  // Sends the last state. `begins_again`: observers wait for the next run instead.
  virtual void Close(RunMonitor& run, bool begins_again) = 0;
  // Tells observers that the run failed. It does nothing after Close.
  virtual void Fail(const std::string& why) = 0;
};

}  // namespace swarmanoid
