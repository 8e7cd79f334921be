#include "simulation/playback/mcap_export.h"

#include <algorithm>

#include "common/program/csv.h"

namespace swarmanoid
{

McapExport::McapExport(ExportFile& file, const CSwarmanoidSpace& space, std::vector<std::size_t> entities)
    : messages_(space, std::move(entities)), writer_(file)
{
  const auto topics = messages_.Topics();
  for (std::size_t k = 0; k < topics.size(); ++k)
    channels_[k] = writer_.AddChannel(topics[k].topic, topics[k].schema_name, topics[k].schema);
}

void McapExport::WriteTick()
{
  time_ = messages_.Time();
  if (!begun_) Write(FoxgloveMessages::kFixed, messages_.Transforms(false));
  begun_ = true;
  Write(FoxgloveMessages::kMoving, messages_.Transforms(true));
  // The whole scene is written whenever a part of it changed, so that a viewer finds it in one message at any time.
  if (const auto scene = messages_.ChangedScene()) Write(FoxgloveMessages::kScene, *scene);
  Write(FoxgloveMessages::kAttributes, messages_.Attributes());
}

void McapExport::WriteEvent(std::string_view line)
{
  time_ = std::max(time_, messages_.TimeOfTick(std::stod(CsvFields(line).at(0))));
  Write(FoxgloveMessages::kEvents, FoxgloveMessages::Event(line, time_));
}

void McapExport::Write(FoxgloveMessages::Topic topic, const std::string& message)
{
  writer_.Write(channels_[topic], time_, message);
}

void McapExport::Finish() { writer_.Finish(); }

}  // namespace swarmanoid
