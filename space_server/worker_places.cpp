#include "space_server/worker_places.h"

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
constexpr std::string_view kVisualiser = "visualiser ";  // as VisualiserName has it

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

WorkerPlaces::WorkerPlaces(std::vector<std::string> machines, const std::vector<std::string>& places)
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

void WorkerPlaces::Put(const Move& move)
{
  if (const auto place = places_.find(move.worker); place != places_.end() && !move.machine.empty())
    place->second = move.machine;
}

void WorkerPlaces::RequireMachine(const std::string& machine) const
{
  if (std::ranges::find(machines_, machine) != machines_.end()) return;
  if (std::ranges::find(places_, machine, &std::pair<const std::string, std::string>::second) != places_.end())
    throw std::invalid_argument(
        fmt::format("machine {} is not offered now: it was not heard again yet since all processes started, or it has "
                    "gone and its workers are about to be replaced; ask again in a moment",
                    Quoted(machine)));
  throw std::invalid_argument(fmt::format(
      "the run has no machine {}; it has {}{}; name others in the file of --hosts, as machines = alpha beta, or "
      "offer one: controller_host --offer NAME",
      Quoted(machine), Listed(machines_), DidYouMean(machine, machines_)));
}

bool WorkerPlaces::Offer(const std::string& machine, const std::string& process)
{
  RequireMoves("offer");
  if (const std::string mistake = MachineNameMistake(machine); !mistake.empty())
    throw std::invalid_argument(fmt::format("offer: {} is no name of a machine; {}", Quoted(machine), mistake));
  const auto offer = offers_.find(machine);
  if (offer != offers_.end() && offer->second == process) return false;
  if (offer != offers_.end())
    throw std::invalid_argument(fmt::format("machine {} is offered already, by process {}; offer it under another name",
                                            Quoted(machine), offer->second));
  if (std::find(machines_.begin(), machines_.end(), machine) != machines_.end())
    throw std::invalid_argument(
        fmt::format("the run has a machine {} already, which it reaches by itself; offer this one under another name",
                    Quoted(machine)));
  machines_.push_back(machine);
  offers_[machine] = process;
  return true;
}

std::vector<WorkerPlaces::Move> WorkerPlaces::Withdraw(const std::string& machine, const std::string& process)
{
  // Or nobody does, since the space server that knew has died.
  if (const auto offer = offers_.find(machine); offer != offers_.end() && offer->second != process)
    throw std::invalid_argument(fmt::format("machine {} is offered by process {}", Quoted(machine), offer->second));
  std::vector<Move> moves = Drain(machine);
  Gone(process);
  return moves;
}

std::optional<std::string> WorkerPlaces::Gone(const std::string& process)
{
  const auto offer = std::find_if(offers_.begin(), offers_.end(), [&](const auto& o) { return o.second == process; });
  if (offer == offers_.end()) return std::nullopt;
  std::string machine = offer->first;
  std::erase(machines_, machine);
  offers_.erase(offer);
  return machine;
}

std::string WorkerPlaces::Text() const
{
  RequireMoves("machines");
  std::map<std::string, std::vector<std::string>> workers;
  for (const auto& [worker, place] : places_) workers[place].push_back(worker);
  std::string text;
  const auto add = [&](const std::string& machine, const std::string& remark)
  {
    const std::vector<std::string>& there = workers[machine];
    text += fmt::format("{}{}{}: {}", text.empty() ? "" : "; ", machine, remark,
                        there.empty() ? "nobody" : fmt::format("{}", fmt::join(there, ", ")));
  };
  for (const std::string& machine : machines_)
  {
    const auto offer = offers_.find(machine);
    add(machine, offer == offers_.end() ? "" : " (offered by " + offer->second + ")");
    workers.erase(machine);
  }
  for (const auto& [machine, there] : workers) add(machine, " (not offered now)");
  return text;
}

std::string WorkerPlaces::ForNewHost(const std::vector<std::string>& hosts) const
{
  std::string best = kHere;
  std::optional<std::ptrdiff_t> fewest;
  for (const auto& [machine, process] : offers_)
    if (const auto count = std::count(hosts.begin(), hosts.end(), machine); !fewest || count < *fewest)
    {
      best = machine;
      fewest = count;
    }
  return best;
}

void WorkerPlaces::RequireMoves(const std::string& verb) const
{
  if (places_.empty())
    throw std::invalid_argument(
        fmt::format("{}: no process of this run can be moved: it is one process, nobody is replaced in it, or its "
                    "processes were started by hand",
                    verb));
}

bool WorkerPlaces::ServerMayStartAgain() const
{
  const auto server = places_.find(kServer);
  return server != places_.end() && server->second == kHere;
}

std::vector<std::string> WorkerPlaces::ReadHosts(const ControlRequestMessage& request, std::size_t most) const
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
  for (double k = 0; k < more; ++k) hosts.push_back(machine.empty() ? ForNewHost(hosts) : machine);
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

std::vector<WorkerPlaces::Move> WorkerPlaces::Read(const ControlRequestMessage& request) const
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

std::vector<WorkerPlaces::Move> WorkerPlaces::Drain(const std::string& machine) const
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
    const bool writes_files = worker.starts_with(kVisualiser);  // in the folder of the run
    auto least = loads.end();
    for (auto load = loads.begin(); load != loads.end(); ++load)
      if ((!writes_files || !offers_.contains(load->first)) && (least == loads.end() || load->second < least->second))
        least = load;
    if (least == loads.end())
      throw std::invalid_argument(fmt::format(
          "{} writes files, and may not go to a machine that somebody offers; the run has no other one", worker));
    ++least->second;
    moves.push_back({worker, least->first});
  }
  return moves;
}

}  // namespace swarmanoid
