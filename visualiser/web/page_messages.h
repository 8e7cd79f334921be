// The text messages between web_render and its pages, as JSON: those that are rarer than frames. docs/web_render.md
// specifies them. Only web_render uses it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "visualiser/past_inside.h"
#include "visualiser/playback_reader.h"
#include "visualiser/render.h"
#include "visualiser/scene/viewpoints.h"
#include "visualiser/web/access.h"

namespace swarmanoid
{

// Returns "welcome": whether clients may control the run at all, and the challenge for holders of the token. `edits`:
// the server edits an experiment file instead of showing a run.
std::string WelcomeText(bool control_possible, const std::string& challenge, bool edits = false);
// Returns "authority": the rights of the client, after its answer.
std::string AuthorityText(Authority authority);
// Returns "world", the fixed content: the table of entities, the bodies that are no robots, engines, hosts, controllers
// and viewpoints. It also states whether pages begin at the first viewpoint.
std::string WorldText(const CSwarmanoidSpace& space, const Assignment& assignment, const Viewpoints& viewpoints = {},
                      bool begins_there = false);
// Returns "colours": colours and intensities of lights, patches and all static entities, which frames do not contain.
std::string ColoursText(const CSwarmanoidSpace& space);
// Returns "log": a line for the page's log. `level`: "info", "warning".
std::string LogText(std::uint64_t tick, const std::string& source, const std::string& level, const std::string& text);
// Returns "status": the status of the run. `clients`: the number of pages.
std::string StatusText(const CSwarmanoidSpace& space, const RunStatus& status, std::size_t clients);
// Returns "watched": attributes of entities, and the status of the robots among them.
std::string WatchedText(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities, RunMonitor* monitor);
// Returns "timeline": the ticks that can be shown, up to the one before `end`, and the events. If there are many
// events, only some are listed, with their total number.
std::string TimelineText(const std::string& run_folder, std::uint64_t first, std::uint64_t end,
                         std::span<const TimelineEvent> events);
// Returns "past", for the requested tick: attributes of entities, and colours as in "colours".
std::string PastText(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities);
// Returns "past_inside": the status of robots at a tick of the past, or in "error" why it cannot be computed.
std::string PastInsideText(const PastInsideAnswer& answer);
// Returns "reply": the reason for a refused request.
std::string RefusalText(const std::string& text);

// A page's request.
struct WatchRequest
{
  std::vector<std::uint32_t> entities;  // the entities whose details it wants
};
// A page's answer to the challenge.
struct ProveRequest
{
  std::string proof;
};
// The entities for which the page shows marks (MarksWriter).
struct MarksRequest
{
  std::vector<std::uint32_t> rays, bodies, links;
};
struct FrameRateRequest
{
  unsigned period_ms = 0;  // between two frames; 0: every frame
};
struct PauseRequest
{
};
struct ResumeRequest
{
};
struct StepRequest
{
  unsigned ticks = 1;
};
struct SpeedRequest
{
  double factor = 0;
};
struct MoveEntityRequest
{
  std::string entity;
  Pose pose;
};
struct AddEntityRequest
{
  std::string entity;  // or its reserve
  Pose pose;
};
struct RemoveEntityRequest
{
  std::string entity;
};
// Input for experiment functions.
struct KeyRequest
{
  std::string key;
  bool pressed = true;
};
struct SelectRequest
{
  std::string entity;  // empty: none
};
struct StopRequest
{
};
struct ResetRunRequest
{
};
using PageRequest =
    std::variant<WatchRequest, LookBackRequest, FrameRateRequest, ProveRequest, MarksRequest, PauseRequest,
                 ResumeRequest, StepRequest, SpeedRequest, MoveEntityRequest, AddEntityRequest, RemoveEntityRequest,
                 KeyRequest, SelectRequest, StopRequest, ResetRunRequest>;

inline constexpr std::size_t kMostWatched = 16;   // the most entities for one page
inline constexpr std::size_t kMostMarked = 1000;  // the same, for each kind of mark

// Throws std::invalid_argument with a text for the user if the text is no request.
PageRequest ParseRequest(std::string_view text);
// Returns whether the request changes the experiment.
bool IsCommand(const PageRequest& request);
// Passes a command to the run; does nothing for other requests.
void Obey(const PageRequest& request, ExperimentControl& control);

}  // namespace swarmanoid
