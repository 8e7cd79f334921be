// McapExport: writes a run for Foxglove and the tools of rosbag2 (`swarmanoid export --mcap`). docs/command.md has the
// topics.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/playback/mcap_writer.h"
#include "visualiser/foxglove/foxglove_messages.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

class McapExport
{
public:
  // `entities`: the shown ones. The file and the space must outlive the object. The space must be at the tick that is
  // written.
  McapExport(ExportFile& file, const CSwarmanoidSpace& space, std::vector<std::size_t> entities);

  // Writes the tick of the space. Ticks must ascend.
  void WriteTick();
  // Writes a line of events.csv. Its tick must not be before the newest written one.
  void WriteEvent(std::string_view line);
  void Finish();

private:
  void Write(FoxgloveMessages::Topic topic, const std::string& message);

  FoxgloveMessages messages_;
  McapWriter writer_;
  std::array<std::uint16_t, FoxgloveMessages::kTopicCount> channels_{};
  std::uint64_t time_ = 0;  // time of the newest message, ns
  bool begun_ = false;
};

}  // namespace swarmanoid
