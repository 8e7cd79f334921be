// The text messages between web_render and its pages, as JSON, for everything beside the frames. docs/web_render.md
// specifies them. Only web_render uses them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "idl/control_request_message.h"
#include "visualiser/playback_reader.h"
#include "visualiser/render.h"
#include "visualiser/robot_playback.h"
#include "visualiser/scene/viewpoints.h"
#include "visualiser/web/access.h"
#include "visualiser/web/run_branches.h"

namespace swarmanoid
{

// Returns the message "welcome": whether clients may control the run at all, and the challenge, which a holder of the
// token answers. If `edits` is true, an experiment file is edited, without a run.
std::string WelcomeText(bool control_possible, const std::string& challenge, bool edits = false);
// Returns the message "authority": what the client may do, after its answer.
std::string AuthorityText(Authority authority);
// Returns the message "world" with everything that never changes: the table of entities, all bodies except robots,
// engines, hosts, controllers and viewpoints. `begins_there` says whether pages begin at the first viewpoint.
std::string WorldText(const CSwarmanoidSpace& space, const Assignment& assignment, const Viewpoints& viewpoints = {},
                      bool begins_there = false);
// Returns the message "colours": colours and intensities of lights, patches and entities that cannot move, which a
// frame does not have.
std::string ColoursText(const CSwarmanoidSpace& space);
// Returns the message "log": a line for the page's log. `level` is "info" or "warning".
std::string LogText(std::uint64_t tick, const std::string& source, const std::string& level, const std::string& text);
// Returns the message "status" of the run. `clients` is the number of connected pages.
std::string StatusText(const CSwarmanoidSpace& space, const RunStatus& status, std::size_t clients);
// Returns the message "watched": the attributes of entities, and the readings and states of robots among them.
std::string WatchedText(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities, RunMonitor* monitor);
// Returns the message "timeline": the ticks that can be shown, up to the one before `end`, and the events. If there are
// too many events, some are left out, and the message has their number.
std::string TimelineText(const std::string& run_folder, std::uint64_t first, std::uint64_t end,
                         std::span<const TimelineEvent> events);
// Returns the message "past" for the shown tick of the past: attributes of entities, and colours as in "colours".
std::string PastText(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities);
// Returns the message "past_inside": the status of robots at a tick of the past, or in "error" why it cannot be
// computed.
std::string RobotPlaybackText(const RobotPlaybackAnswer& answer);
// Returns the message "branched": the address of the page of a run that a page has started, or why there is none.
std::string BranchedText(const RunBranches::Answer& answer);
// Returns the message "reply" for a request that was refused.
std::string RefusalText(const std::string& text);

// The entities whose details a page requests.
struct WatchRequest
{
  std::vector<std::uint32_t> entities;  // whose details it wants
};
// A page's answer to the challenge.
struct ProveRequest
{
  std::string proof;
};
// The entities of which a page shows marks (MarksWriter).
struct MarksRequest
{
  std::vector<std::uint32_t> rays, bodies, links;
};
// Starts a new run from a tick of the journal. Only pages with control may do so.
struct StartBranchRequest
{
  std::uint64_t tick = 0;
};
struct FrameRateRequest
{
  unsigned period_ms = 0;  // between two frames; 0: as they come
};
// A tick before the shown one, for trails and plots. The inside of robots is not computed there.
struct EarlierRequest
{
  LookBackRequest look_back;
};
// A ControlOrder is a request about the run, which only pages with control may make.
using PageRequest = std::variant<WatchRequest, LookBackRequest, EarlierRequest, StartBranchRequest, FrameRateRequest,
                                 ProveRequest, MarksRequest, ControlOrder>;

inline constexpr std::size_t kMostWatched = 16;   // entities, of one page
inline constexpr std::size_t kMostMarked = 1000;  // entities, of each kind of mark

// Throws std::invalid_argument, with a text for the user, for anything else than a request.
PageRequest ParseRequest(std::string_view text);
}  // namespace swarmanoid
