// Measures a run by the <metrics> of its study, from the space at each tick. It gives the same results in one process
// and in a cluster. One object for each run; one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "simulation/simulator.h"
#include "studies/design/study.h"

namespace swarmanoid
{

// The measurements of a run.
struct RunSamples
{
  // The number of visits to each cell of a grid over the arena. Each <coverage> has one grid.
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
  std::vector<double> values;  // ticks by columns; NaN: no value
  std::vector<Grid> grids;
  std::vector<std::string> followed;  // the entities of <trajectories>
  std::vector<float> ways;            // ticks by entities by x, y; NaN: outside the arena

  template <class Archive, class Samples>
  static void Visit(Archive& archive, Samples& samples)
  {
    archive.Number(samples.tick_s);
    archive.Array(samples.ticks);
    archive.Array(samples.values);
    archive.List(samples.grids,
                 [&](auto& grid)
                 {
                   archive.Text(grid.metric);
                   archive.Number(grid.columns);
                   archive.Number(grid.rows);
                   archive.Number(grid.cell_m);
                   archive.Array(grid.visits);
                 });
    archive.List(samples.followed, [&](auto& id) { archive.Text(id); });
    archive.Array(samples.ways);
  }
};

class Metric;

class Recorder
{
public:
  // Both must outlive the object. Throws ConfigurationError, with the position in the study, if a metric does not fit
  // the experiment.
  Recorder(const Study& study, const Experiment& experiment);
  ~Recorder();

  // Call it at each tick, from the first one on.
  void Look(CSimulator& simulator);
  // Call it after Look at a tick that may be the last one. It adds a row also if none is due. If another tick follows,
  // that row is removed.
  void LookLast(CSimulator& simulator);
  // Call it at the end of the run. Throws ConfigurationError, with the position in the study, for a published value
  // whose name the run never published.
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
