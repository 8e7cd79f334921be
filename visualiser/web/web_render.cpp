// The thread of the run calls Work() in each tick, so it must cost nothing if nothing is due: every kind of message has
// a time at which it is due next, and a fast run only reads the clock. Frames, marks and drawings wait longer if their
// bytes would take more than the bandwidth, marks and drawings also if their making takes more than a twentieth of the
// time. A frame is a change since the last key, or a key after 19 changes, so a page that comes late can begin at once,
// and a slow page may miss changes.
//
// Requests of pages arrive in the server's thread. They wait in `requests_` (guarded by `mutex_`, 1,024 at most) until
// the run takes them, because the space and the run's control belong to its thread. Commands are refused in the
// server's thread already, unless the page has proved that it holds the token.
#include "visualiser/web/web_render.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "common/errors/print_error.h"
#include "common/space/space.h"
#include "visualiser/renderer_library.h"
#include "visualiser/web/drawing_frame.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr auto kStatusPeriod = 250ms;
constexpr auto kWatchedPeriod = 100ms;
constexpr auto kFollowPeriod = 250ms;
constexpr auto kMarksPeriod = 100ms;
constexpr auto kDrawingPeriod = 33ms;
constexpr int kMarksShare = 20;              // marks take at most this part of the time …
constexpr double kMarksBandwidthShare = 4;   // … and of the bandwidth of a page
constexpr std::size_t kMostRequests = 1024;  // limit of requests that wait for the next tick
constexpr std::size_t kNotesKept = 100;      // the number that RunMonitor keeps
constexpr double kLate_s = 1;
constexpr int kChangesOfAKey = 19;  // before the whole state is sent again

WebServer::Bytes Shared(std::string text) { return std::make_shared<const std::string>(std::move(text)); }

std::string NoteKey(const RunNote& note) { return fmt::format("{} {} {}", note.tick, note.from, note.text); }

// Only the user may read the file, since the address may hold the token.
void WriteUrl(const std::string& path, const std::string& url)
{
  unlink(path.c_str());
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  const std::string line = url + "\n";
  if (file < 0 || write(file, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
    throw std::runtime_error("web_render: cannot write '" + path + "': " + std::strerror(errno));
  close(file);
}

}  // namespace

CWebRender::~CWebRender() = default;

void CWebRender::Init(const RenderSetup& setup)
{
  const Parameters& parameters = setup.parameters;
  space_ = &setup.space;
  drawn_state_ = std::make_unique<DrawnState>(*space_);
  drawn_links_ = std::make_unique<DrawnLinks>(*space_);
  control_ = setup.control;
  monitor_ = setup.monitor;
  linger_s_ = parameters.Number("linger");
  allow_control_ = parameters.Boolean("allow_control");
  frame_period_ =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / parameters.Number("rate")));
  bytes_per_second_ = 1e6 * parameters.Number("bandwidth");
  frame_writer_ = std::make_unique<FrameWriter>(*space_);
  logs_ = std::make_unique<LogFollower>(setup.output_folder);
  output_folder_ = setup.output_folder;

  const Experiment& experiment = space_->GetExperiment();
  host_ = std::make_unique<PageServer>(parameters, experiment.folder + "/" + experiment.name);
  host_->Open(*this);
  if (!host_->Trouble().empty())
    Log(space_->GetTick(), "web_render", "info", "the next start will have another address: " + host_->Trouble());
  const Viewpoints given(parameters);
  const bool begins_there = given.First().has_value();
  host_->Server().SetGreeting(
      Shared(WorldText(*space_, setup.assignment, begins_there ? given : Viewpoints::Of(experiment), begins_there)));
  Log(space_->GetTick(), "run", "info",
      fmt::format("{}: {} entities, {} engine{}, {} controller host{}, seed {}", experiment.name, space_->Size(),
                  experiment.engines.size(), experiment.engines.size() == 1 ? "" : "s", setup.assignment.hosts.size(),
                  setup.assignment.hosts.size() == 1 ? "" : "s", experiment.seed));
  Announce(setup);
}

void CWebRender::Announce(const RenderSetup& setup)
{
  const std::string url = host_->Url();
  const std::filesystem::path folder = setup.output_folder;
  if (!setup.parameters.Text("url_file").empty())
    WriteUrl(setup.MakeOutputFile("url_file"), url);
  else if (std::filesystem::exists(folder / "manifest.json"))
    WriteUrl((folder / "web_render.url").string(), url);
  fmt::print("web_render: {}\n", url);
  std::fflush(stdout);
  if (!host_->Fingerprint().empty())
  {
    // The text goes to standard error, since standard output has the address alone.
    fmt::print(stderr, "web_render: certificate SHA-256 {}\n", host_->Fingerprint());
    Log(space_->GetTick(), "web_render", "info", "certificate SHA-256 " + host_->Fingerprint());
  }
  const std::string warning = host_->Warning();
  if (warning.empty()) return;
  PrintError("web_render: warning: {}\n", warning);
  Log(space_->GetTick(), "web_render", "warning", warning);
}

void CWebRender::Draw() { Work(); }

void CWebRender::Idle() { Work(); }

void CWebRender::Finish()
{
  FollowStatus();
  SendFrame();
  SendDrawing();
  SendWatched();
  SendStatus();
}

bool CWebRender::Terminate()
{
  return ended_ && linger_s_ >= 0 && Clock::now() - *ended_ >= std::chrono::duration<double>(linger_s_);
}

// A fast run calls it every tick, so it only reads the clock unless something is due.
void CWebRender::Work()
{
  if (has_requests_) TakeRequests();
  const Clock::time_point now = Clock::now();
  if (now >= followed_due_)
  {
    followed_due_ = now + kFollowPeriod;
    FollowStatus();
    FollowJournal();
    if (branches_) branches_->Look();
  }
  if (host_->Server().Clients() == 0) return;
  const bool changed = shown_tick_ != space_->GetTick() || shown_revision_ != space_->Revision() ||
                       shown_attributes_ != space_->AttributeRevision();
  if (changed && now >= frame_due_ && host_->Server().Hungry() > 0)
  {
    SendFrame();
    // The schedule follows the clock, so that the rate is met on average, without catching up after a break.
    const std::chrono::duration<double> transfer(static_cast<double>(sent_bytes_) / bytes_per_second_);
    frame_due_ =
        std::max(frame_due_ + std::max(frame_period_, std::chrono::duration_cast<Clock::duration>(transfer)), now);
  }
  if (now >= watched_due_)
  {
    watched_due_ = now + kWatchedPeriod;
    SendWatched();
  }
  if (now >= marks_due_) SendMarks();
  if (now >= drawing_due_) SendDrawing();
  if (now >= status_due_)
  {
    status_due_ = now + kStatusPeriod;
    SendStatus();
  }
}

void CWebRender::SendFrame()
{
  shown_tick_ = space_->GetTick();
  shown_revision_ = space_->Revision();
  shown_attributes_ = space_->AttributeRevision();
  std::string change = changes_ < kChangesOfAKey ? frame_writer_->WriteChange() : std::string();
  const bool key = change.empty();
  changes_ = key ? 0 : changes_ + 1;
  const WebServer::Bytes bytes = Shared(key ? frame_writer_->WriteKey() : std::move(change));
  sent_bytes_ = bytes->size();
  host_->Server().Publish(key ? WebServer::Slot::kKey : WebServer::Slot::kChange, bytes);
}

void CWebRender::SendStatus()
{
  host_->Server().Publish(
      WebServer::Slot::kStatus,
      Shared(StatusText(*space_, monitor_ == nullptr ? RunStatus() : monitor_->Status(), host_->Server().Clients())));
  if (colours_revision_ == space_->AttributeRevision()) return;
  colours_revision_ = space_->AttributeRevision();
  std::string colours = ColoursText(*space_);
  if (colours == colours_) return;
  colours_ = std::move(colours);
  host_->Server().Publish(WebServer::Slot::kColours, Shared(colours_));
}

void CWebRender::SendWatched()
{
  for (const auto& [client, entities] : watched_)
    if (!entities.empty())
      host_->Server().SendState(client, WebServer::Slot::kWatched, Shared(WatchedText(*space_, entities, monitor_)));
}

// Marks of many robots take long, and are then sent less often.
void CWebRender::SendMarks()
{
  const Clock::time_point start = Clock::now();
  marks_due_ = start + kMarksPeriod;
  if (marked_.empty() || (marked_revision_ == space_->Revision() && marked_attributes_ == space_->AttributeRevision()))
    return;
  marked_revision_ = space_->Revision();
  marked_attributes_ = space_->AttributeRevision();
  if (!marks_writer_) marks_writer_ = std::make_unique<MarksWriter>(*space_);
  std::size_t bytes = 0;
  for (const auto& [client, request] : marked_)
  {
    const WebServer::Bytes text = Shared(marks_writer_->Text(request));
    bytes = std::max(bytes, text->size());
    host_->Server().SendState(client, WebServer::Slot::kMarks, text);
  }
  const Clock::time_point end = Clock::now();
  const std::chrono::duration<double> transfer(kMarksBandwidthShare * static_cast<double>(bytes) / bytes_per_second_);
  marks_due_ = std::max(
      {marks_due_, end + kMarksShare * (end - start), start + std::chrono::duration_cast<Clock::duration>(transfer)});
}

// Sends only changes. Drawings in the frames of entities move with them.
void CWebRender::SendDrawing()
{
  const Clock::time_point start = Clock::now();
  drawing_due_ = start + kDrawingPeriod;
  const bool is_empty = space_->GetDrawing().IsEmpty();
  if (drawing_revision_ == space_->DrawingRevision() && drawn_fields_ == space_->Fields().Revision() &&
      (is_empty || drawing_poses_ == space_->Revision()) &&
      (!(drawn_state_->Changes() || drawn_links_->AreThere()) || drawn_tick_ == space_->GetTick()))
    return;
  drawing_revision_ = space_->DrawingRevision();
  drawn_fields_ = space_->Fields().Revision();
  drawing_poses_ = space_->Revision();
  drawn_tick_ = space_->GetTick();
  const WebServer::Bytes bytes = Shared(DrawingBytes(*drawn_state_, drawn_links_.get()));
  host_->Server().Publish(WebServer::Slot::kDrawing, bytes);
  const std::chrono::duration<double> transfer(static_cast<double>(bytes->size()) / bytes_per_second_);
  drawing_due_ = std::max({drawing_due_, Clock::now() + kMarksShare * (Clock::now() - start),
                           start + std::chrono::duration_cast<Clock::duration>(transfer)});
}

// Writes lines of the log: output of processes, the end of the run, delays, and users' actions.
void CWebRender::FollowStatus()
{
  logs_->Read([this](const std::string& process, const std::string& line)
              { Log(space_->GetTick(), process, "info", line); });
  if (monitor_ == nullptr) return;
  const RunStatus& status = monitor_->Status();
  if (status.phase == RunStatus::Phase::kFinished && !ended_)
  {
    ended_ = Clock::now();
    Log(status.tick, "run", status.ended.empty() ? "info" : "warning",
        "the run has ended" + (status.ended.empty() ? "" : ": " + status.ended));
  }
  for (const ProcessStatus& process : status.processes)
  {
    const bool late = process.late_s >= kLate_s;
    std::string trouble = !late                   ? ""
                          : process.doing.empty() ? "the run waits for it"
                                                  : "the run waits for it: " + process.doing;
    std::string& known = troubles_[process.name];
    if (trouble == known) continue;
    Log(status.tick, process.name, late ? "warning" : "info", late ? trouble : "in time again");
    known = std::move(trouble);
  }
  SendNotes();
}

// Looks for a journal of the run that this process can read. Its next start has another one.
void CWebRender::FollowJournal()
{
  const std::string folder = RunFolderOf(output_folder_, monitor_);
  if (!folder.empty() && (!look_back_ || look_back_->RunFolder() != folder))
  {
    robot_playback_.reset();
    look_back_.reset();
    past_frames_.reset();
    look_back_ = std::make_unique<PlaybackReader>(
        space_->GetExperiment(), folder,
        LookBackAnswers{[this, folder](const JournalTimeline& timeline)
                        {
                          host_->Server().Publish(
                              WebServer::Slot::kTimeline,
                              Shared(TimelineText(folder, timeline.first, timeline.end, timeline.events)));
                        },
                        [this](std::uint64_t client, const LookBackRequest& request, const CSwarmanoidSpace& space)
                        { SendPast(client, request, space); },
                        [this](std::uint64_t client, const std::string& text)
                        { host_->Server().Send(client, Shared(RefusalText(text))); }});
    robot_playback_ = std::make_unique<RobotPlayback>(
        space_->GetExperiment(), folder,
        [this](std::uint64_t client, const RobotPlaybackAnswer& answer)
        { host_->Server().SendState(client, WebServer::Slot::kRobotPlayback, Shared(RobotPlaybackText(answer))); });
  }
  if (look_back_ && host_->Server().Clients() > 0) look_back_->Refresh();
}

// This function is called in the thread of PlaybackReader.
void CWebRender::SendPast(std::uint64_t client, const LookBackRequest& request, const CSwarmanoidSpace& space)
{
  if (!past_frames_) past_frames_ = std::make_unique<FrameWriter>(space);
  std::string state = past_frames_->WriteKey();
  std::memcpy(state.data(), &kPastMagic, sizeof kPastMagic);
  host_->Server().SendState(client, WebServer::Slot::kPastDetails, Shared(PastText(space, request.entities)));
  host_->Server().SendState(client, WebServer::Slot::kPast, Shared(std::move(state)));
}

// The monitor keeps the last hundred notes. The new ones are those after the last one that was shown.
void CWebRender::SendNotes()
{
  const std::span<const RunNote> notes = monitor_->Notes();
  std::size_t first = std::min(notes_shown_, notes.size());
  if (notes.size() >= kNotesKept && notes_shown_ >= kNotesKept)
  {
    first = notes.size();
    while (first > 0 && NoteKey(notes[first - 1]) != last_note_) --first;
  }
  for (; first < notes.size(); ++first)
    Log(notes[first].tick, notes[first].from.empty() ? "control" : notes[first].from,
        notes[first].done ? "info" : "warning", notes[first].text);
  notes_shown_ = notes.size();
  if (!notes.empty()) last_note_ = NoteKey(notes.back());
}

// The next functions handle the requests of pages.

std::string CWebRender::Welcome(std::uint64_t client)
{
  return WelcomeText(allow_control_, host_->GetVisitors().Join(client));
}

void CWebRender::Received(std::uint64_t client, std::string_view text)
{
  try
  {
    PageRequest request = ParseRequest(text);
    if (const auto* answer = std::get_if<ProveRequest>(&request))
      return host_->Server().Send(client, Shared(AuthorityText(host_->Prove(client, answer->proof))));
    const bool steers =
        std::holds_alternative<ControlOrder>(request) || std::holds_alternative<StartBranchRequest>(request);
    if (steers && !host_->GetVisitors().MayControl(client))
      throw std::invalid_argument(allow_control_ ? "only the address with the token may control the run"
                                                 : "this page may only look: start it with --allow-control");
    if (const auto* rate = std::get_if<FrameRateRequest>(&request))
      host_->Server().SetFramePeriod(client, rate->period_ms);
    const std::lock_guard lock(mutex_);
    if (requests_.size() >= kMostRequests) throw std::invalid_argument("too many requests at once");
    requests_.push_back({client, std::move(request)});
    has_requests_ = true;
  }
  catch (const std::invalid_argument& error)
  {
    host_->Server().Send(client, Shared(RefusalText(error.what())));
  }
}

void CWebRender::Left(std::uint64_t client)
{
  host_->GetVisitors().Leave(client);
  const std::lock_guard lock(mutex_);
  requests_.push_back({client, std::nullopt});
  has_requests_ = true;
}

void CWebRender::TakeRequests()
{
  std::vector<Request> requests;
  {
    const std::lock_guard lock(mutex_);
    requests.swap(requests_);
    has_requests_ = false;
  }
  for (const Request& request : requests)
    if (request.request)
      Carry(request.client, *request.request);
    else
    {
      watched_.erase(request.client);
      marked_.erase(request.client);
      if (look_back_) look_back_->Forget(request.client);
      if (robot_playback_) robot_playback_->Forget(request.client);
      WatchRobots();
    }
}

void CWebRender::WatchRobots()
{
  if (monitor_ == nullptr) return;
  std::vector<std::uint32_t> robots;
  for (const auto& [client, entities] : watched_) robots.insert(robots.end(), entities.begin(), entities.end());
  std::sort(robots.begin(), robots.end());
  robots.erase(std::unique(robots.begin(), robots.end()), robots.end());
  monitor_->Watch(robots);
}

void CWebRender::Carry(std::uint64_t client, const PageRequest& request)
{
  if (const auto* watch = std::get_if<WatchRequest>(&request))
  {
    std::vector<std::uint32_t>& entities = watched_[client];
    entities.clear();
    for (const std::uint32_t entity : watch->entities)
      if (entity < space_->Size()) entities.push_back(entity);
    WatchRobots();
    watched_due_ = {};
    return;
  }
  if (const auto* marks = std::get_if<MarksRequest>(&request))
  {
    if (marks->rays.empty() && marks->bodies.empty() && marks->links.empty())
      marked_.erase(client);
    else
      marked_[client] = *marks;
    marked_revision_ = ~0ULL;
    return;
  }
  const auto* past = std::get_if<LookBackRequest>(&request);
  const auto* earlier = std::get_if<EarlierRequest>(&request);
  if (past != nullptr || earlier != nullptr)
  {
    if (look_back_)
    {
      look_back_->Ask(client, past != nullptr ? *past : earlier->look_back);
      if (past != nullptr) robot_playback_->Ask(client, *past);
    }
    else
      host_->Server().Send(client,
                           Shared(RefusalText("there is nothing to look back at: the run keeps no journal here")));
    return;
  }
  if (const auto* branch = std::get_if<StartBranchRequest>(&request)) return Branch(client, branch->tick);
  const auto* order = std::get_if<ControlOrder>(&request);
  if (order == nullptr) return;
  if (control_ == nullptr)
  {
    host_->Server().Send(client, Shared(RefusalText("this run cannot be controlled")));
    return;
  }
  control_->Ask(*order);
  followed_due_ = status_due_ = {};
}

void CWebRender::Branch(std::uint64_t client, std::uint64_t tick)
{
  if (!look_back_)
    return host_->Server().Send(client,
                                Shared(RefusalText("no run can start from here: this one keeps no journal here")));
  const std::string& folder = look_back_->RunFolder();
  if (!branches_ || branches_->RunFolder() != folder)
    branches_ = std::make_unique<RunBranches>(CommandFor(folder), folder,
                                              [this](std::uint64_t asker, const RunBranches::Answer& answer)
                                              { host_->Server().Send(asker, Shared(BranchedText(answer))); });
  branches_->Start(client, tick);
}

void CWebRender::Log(std::uint64_t tick, const std::string& source, const std::string& level, const std::string& text)
{
  host_->Server().SendAll(Shared(LogText(tick, source, level, text)));
}

}  // namespace swarmanoid

EXPORT_RENDERER(swarmanoid::CWebRender)
