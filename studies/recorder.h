// Measures a run as the <metrics> of its study say, from the space that it is shown at each tick: in one process and in
// a cluster the same. One object a run; one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/serialisation/bytes.h"
#include "simulation/simulator.h"
#include "studies/study.h"

namespace swarmanoid
{

// What was measured.
struct RunSamples
{
  // How often each cell of a grid over the arena was visited: one for each <coverage>.
  struct Grid
  {
    std::string metric;
    std::uint32_t columns = 0;  // along x
    std::uint32_t rows = 0;
    double cell_m = 0;
    std::vector<std::uint32_t> visits;  // row by row, from the origin of the arena
  };
  std::vector<std::uint64_t> ticks;
  double tick_s = 0;
  std::vector<double> values;  // ticks by columns; NaN: none
  std::vector<Grid> grids;
  std::vector<std::string> followed;  // entities of <trajectories>
  std::vector<float> ways;            // ticks by entities by x, y; NaN: not in the arena

  void Write(ByteWriter& bytes) const;
  static RunSamples Read(ByteReader& bytes);
};

// Of the table, without those that name a run: "travelled.mean", "polarisation".
std::vector<std::string> MetricColumns(const Study& study);

class Metric;

class Recorder
{
public:
  // Both outlive it. Throws ConfigurationError, with the place in the study, if a metric does not fit the experiment.
  Recorder(const Study& study, const Experiment& experiment);
  ~Recorder();

  // At each tick, from the first one on.
  void Look(CSimulator& simulator);
  // Behind Look, at a tick that may be the last one: its row is there whether or not it is due. If another tick comes,
  // a row that is not due is dropped.
  void LookLast(CSimulator& simulator);
  // At the end of the run. Throws ConfigurationError, with the place in the study, for a published number whose name
  // the run never published.
  RunSamples Take();

private:
  void AddRow(CSimulator& simulator);

  const Study& study_;
  std::vector<std::unique_ptr<Metric>> metrics_;
  std::vector<std::uint32_t> followed_;
  std::size_t columns_ = 0;
  bool is_tentative_ = false;  // the last row is not due
  RunSamples samples_;
};

}  // namespace swarmanoid
