// Problem: keep all cores of several machines busy over a slow network, although machines may vanish.
//
// Method: each machine gets more orders than it has cores if runs are short, so that it never waits for the network; an
// order goes to the machine with the fewest orders for each core. A machine that is silent for longer than the lease is
// lost, and its orders go to the front of the queue again.
//
// Invariant: an outcome counts once, for an order that is open on the machine that sends it. So a run that two machines
// execute after a loss has one result.
#include "studies/executors/machine_pool.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>

#include "common/configuration/trust.h"
#include "common/program/interrupts.h"
#include "common/program/usage_error.h"
#include "launcher/system/installation.h"
#include "studies/runs/run_files.h"
#include "studies/runs/study_setup.h"

namespace swarmanoid
{
namespace
{

// The orders given to a machine last about so long, in seconds. Their number is also limited for each core.
constexpr double kOrdersAhead_s = 0.5;
constexpr double kMostAhead = 50;
// A machine sends nothing until it has loaded all experiments.
constexpr std::chrono::seconds kPatienceAtStart(600);

bool IsThisMachine(const std::string& name) { return name == "here" || name == "localhost"; }

}  // namespace

MachinePool::MachinePool(const Machines& machines, const std::vector<char>& setup, std::string folder)
    : folder_(std::move(folder)), lease_(machines.LeaseSeconds())
{
  std::vector<std::string> words{OwnProgram(), kStudyWorkerFlag};
  if (ExperimentsAreTrusted()) words.emplace_back(kTrustFlag);
  for (const RunMachine& run_machine : machines.ForRuns())
  {
    Machine& machine = machines_.emplace_back();
    machine.name = run_machine.name;
    machine.connection = std::make_unique<MachineConnection>(machines.WorkerCommand(run_machine.name, words));
    ByteWriter head;
    head.Put(static_cast<std::uint32_t>(machines.LeaseSeconds()));
    head.Put(static_cast<std::uint32_t>(run_machine.cores));
    std::vector<char> content = head.Bytes();
    content.insert(content.end(), setup.begin(), setup.end());
    machine.connection->Send(StudyMessage::kSetup, content);
  }
}

// All connections are closed before the first one is waited for.
MachinePool::~MachinePool()
{
  for (const Machine& machine : machines_)
    if (machine.connection) machine.connection->Close();
}

std::size_t MachinePool::RoomOf(const Machine& machine) const
{
  const std::size_t most = machine.connection ? machine.slots * orders_of_slot_ : 0;
  return most - std::min(most, machine.orders.size());
}

bool MachinePool::HasRoom() const
{
  return waiting_.empty() &&
         std::any_of(machines_.begin(), machines_.end(), [&](const Machine& machine) { return RoomOf(machine) > 0; });
}

void MachinePool::Give(RunOrder order)
{
  waiting_.push_back(std::move(order));
  Distribute();
}

// Each order goes to the machine with the fewest waiting orders for a core.
void MachinePool::Distribute()
{
  while (!waiting_.empty())
  {
    Machine* best = nullptr;
    for (Machine& machine : machines_)
      if (RoomOf(machine) > 0 &&
          (best == nullptr || machine.orders.size() * best->slots < best->orders.size() * machine.slots))
        best = &machine;
    if (best == nullptr) return;
    ByteWriter bytes;
    WriteFields(bytes, waiting_.front());
    best->connection->Send(StudyMessage::kOrder, bytes.Bytes());
    best->orders.push_back(std::move(waiting_.front()));
    waiting_.pop_front();
  }
}

bool MachinePool::IsIdle() const
{
  return waiting_.empty() &&
         std::all_of(machines_.begin(), machines_.end(), [](const Machine& machine) { return machine.orders.empty(); });
}

std::vector<RunningRun> MachinePool::Running() const
{
  std::vector<RunningRun> runs;
  for (const Machine& machine : machines_)
    for (std::size_t i = 0; i < std::min<std::size_t>(machine.orders.size(), machine.slots); ++i)
      runs.push_back({machine.orders[i].name, machine.name});
  return runs;
}

unsigned MachinePool::Slots() const
{
  unsigned slots = 0;
  for (const Machine& machine : machines_)
    if (machine.connection) slots += machine.slots;
  return slots;
}

std::vector<RunOutcome> MachinePool::Wait(std::chrono::milliseconds longest)
{
  std::vector<pollfd> files;
  std::string lost;
  for (const Machine& machine : machines_)
  {
    if (!machine.connection)
    {
      lost += fmt::format("{}{}: {}", lost.empty() ? "" : "; ", machine.name, machine.lost_by);
      continue;
    }
    files.push_back({machine.connection->Output(), POLLIN, 0});
    files.push_back({machine.connection->InputIfFull(), POLLOUT, 0});
  }
  if (files.empty()) throw RunPlaceError("no machine of --hosts is left: " + lost);
  std::vector<RunOutcome> outcomes;
  poll(files.data(), files.size(), static_cast<int>(longest.count()));
  for (Machine& machine : machines_)
    if (machine.connection) Attend(machine, outcomes);
  Distribute();
  return outcomes;
}

void MachinePool::Attend(Machine& machine, std::vector<RunOutcome>& outcomes)
{
  MachineConnection& connection = *machine.connection;
  const bool is_there = connection.Exchange();
  try
  {
    while (machine.connection)
    {
      const auto message = connection.Next();
      if (!message) break;
      Take(machine, *message, outcomes);
    }
  }
  catch (const RunPlaceError&)
  {
    throw;
  }
  catch (const std::runtime_error& error)
  {
    return Lose(machine, error.what());
  }
  if (!machine.connection) return;
  const auto now = MachineConnection::Clock::now();
  if (!is_there) return Lose(machine, connection.End());
  const std::chrono::seconds silence = machine.slots == 0 ? std::max(lease_, kPatienceAtStart) : lease_;
  if (now - connection.Heard() > silence)
  {
    connection.End();
    return Lose(machine, fmt::format("nothing was heard of it for {} s{}", silence.count(),
                                     silence == lease_ ? " (`lease` of the file)" : ""));
  }
  if (now - connection.Said() > lease_ / 4) connection.Send(StudyMessage::kStillHere);
}

void MachinePool::Take(Machine& machine, const std::vector<char>& message, std::vector<RunOutcome>& outcomes)
{
  ByteReader bytes(message);
  switch (bytes.Get<StudyMessage>())
  {
    case StudyMessage::kReady:
      machine.slots = bytes.Get<std::uint32_t>();
      return;
    case StudyMessage::kRefused:
      return Lose(machine, bytes.GetText());
    case StudyMessage::kOutcome:
      return TakeOutcome(machine, bytes, outcomes);
    case StudyMessage::kSetup:
    case StudyMessage::kOrder:
    case StudyMessage::kStillHere:
      return;
  }
}

void MachinePool::TakeOutcome(Machine& machine, ByteReader& bytes, std::vector<RunOutcome>& outcomes)
{
  RunOutcome outcome = ReadFields<RunOutcome>(bytes);
  const RunFiles files = RunFiles::Read(bytes);
  const auto order = std::find_if(machine.orders.begin(), machine.orders.end(),
                                  [&](const RunOrder& one) { return one.name == outcome.name; });
  if (order == machine.orders.end()) return;
  machine.orders.erase(order);
  try
  {
    files.Keep(folder_ + "/runs/" + outcome.name.Text());
  }
  catch (const std::runtime_error& error)
  {
    throw RunPlaceError(error.what());
  }
  for (const std::string& name : files.left_out)
    notes_.push_back(
        fmt::format("run {}: '{}' is too large to come back from {}", outcome.name.Text(), name, machine.name));
  outcome.host = IsThisMachine(machine.name) ? NameOfThisHost() : machine.name;
  const double ahead = outcome.wall_s > 0 ? kOrdersAhead_s / outcome.wall_s : kMostAhead;
  orders_of_slot_ = 1 + static_cast<std::size_t>(std::min(ahead, kMostAhead));
  outcomes.push_back(std::move(outcome));
}

void MachinePool::Lose(Machine& machine, const std::string& reason)
{
  machine.lost_by = reason;
  machine.connection->Close();
  leaving_.push_back(std::move(machine.connection));
  notes_.push_back(fmt::format("{} is left out: {}{}", machine.name, reason,
                               machine.orders.empty() ? ""
                               : Interrupted()        ? "; its runs are given up"
                                                      : "; its runs go to the others"));
  if (!Interrupted())
    waiting_.insert(waiting_.begin(), std::make_move_iterator(machine.orders.begin()),
                    std::make_move_iterator(machine.orders.end()));
  machine.orders.clear();
}

}  // namespace swarmanoid
