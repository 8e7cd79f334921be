// Sensors whose robots several threads may share: a batch in each, for some of the robots. Base of a SensorBatch
// besides.
#pragma once

namespace swarmanoid
{

class WorkerPool;

// Update writes to the batch alone, and the batch has nothing to save.
class SplitSensor
{
public:
  virtual ~SplitSensor() = default;
  // Makes new what all batches of the process share, from the space at its tick, before their Update: in one thread, or
  // in those of `pool`.
  virtual void RefreshShared(WorkerPool* pool) = 0;
};

}  // namespace swarmanoid
