// Functions for devices whose shape comes from a row of the table of kinds.
#pragma once

#include "common/space/space.h"
#include "controller_host/device.h"

namespace swarmanoid
{

// Returns the row of the robots of a batch: the reader of experiments sees to it that they are of one kind.
inline const EntityKindDescription& KindOfBatch(const DeviceSetup& setup)
{
  return DescriptionOf(setup.space.GetEntity(setup.robots.front()).GetKind());
}

}  // namespace swarmanoid
