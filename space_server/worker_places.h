// Where the workers of a run are, and where they may go: for users who ask for other places of them, and for those who
// offer machines. Used by RunControl.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/messages/control_request.h"
#include "common/messages/machine_name.h"

namespace swarmanoid
{

class WorkerPlaces
{
public:
  // Of a run whose processes nobody can move.
  WorkerPlaces() = default;
  // `machines`: all that workers may be on; `places`: "WORKER=MACHINE", of all workers; of two with one name the last
  // one counts. Throws std::invalid_argument for what is none.
  WorkerPlaces(std::vector<std::string> machines, const std::vector<std::string>& places);

  struct Move
  {
    std::string worker;
    std::string machine;
  };
  // What move-host, move-engine or drain asks for; nothing if nobody is there. Throws std::invalid_argument with the
  // cure.
  std::vector<Move> Read(const ControlRequestMessage& request) const;
  // A process offers its machine: workers may be there from now on. False if it has said so before. Throws likewise.
  bool Offer(const std::string& machine, const std::string& process);
  // It will do so no more: what its workers are to do. Throws likewise.
  std::vector<Move> Withdraw(const std::string& machine, const std::string& process);
  // A process has gone, and with it the machine that it offered, if it did.
  std::optional<std::string> Gone(const std::string& process);
  // "here: space server, engine 'ground'; beta (offered by beta:4171): controller host 0". Each worker is named, also
  // one whose machine has gone, or has not offered itself again since all processes started: "beta (not offered now):
  // …".
  std::string Text() const;
  // Whether the space server can start again, beside the launcher; without it nobody shares out robots anew.
  bool ServerMayStartAgain() const;
  // Where controller hosts are to be, in their order, after what hosts asks for: at most so many. New ones are on the
  // machine that is named, or on the offered one with the fewest, or here if there is none. 0 more: where they are.
  // Throws likewise.
  std::vector<std::string> ReadHosts(const ControlRequestMessage& request, std::size_t most) const;
  // Nothing of a worker that nobody moves.
  void Put(const Move& move);

private:
  std::vector<Move> Drain(const std::string& machine) const;
  void RequireMoves(const std::string& verb) const;
  void RequireMachine(const std::string& machine) const;
  std::string ForNewHost(const std::vector<std::string>& hosts) const;

  std::vector<std::string> machines_;
  std::map<std::string, std::string> places_;  // of workers
  std::map<std::string, std::string> offers_;  // of machines: by which process
};

}  // namespace swarmanoid
