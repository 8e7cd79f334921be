// SimulatedCluster: a whole run in one thread: space server, engine workers, regions, controller hosts and journal, all
// with the code of the product, and a launcher that starts and replaces them. One seed decides the machines, what the
// network does to messages, and when processes are killed, stopped and cut off.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid::test
{

// An experiment, and what it gives in one process.
struct Scene
{
  std::string name;
  std::string text;
  unsigned hosts = 1;
  std::unique_ptr<Experiment> experiment;
  std::string hashes;  // the hash log of one process
};

// Throws std::runtime_error if the experiment has mistakes.
Scene MakeScene(const std::string& name, const std::string& text, unsigned hosts, const std::string& folder);

struct ScheduleResult
{
  std::string trouble;  // empty: all invariants held
  std::uint64_t steps = 0;
  double virtual_s = 0;
  unsigned kills = 0, stops = 0, cuts = 0, replaced = 0, restarts = 0;
};

// What is said of a schedule on standard error.
struct Trace
{
  bool events = false;
  std::string messages{};  // of topics that begin so; empty: none
};

// `folder`: for the journal; its content is removed.
ScheduleResult RunSchedule(const Scene& scene, std::uint64_t seed, const std::string& folder, const Trace& trace = {});

}  // namespace swarmanoid::test
