// ColourScene: the blobs that colour cameras see in a test world.
#pragma once

#include "common/control_interface/ci_colour_blob_sensor.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{

inline void Paint(TestWorld& world, std::uint32_t entity, std::uint32_t colour)
{
  for (int led = 0; led < 12; ++led) world.Space().GetEntity(entity).SetAttribute("led", colour, led);
}

inline std::span<const CCI_ColourBlob> BlobsOf(TestSensor& camera, std::size_t k)
{
  return camera.Of<CCI_ColourBlobSensor>(k).GetAllBlobs();
}

}  // namespace swarmanoid
