// SimulatedCluster runs a whole run in one thread: space server, engine workers, regions, controller hosts and journal.
// They use the code of the product. A simulated launcher starts and replaces them. One seed decides the machines and
// what the network does to messages. It also decides when processes are killed, stopped and cut off.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid::test
{

// It holds an experiment, and its result in one process.
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

// Chooses what is printed about a schedule on standard error.
struct Trace
{
  bool events = false;
  std::string messages{};  // prefix of the topics; empty: none
};

// `folder`: for the journal; its content is removed.
ScheduleResult RunSchedule(const Scene& scene, std::uint64_t seed, const std::string& folder, const Trace& trace = {});

}  // namespace swarmanoid::test
