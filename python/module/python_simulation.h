// swarmanoid.Simulation: a CSimulator with its experiment and the robots that Python steers.
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "python/module/external_robots.h"
#include "simulation/simulator.h"

namespace swarmanoid::python
{

class Simulation
{
public:
  using Settings = std::vector<std::pair<std::string, std::string>>;

  // Throws as CSimulator.
  Simulation(const std::string& file, const Settings& settings, const SimulatorOptions& options);

  // Runs up to `ticks` ticks; returns false if the experiment is over. Python may run meanwhile, and interrupt between
  // two ticks.
  bool Step(std::uint64_t ticks);
  // Brings the sensors of the robots of external controllers to the present tick.
  void Sense();
  const RunSummary& Finish();

  const CSwarmanoidSpace& Space() const { return Simulator().GetSpace(); }
  SpaceEditor& Editor() { return Simulator().GetEditor(); }
  ExternalRobots& Robots() { return robots_; }
  // Throws std::runtime_error once the simulation was closed.
  CSimulator& Simulator() const;
  void Close() { simulator_.reset(); }

private:
  std::unique_ptr<Experiment> experiment_;
  ExternalRobots robots_;
  std::unique_ptr<CSimulator> simulator_;
};

}  // namespace swarmanoid::python
