// How an engine that is split speaks with the processes that have the regions of its world, and these with one another.
// An engine whose world is split calls a RegionTeam; a process of a region has an EngineRegion do each task, which
// calls a RegionExchange. The bus implements both calls between processes, tests within one.
#pragma once

#include <functional>
#include <span>
#include <stdexcept>
#include <vector>

#include "common/serialisation/bytes.h"

namespace swarmanoid
{

class RegionExchange
{
public:
  virtual ~RegionExchange() = default;
  virtual unsigned RegionCount() const = 0;
  // Sends out[k] to region k and fills in[k] with what region k sends in the same call; that of the caller to itself
  // means nothing. Returns when all are here; all call it equally often in a task. Throws RegionsBeginAgain, or what
  // ends the process.
  virtual void Swap(std::span<const ByteWriter> out, std::span<std::vector<char>> in) = 0;
};

// The task cannot be done, since a region is another process now: another task follows that says all anew.
class RegionsBeginAgain : public std::runtime_error
{
public:
  RegionsBeginAgain() : std::runtime_error("another task has come") {}
};

// One region of an engine's world, in a process of its own.
class EngineRegion
{
public:
  virtual ~EngineRegion() = default;
  // Does what the engine asks for, of a tick. What it throws, but RegionsBeginAgain, is thrown at the engine too.
  virtual void Work(std::span<const char> task, ByteWriter& result) = 0;
};

// All regions, as the engine sees them.
class RegionTeam
{
public:
  // Fills in the task of each region. `anew`: they know nothing, and are told all.
  using WriteTasks = std::function<void(bool anew, std::span<ByteWriter> tasks)>;

  virtual ~RegionTeam() = default;
  virtual unsigned RegionCount() const = 0;
  // Until then the engine does all by itself.
  virtual bool IsReady() const = 0;
  // Has all regions do a task, and fills in the results. `write` is called once, and again with `anew` whenever a
  // region comes to be another process; `anew`: at first, too. Throws std::runtime_error with what a region threw.
  virtual void Work(bool anew, const WriteTasks& write, std::span<std::vector<char>> results) = 0;
};

}  // namespace swarmanoid
