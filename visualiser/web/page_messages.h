// The text messages between web_render and its pages, as JSON: what is said rarely, beside the frames.
// docs/web_render.md is their specification. Used by web_render alone.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/messages/control_request.h"
#include "visualiser/past_inside.h"
#include "visualiser/playback_reader.h"
#include "visualiser/render.h"
#include "visualiser/scene/viewpoints.h"
#include "visualiser/web/access.h"

namespace swarmanoid
{

// "welcome": whether clients may control the run at all, and the challenge that one who has the token answers then.
// `edits`: there is no run, but an experiment file that is edited.
std::string WelcomeText(bool control_possible, const std::string& challenge, bool edits = false);
// "authority": what the client may do, after its answer.
std::string AuthorityText(Authority authority);
// "world": all that stays: the table of entities, the bodies that are no robots, engines, hosts, controllers,
// viewpoints; whether pages begin at the first of these.
std::string WorldText(const CSwarmanoidSpace& space, const Assignment& assignment, const Viewpoints& viewpoints = {},
                      bool begins_there = false);
// "colours": colours and intensities of lights, patches and all that cannot move, which a frame does not hold.
std::string ColoursText(const CSwarmanoidSpace& space);
// "log": a line for the page's log. level: "info", "warning".
std::string LogText(std::uint64_t tick, const std::string& source, const std::string& level, const std::string& text);
// "status": how the run goes. `clients`: pages that look.
std::string StatusText(const CSwarmanoidSpace& space, const RunStatus& status, std::size_t clients);
// "watched": attributes of entities, and the inside of those that are robots.
std::string WatchedText(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities, RunMonitor* monitor);
// "timeline": the ticks that can be looked at, up to the one before `end`, and what happened. Of many events those that
// are left are told by how many there were.
std::string TimelineText(const std::string& run_folder, std::uint64_t first, std::uint64_t end,
                         std::span<const TimelineEvent> events);
// "past": of the tick that is looked back at: attributes of entities, and colours as "colours" has them.
std::string PastText(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities);
// "past_inside": the inside of robots at a tick of the past, or in "error" why it cannot be computed.
std::string PastInsideText(const PastInsideAnswer& answer);
// "reply": what became of a request that was refused.
std::string RefusalText(const std::string& text);

// What a page asks for.
struct WatchRequest
{
  std::vector<std::uint32_t> entities;  // whose details it wants
};
// Its answer to the challenge.
struct ProveRequest
{
  std::string proof;
};
// The entities of which it shows more than their bodies (MarksWriter).
struct MarksRequest
{
  std::vector<std::uint32_t> rays, bodies, links;
};
struct FrameRateRequest
{
  unsigned period_ms = 0;  // between two frames; 0: as they come
};
// A ControlOrder is a request about the run, which only pages with control may make.
using PageRequest =
    std::variant<WatchRequest, LookBackRequest, FrameRateRequest, ProveRequest, MarksRequest, ControlOrder>;

inline constexpr std::size_t kMostWatched = 16;   // entities, of one page
inline constexpr std::size_t kMostMarked = 1000;  // likewise, of each kind of mark

// Throws std::invalid_argument, with a text for the user, for anything else than a request.
PageRequest ParseRequest(std::string_view text);
}  // namespace swarmanoid
