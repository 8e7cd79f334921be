// Checkpoints of a run in one process: all that is needed to go on from a tick with the same bits as if nothing had
// happened.
//
// File: "SWARMCP1", XXH3-64 of the effective experiment (u64), tick (u64), poses of the movable entities, attributes,
// then the state of each engine and of the controllers and devices; arrays as in common/serialisation/bytes.h.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/space/space.h"
#include "controller_host/controller_host.h"
#include "engine_worker/engine_worker.h"

namespace swarmanoid
{

// Throws std::runtime_error where the file cannot be written, ControllerError where a controller cannot be saved. The
// file is complete or absent: it is written beside and renamed.
void SaveCheckpoint(const std::string& path, const Experiment& experiment, const CSwarmanoidSpace& space,
                    const std::vector<std::unique_ptr<EngineWorker>>& engines, const ControllerHost& host);

// Throws std::runtime_error where the file cannot be read, is damaged or is of another experiment; the run must then
// not go on.
void LoadCheckpoint(const std::string& path, const Experiment& experiment, CSwarmanoidSpace& space,
                    const std::vector<std::unique_ptr<EngineWorker>>& engines, ControllerHost& host);

}  // namespace swarmanoid
