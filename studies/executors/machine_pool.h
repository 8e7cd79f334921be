// Other machines that run a study, each reached by its own process (ssh). The orders of a lost machine go to the
// others. One thread.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "launcher/supervision/machines.h"
#include "studies/executors/executor.h"
#include "studies/executors/machine_connection.h"

namespace swarmanoid
{

class MachinePool final : public Executor
{
public:
  // `setup` comes from SetupOf. `folder` is that of the study, for the files of runs. Throws UsageError if the hosts
  // have no machine for runs.
  MachinePool(const Machines& machines, const std::vector<char>& setup, std::string folder);
  ~MachinePool() override;

  bool HasRoom() const override;
  void Give(RunOrder order) override;
  bool IsIdle() const override;
  std::vector<RunOutcome> Wait(std::chrono::milliseconds longest) override;
  std::vector<RunningRun> Running() const override;
  unsigned Slots() const override;
  std::vector<std::string> TakeNotes() override { return std::exchange(notes_, {}); }

private:
  struct Machine
  {
    std::string name;
    std::unique_ptr<MachineConnection> connection;  // nullptr: the machine is lost
    unsigned slots = 0;                             // 0 until it is ready
    std::deque<RunOrder> orders;
    std::string lost_by;
  };

  std::size_t RoomOf(const Machine& machine) const;
  void Distribute();
  void Take(Machine& machine, const std::vector<char>& message, std::vector<RunOutcome>& outcomes);
  void TakeOutcome(Machine& machine, ByteReader& bytes, std::vector<RunOutcome>& outcomes);
  void Attend(Machine& machine, std::vector<RunOutcome>& outcomes);
  void Lose(Machine& machine, const std::string& reason);

  std::string folder_;
  std::chrono::seconds lease_;
  std::vector<Machine> machines_;
  std::vector<std::unique_ptr<MachineConnection>> leaving_;  // connections to lost machines; the end waits for them
  std::deque<RunOrder> waiting_;                             // orders that wait for a machine
  std::size_t orders_of_slot_ = 1;  // larger if runs are short, so that no machine waits for the network
  std::vector<std::string> notes_;
};

}  // namespace swarmanoid
