#include "python/module/python_simulation.h"

#include <pybind11/pybind11.h>

#include <stdexcept>

namespace py = pybind11;

namespace swarmanoid::python
{

Simulation::Simulation(const std::string& file, const Settings& settings, const SimulatorOptions& options)
    : experiment_(ReadExperiment(file, settings)), robots_(*experiment_)
{
  const ExternalRobots::Open open(robots_);
  const py::gil_scoped_release others;
  simulator_ = std::make_unique<CSimulator>(*experiment_, options);
}

CSimulator& Simulation::Simulator() const
{
  if (simulator_ == nullptr) throw std::runtime_error("the simulation was closed");
  return *simulator_;
}

bool Simulation::Step(std::uint64_t ticks)
{
  CSimulator& simulator = Simulator();
  for (std::uint64_t k = 0; k < ticks; ++k)
  {
    {
      const py::gil_scoped_release others;
      if (!simulator.Step()) return false;
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  return true;
}

void Simulation::Sense()
{
  CSimulator& simulator = Simulator();
  {
    const py::gil_scoped_release others;
    simulator.Sense();
  }
  robots_.Read();
}

const RunSummary& Simulation::Finish()
{
  CSimulator& simulator = Simulator();
  const py::gil_scoped_release others;
  return simulator.Finish();
}

}  // namespace swarmanoid::python
