// `swarmanoid export --mcap`: a run as Foxglove and tools of rosbag2 see it. docs/command.md has the topics.
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
  // `entities`: those that are shown. Both outlive this; the space is at each tick that is written.
  McapExport(ExportFile& file, const CSwarmanoidSpace& space, std::vector<std::size_t> entities);

  // The tick of the space, after those before.
  void WriteTick();
  // A line of events.csv, at a tick that is not before the newest that was written.
  void WriteEvent(std::string_view line);
  void Finish();

private:
  void Write(FoxgloveMessages::Topic topic, const std::string& message);

  FoxgloveMessages messages_;
  McapWriter writer_;
  std::array<std::uint16_t, FoxgloveMessages::kTopicCount> channels_{};
  std::uint64_t time_ = 0;  // of the newest message, ns
  bool begun_ = false;
};

}  // namespace swarmanoid
