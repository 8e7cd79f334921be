// RunMonitor over the bus: reports of the space server and the controller hosts about a run. The main thread of the
// visualiser program makes and calls it; messages arrive in threads of the bus. A topic is subscribed when a renderer
// first needs it.
#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "common/bus/bus.h"
#include "idl/messages.h"
#include "visualiser/render.h"

namespace swarmanoid
{

class RemoteMonitor : public RunMonitor
{
public:
  // If `every_tick` is true, the status of robots is requested at every tick rather than 30 times a second.
  RemoteMonitor(Bus& bus, const WorldMessage& world, bool every_tick);

  const RunStatus& Status() override;
  std::span<const RunNote> Notes() override;
  void Watch(std::span<const std::uint32_t> robots) override;
  const RobotStatus* Robot(std::uint32_t robot) override;
  std::string RunFolder() override;

  // Adds a note about a request of this process that was not sent.
  void NoteRefusal(const std::string& text);
  // Returns the last known phase without a request: kUnknown unless the renderer shows the status of the run.
  RunStatus::Phase KnownPhase();
  // Requests this many states a second; 0: none.
  void RequestViews(double views);
  // Repeats the requests in time; call it often.
  void RenewRequests();
  // Notes that the server is lost and another one may continue the run, or that another one does, under this number.
  void ServerIsLost();
  void FollowRun(std::uint64_t run);
  // Notes that the server has gone. `why` is shown unless the server reported that the run is finished.
  void RunIsOver(const std::string& why);

private:
  using Clock = std::chrono::steady_clock;
  void SendRequests();
  void Heard(const RobotStatusMessage& message);
  void AddNote(RunNote note);  // the caller holds mutex_

  Bus& bus_;
  std::string partition_;
  std::atomic<std::uint64_t> run_;  // threads of the bus read it
  std::size_t entities_;            // the number of entities in the space
  ViewRequestMessage requests_;
  Clock::time_point requested_{};

  std::mutex mutex_;  // guards the next four members, which threads of the bus change
  RunStatus heard_status_;
  bool over_ = false;
  std::vector<RunNote> heard_notes_;
  std::map<std::uint32_t, RobotStatus> heard_robots_;

  // Copies for the main thread.
  RunStatus status_;
  std::vector<RunNote> notes_;
  std::map<std::uint32_t, RobotStatus> robots_;

  std::unique_ptr<Publisher<ViewRequestMessage>> requests_out_;
  std::unique_ptr<Subscription<RunStatusMessage>> statuses_in_;
  std::unique_ptr<Subscription<ControlReplyMessage>> replies_in_;
  std::unique_ptr<Subscription<RobotStatusMessage>> robots_in_;
};

}  // namespace swarmanoid
