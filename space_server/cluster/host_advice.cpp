#include "space_server/cluster/host_advice.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/bus/replica.h"
#include "space_server/space_server.h"
#include "space_server/surroundings.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr auto kFirstLook = 2s;
constexpr auto kBetweenLooks = 10s;
// Less of a difference is not worth a start of all processes.
constexpr double kWorthIt = 1.25;

}  // namespace

HostAdvice::HostAdvice(const ServerSession& session, Lockstep& lockstep, const Experiment& experiment,
                       const Assignment& assignment)
    : session_(session),
      lockstep_(lockstep),
      experiment_(experiment),
      assignment_(assignment),
      next_(Clock::now() + kFirstLook),
      is_over_(!HostsAskForParts(session.World()))
{
}

double HostAdvice::Reach() const
{
  double furthest = 0;
  for (std::size_t h = 0; h < assignment_.hosts.size(); ++h)
  {
    const double reach = session_.ReachOf(HostName(h));
    if (reach < 0) return reach;
    furthest = std::max(furthest, reach);
  }
  return furthest;
}

std::optional<std::string> HostAdvice::Take(Clock::time_point now)
{
  if (is_over_ || now < next_) return std::nullopt;
  const double reach = Reach();
  if (reach < 0)
  {
    is_over_ = true;
    return std::nullopt;
  }
  std::vector<double> poses;
  PoseArrays places;
  const CSwarmanoidSpace* space = nullptr;
  lockstep_.WithServer(
      [&](const SpaceServer& server)
      {
        space = &server.Space();
        space->WritePoses(poses);
        places = space->Poses();
      });
  const Assignment anew =
      MakeAssignment(experiment_, DealRobots(experiment_, static_cast<unsigned>(assignment_.hosts.size()), poses));
  const auto told = static_cast<double>(ToldTogether(*space, places, assignment_.hosts, reach));
  const auto told_anew = static_cast<double>(ToldTogether(*space, places, anew.hosts, reach));
  // It takes its time with large swarms.
  next_ = Clock::now() + std::max<Clock::duration>(kBetweenLooks, 50 * (Clock::now() - now));
  if (told < kWorthIt * told_anew) return std::nullopt;
  is_over_ = true;
  return fmt::format(
      "the robots of the controller hosts have mixed: hosts are told of {:.1f} times as many entities as if the robots "
      "were shared out by where they are now, which `swarmanoid control {} hosts again` does",
      told / told_anew, experiment_.name);
}

}  // namespace swarmanoid
