// SplitSensor: a sensor whose robots several threads may share, with one batch for the robots of each thread. It is a
// second base class of a SensorBatch.
#pragma once

namespace swarmanoid
{

class WorkerPool;

// Update writes to the batch alone, and the batch has nothing to save.
class SplitSensor
{
public:
  virtual ~SplitSensor() = default;
  // Refreshes the data that all batches of the process share, from the space at its tick and before their Update. It
  // runs in one thread, or in those of `pool`.
  virtual void RefreshShared(WorkerPool* pool) = 0;
};

}  // namespace swarmanoid
