// RunMonitor over the bus: what the space server and the controller hosts tell of a run. Made and asked by the main
// thread of the visualiser program; messages come in threads of the bus. Topics are met when a renderer first asks for
// what they carry.
#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "common/bus/bus.h"
#include "visualiser/render.h"

namespace swarmanoid
{

class RemoteMonitor : public RunMonitor
{
public:
  // `every_tick`: the inside of robots is wanted of every tick rather than 30 times a second.
  RemoteMonitor(Bus& bus, const WorldMessage& world, bool every_tick);

  const RunStatus& Status() override;
  std::span<const RunNote> Notes() override;
  void Watch(std::span<const std::uint32_t> robots) override;
  const RobotStatus* Robot(std::uint32_t robot) override;
  std::string RunFolder() override;

  // Adds a note about a request of this process that was not sent.
  void NoteRefusal(const std::string& text);
  // What was heard, without asking for it: kUnknown unless the renderer shows how the run goes.
  RunStatus::Phase KnownPhase();
  // Asks for this many states a second; 0: none.
  void RequestViews(double views);
  // To be called often: repeats the request in time.
  void RenewRequests();
  // The server is lost, and another one may go on with the run; or it does, under this number.
  void ServerIsLost();
  void FollowRun(std::uint64_t run);
  // The server has gone. `why` is shown unless it said that the run is finished.
  void RunIsOver(const std::string& why);

private:
  using Clock = std::chrono::steady_clock;
  void SendRequests();
  void Heard(const RobotStatusMessage& message);
  void AddNote(RunNote note);  // needs mutex_

  Bus& bus_;
  std::string partition_;
  std::atomic<std::uint64_t> run_;
  std::size_t entities_;  // of the space
  ViewRequestMessage requests_;
  Clock::time_point requested_{};

  std::mutex mutex_;  // of what the bus brings
  RunStatus heard_status_;
  bool over_ = false;
  std::vector<RunNote> heard_notes_;
  std::map<std::uint32_t, RobotStatus> heard_robots_;

  RunStatus status_;
  std::vector<RunNote> notes_;
  std::map<std::uint32_t, RobotStatus> robots_;

  std::unique_ptr<Publisher<ViewRequestMessage>> requests_out_;
  std::unique_ptr<Subscription<RunStatusMessage>> statuses_in_;
  std::unique_ptr<Subscription<ControlReplyMessage>> replies_in_;
  std::unique_ptr<Subscription<RobotStatusMessage>> robots_in_;
};

}  // namespace swarmanoid
