// The calls between a split engine and the processes that have the regions of its world, and between these processes.
// The engine calls a RegionTeam. The process of a region passes each task to an EngineRegion, which calls a
// RegionExchange. The bus implements both interfaces between processes, and tests implement them in one process.
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
  // Sends out[k] to region k and fills in[k] with the bytes that region k sends in the same call. A region's entry for
  // itself has no meaning. Returns when all bytes are here; all regions must call it equally often in a task. Throws
  // RegionsBeginAgain, or an error that ends the process.
  virtual void Swap(std::span<const ByteWriter> out, std::span<std::vector<char>> in) = 0;
};

// The task cannot be done, since another process has replaced a region. Another task follows, with all data.
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
  // Does a task of the engine in a tick. The engine gets any exception except RegionsBeginAgain too.
  virtual void Work(std::span<const char> task, ByteWriter& result) = 0;
};

// All regions, as the engine sees them.
class RegionTeam
{
public:
  // Fills in the task of each region. If `all_data` is true, the regions know nothing and need all data.
  using WriteTasks = std::function<void(bool all_data, std::span<ByteWriter> tasks)>;

  virtual ~RegionTeam() = default;
  virtual unsigned RegionCount() const = 0;
  // Returns false while the engine must do all work by itself.
  virtual bool IsReady() const = 0;
  // Passes a task to all regions and fills in the results. `write` is called once, and again with `all_data` whenever a
  // process has replaced a region. If `all_data` is true, the first call has it too. `meanwhile` is called once, while
  // the regions work. Throws std::runtime_error with the error of a region.
  virtual void Work(
      bool all_data, const WriteTasks& write, std::span<std::vector<char>> results,
      const std::function<void()>& meanwhile = [] {}) = 0;
};

}  // namespace swarmanoid
