// web_render: serves a page that shows the experiment in a browser. Draw only passes on the content that pages have
// requested. The server's thread sends it, so Draw never waits for a page.
#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/space/drawn_state.h"
#include "visualiser/playback_reader.h"
#include "visualiser/render.h"
#include "visualiser/web/drawn_links.h"
#include "visualiser/web/log_follower.h"
#include "visualiser/web/marks.h"
#include "visualiser/web/page_messages.h"
#include "visualiser/web/page_server.h"
#include "visualiser/web/state_frame.h"

namespace swarmanoid
{

class CWebRender : public CRender, private WebServerEvents
{
public:
  CWebRender() = default;
  ~CWebRender() override;
  void Init(const RenderSetup& setup) override;
  void Draw() override;
  void Idle() override;
  void Finish() override;
  // Returns true after the end of the run, once the page has been shown for long enough.
  bool Terminate() override;
  bool IsInteractive() const override { return true; }

private:
  using Clock = std::chrono::steady_clock;

  struct Request
  {
    std::uint64_t client = 0;
    std::optional<PageRequest> request;  // nullopt: the client has left
  };

  // These functions are called in the server's thread.
  std::string Welcome(std::uint64_t client) override;
  void Received(std::uint64_t client, std::string_view text) override;
  void Left(std::uint64_t client) override;

  void Announce(const RenderSetup& setup);
  void Work();
  void TakeRequests();
  void Carry(std::uint64_t client, const PageRequest& request);
  void SendFrame();
  void SendStatus();
  void SendWatched();
  void SendMarks();
  void SendDrawing();
  void SendNotes();
  void FollowStatus();
  void FollowJournal();
  void SendPast(std::uint64_t client, const LookBackRequest& request, const CSwarmanoidSpace& space);
  void WatchRobots();
  void Branch(std::uint64_t client, std::uint64_t tick);
  void Log(std::uint64_t tick, const std::string& source, const std::string& level, const std::string& text);

  const CSwarmanoidSpace* space_ = nullptr;
  ExperimentControl* control_ = nullptr;
  RunMonitor* monitor_ = nullptr;
  bool allow_control_ = false;
  double linger_s_ = -1;
  Clock::duration frame_period_{};
  double bytes_per_second_ = 0;  // for states, to each page
  std::size_t sent_bytes_ = 0;   // bytes of the last state
  int changes_ = 0;              // since the last key
  std::unique_ptr<FrameWriter> frame_writer_;
  std::unique_ptr<LogFollower> logs_;

  Clock::time_point frame_due_, status_due_, watched_due_, marks_due_, drawing_due_, followed_due_;
  std::uint64_t shown_revision_ = 0, shown_attributes_ = 0, shown_tick_ = ~0ULL;
  std::uint64_t colours_revision_ = 0;
  std::string colours_;
  std::optional<Clock::time_point> ended_;
  std::size_t notes_shown_ = 0;
  std::string last_note_;
  std::map<std::string, std::string> troubles_;  // by process: the last message about its delay

  std::map<std::uint64_t, MarksRequest> marked_;  // by client
  std::unique_ptr<MarksWriter> marks_writer_;     // once a page has asked for marks
  std::uint64_t drawing_revision_ = 1;            // the revision that pages have; at first they have none
  std::uint64_t drawn_fields_ = 1;                // the revision of the floor fields that pages have
  std::uint64_t drawing_poses_ = 0;
  std::unique_ptr<DrawnState> drawn_state_;
  std::unique_ptr<DrawnLinks> drawn_links_;
  std::uint64_t drawn_tick_ = ~0ULL;
  std::uint64_t marked_revision_ = 0, marked_attributes_ = 0;

  std::map<std::uint64_t, std::vector<std::uint32_t>> watched_;  // by client
  std::mutex mutex_;                                             // guards requests_
  std::vector<Request> requests_;
  std::atomic<bool> has_requests_{false};  // read without the mutex

  std::unique_ptr<PageServer> host_;           // its server's thread uses the members above
  std::unique_ptr<FrameWriter> past_frames_;   // only for the thread of look_back_
  std::unique_ptr<PlaybackReader> look_back_;  // these two are last, since their threads call the server
  std::unique_ptr<RobotPlayback> robot_playback_;
  std::string output_folder_;
  std::unique_ptr<RunBranches> branches_;  // once a page has started a run
};

}  // namespace swarmanoid
