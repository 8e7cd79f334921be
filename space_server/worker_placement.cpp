#include "space_server/worker_placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/configuration/wording.h"
#include "common/messages/assignment.h"

namespace swarmanoid
{
namespace
{

constexpr const char* kServer = "space server";
constexpr std::string_view kTo = " to ";

// As HostName, EngineName and RegionName have it: a region is one "ground/2".
std::string WorkerOf(const std::string& verb, const std::string& which)
{
  return verb == "move-host" ? "controller host " + which : fmt::format("engine '{}'", which);
}
std::string RegionOf(const std::string& which)
{
  const std::size_t sign = which.rfind('/');
  return sign == std::string::npos
             ? std::string()
             : fmt::format("region {} of engine '{}'", which.substr(sign + 1), which.substr(0, sign));
}

}  // namespace

WorkerPlacement::WorkerPlacement(std::vector<std::string> machines, const std::vector<std::string>& places)
    : machines_(std::move(machines))
{
  for (const std::string& place : places)
  {
    const std::size_t sign = place.rfind('=');
    if (sign == std::string::npos || sign == 0 || sign + 1 == place.size())
      throw std::invalid_argument(fmt::format("{} is no place; write WORKER=MACHINE", Quoted(place)));
    places_[place.substr(0, sign)] = place.substr(sign + 1);
  }
}

void WorkerPlacement::Put(const Move& move)
{
  if (const auto place = places_.find(move.worker); place != places_.end() && HasMachine(move.machine))
    place->second = move.machine;
}

bool WorkerPlacement::HasMachine(const std::string& machine) const
{
  return std::ranges::find(machines_, machine) != machines_.end();
}

void WorkerPlacement::RequireMachine(const std::string& machine) const
{
  if (HasMachine(machine)) return;
  throw std::invalid_argument(fmt::format(
      "the run has no machine {}; it has {}{}; name others in the file of --hosts, as machines = alpha beta",
      Quoted(machine), Listed(machines_), DidYouMean(machine, machines_)));
}

std::string WorkerPlacement::Text() const
{
  RequireMoves("machines");
  std::map<std::string, std::vector<std::string>> workers;
  for (const auto& [worker, place] : places_) workers[place].push_back(worker);
  std::string text;
  for (const std::string& machine : machines_)
  {
    const std::vector<std::string>& there = workers[machine];
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", machine,
                        there.empty() ? "nobody" : fmt::format("{}", fmt::join(there, ", ")));
  }
  return text;
}

void WorkerPlacement::RequireMoves(const std::string& verb) const
{
  if (places_.empty())
    throw std::invalid_argument(
        fmt::format("{}: no process of this run can be moved: it is one process, nobody is replaced in it, or its "
                    "processes were started by hand",
                    verb));
}

bool WorkerPlacement::ServerMayStartAgain() const
{
  const auto server = places_.find(kServer);
  return server != places_.end() && server->second == kHere;
}

std::vector<std::string> WorkerPlacement::ReadHosts(const ControlRequestMessage& request, std::size_t most) const
{
  RequireMoves(request.verb);
  if (!ServerMayStartAgain())
    throw std::invalid_argument(
        "hosts: all processes start again for it, and the space server cannot: it is on another machine than the "
        "launcher");
  const std::string& machine = request.entity;
  if (!machine.empty()) RequireMachine(machine);
  std::vector<std::string> hosts;
  for (auto place = places_.find(HostName(0)); place != places_.end(); place = places_.find(HostName(hosts.size())))
    hosts.push_back(place->second);
  const double more = request.numbers.size() == 1 ? request.numbers[0] : std::nan("");
  if (more != std::floor(more) || std::abs(more) > 1000)
    throw std::invalid_argument("hosts: write +N or -N, a whole number of controller hosts, or again");
  if (more == 0 && hosts.size() == 1)
    throw std::invalid_argument("hosts again: the run has one controller host, and that has all robots");
  const std::vector<std::string> before = hosts;
  if (static_cast<double>(before.size()) + more > static_cast<double>(most))
    throw std::invalid_argument(fmt::format(
        "hosts: the run has {} controller host{}, and can have {}: as many as robots with a controller, and not more "
        "than 1000",
        before.size(), before.size() == 1 ? "" : "s", most));
  for (double k = 0; k < more; ++k) hosts.push_back(machine.empty() ? kHere : machine);
  for (double k = 0; k < -more; ++k)
  {
    const auto last = machine.empty() ? hosts.rbegin() : std::find(hosts.rbegin(), hosts.rend(), machine);
    if (last == hosts.rend())
      throw std::invalid_argument(fmt::format("hosts: so many controller hosts are not at {}; they are at {}",
                                              Quoted(machine), Listed(before)));
    if (hosts.size() == 1)
      throw std::invalid_argument(fmt::format("hosts: the run has {} controller host{}, and one must remain",
                                              before.size(), before.size() == 1 ? "" : "s"));
    hosts.erase(std::next(last).base());
  }
  return hosts;
}

std::vector<WorkerPlacement::Move> WorkerPlacement::Read(const ControlRequestMessage& request) const
{
  RequireMoves(request.verb);
  if (request.verb == "drain")
  {
    RequireMachine(request.entity);
    return Drain(request.entity);
  }

  std::string which = request.entity;
  std::string machine;
  const auto find = [&](const std::string& worker)
  {
    const auto place = places_.find(WorkerOf(request.verb, worker));
    return place != places_.end() || request.verb != "move-engine" ? place : places_.find(RegionOf(worker));
  };
  auto found = find(which);
  // The machine may be named behind it.
  if (const std::size_t to = which.rfind(kTo); found == places_.end() && to != std::string::npos)
  {
    machine = which.substr(to + kTo.size());
    which.resize(to);
    found = find(which);
  }
  if (found == places_.end())
  {
    std::vector<std::string> workers;
    for (const auto& [worker, place] : places_)
      if (worker != kServer) workers.push_back(worker);
    throw std::invalid_argument(
        fmt::format("the run has no {}; it has {}", WorkerOf(request.verb, which), fmt::join(workers, ", ")));
  }
  if (machine.empty()) machine = found->second;
  RequireMachine(machine);
  return {{found->first, machine}};
}

std::vector<WorkerPlacement::Move> WorkerPlacement::Drain(const std::string& machine) const
{
  if (const auto server = places_.find(kServer); server != places_.end() && server->second == machine)
    throw std::invalid_argument(
        fmt::format("the space server is at {}, and cannot be moved; move the others one by one", Quoted(machine)));
  std::map<std::string, std::size_t> loads;
  for (const std::string& other : machines_)
    if (other != machine) loads[other] = 0;
  if (loads.empty())
    throw std::invalid_argument(
        fmt::format("the workers at {} have nowhere to go: the run has no other machine; name some in the file of "
                    "--hosts, as machines = alpha beta",
                    Quoted(machine)));
  for (const auto& [worker, place] : places_)
    if (const auto load = loads.find(place); load != loads.end()) ++load->second;
  std::vector<Move> moves;
  for (const auto& [worker, place] : places_)
  {
    if (place != machine) continue;
    const auto least = std::ranges::min_element(loads, {}, &std::pair<const std::string, std::size_t>::second);
    ++least->second;
    moves.push_back({worker, least->first});
  }
  return moves;
}

}  // namespace swarmanoid
