// Where the workers of a run are, and where they may go: for users who ask for other places of them. Used by
// RunControl.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/messages/control_request.h"

namespace swarmanoid
{

// The machine that the launcher is on.
inline constexpr const char* kHere = "here";

class WorkerPlacement
{
public:
  // Of a run whose processes nobody can move.
  WorkerPlacement() = default;
  // `machines`: all that workers may be on; `places`: "WORKER=MACHINE", of all workers; of two with one name the last
  // one counts. Throws std::invalid_argument for what is none.
  WorkerPlacement(std::vector<std::string> machines, const std::vector<std::string>& places);

  struct Move
  {
    std::string worker;
    std::string machine;
  };
  // The moves that an order asks for; none if the machine to drain has no worker. The orders are without error
  // (OrderError). Throw std::invalid_argument with the cure.
  std::vector<Move> ReadHostMove(const ControlOrder& order) const;
  std::vector<Move> ReadEngineMove(const ControlOrder& order) const;
  std::vector<Move> ReadDrain(const ControlOrder& order) const;
  // "here: space server, engine 'ground'; beta: controller host 0".
  std::string Text() const;
  // Whether the space server can start again, beside the launcher; without it nobody shares out robots anew.
  bool ServerMayStartAgain() const;
  // Where controller hosts are to be, in their order, after what hosts asks for: at most so many. New ones are on the
  // machine that is named, or here if there is none. 0 more: where they are. Throws likewise.
  std::vector<std::string> ReadHosts(const ControlOrder& order, std::size_t most) const;
  // Nothing of a worker that nobody moves, and of a machine that the run does not have.
  void Put(const Move& move);

private:
  void RequireMoves() const;
  // Moves the first of `workers` that the run has.
  std::vector<Move> MoveOf(const std::vector<std::string>& workers, const ControlOrder& order) const;
  bool HasMachine(const std::string& machine) const;
  void RequireMachine(const std::string& machine) const;

  std::vector<std::string> machines_;
  std::map<std::string, std::string> places_;  // of workers
};

}  // namespace swarmanoid
