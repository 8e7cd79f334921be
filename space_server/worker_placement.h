// WorkerPlacement: the machine of each worker of a run, and the machines that it may move to. RunControl uses it for
// users' requests.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "idl/control_request_message.h"

namespace swarmanoid
{

// The launcher's machine has this name.
inline constexpr const char* kHere = "here";

class WorkerPlacement
{
public:
  // Makes the placement of a run whose processes cannot be moved.
  WorkerPlacement() = default;
  // `machines` are all machines that workers may run on. `places` are "WORKER=MACHINE" for all workers; if a worker
  // appears twice, the last entry counts. Throws std::invalid_argument for a malformed entry.
  WorkerPlacement(std::vector<std::string> machines, const std::vector<std::string>& places);

  struct Move
  {
    std::string worker;
    std::string machine;
  };
  // Returns the moves that an order asks for; none if the machine to drain has no worker. The orders must be without
  // error (OrderError). Throws std::invalid_argument that says what to do.
  std::vector<Move> ReadHostMove(const ControlOrder& order) const;
  std::vector<Move> ReadEngineMove(const ControlOrder& order) const;
  std::vector<Move> ReadDrain(const ControlOrder& order) const;
  // Returns a text such as "here: space server, engine 'ground'; beta: controller host 0".
  std::string Text() const;
  // Returns true if the space server can start again, on the machine of the launcher. Only then can robots be
  // distributed to other hosts.
  bool ServerMayStartAgain() const;
  // Returns the machines of controller hosts in their order, for a request of `hosts`, with at most `most` hosts. New
  // ones run on the named machine, or here by default. If no more are asked for, hosts stay where they are. Throws
  // std::invalid_argument.
  std::vector<std::string> ReadHosts(const ControlOrder& order, std::size_t most) const;
  // Records a move. It ignores workers that cannot be moved and machines that the run does not have.
  void Put(const Move& move);

private:
  void RequireMoves() const;
  // Moves the first of `workers` that the run has.
  std::vector<Move> MoveOf(const std::vector<std::string>& workers, const ControlOrder& order) const;
  bool HasMachine(const std::string& machine) const;
  void RequireMachine(const std::string& machine) const;

  std::vector<std::string> machines_;
  std::map<std::string, std::string> places_;  // machines by worker
};

}  // namespace swarmanoid
