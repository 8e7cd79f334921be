// McapWriter: a file of messages in the container format MCAP (https://mcap.dev/spec, version 0), which Foxglove and
// rosbag2 read: JSON messages in chunks compressed by zstd, each with an index of its messages, and at the end an index
// of the chunks and statistics. Written from front to back, so that it may go into a pipe.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "simulation/playback/export_file.h"

namespace swarmanoid
{

class McapWriter
{
public:
  // The file outlives this. Throws std::runtime_error, as all else does, if it cannot be written.
  explicit McapWriter(ExportFile& file);

  // `schema`: JSON Schema of its messages, of that name. Before the first message.
  std::uint16_t AddChannel(const std::string& topic, const std::string& schema_name, const std::string& schema);
  // Times in nanoseconds do not descend.
  void Write(std::uint16_t channel, std::uint64_t time, std::string_view json);
  // What a reader finds messages by. Nothing can be written after it.
  void Finish();

private:
  struct Chunk
  {
    std::uint64_t first_time = 0;
    std::uint64_t last_time = 0;
    std::uint64_t offset = 0;  // in the file
    std::uint64_t bytes = 0;
    std::map<std::uint16_t, std::uint64_t> index_offsets;  // of each channel
    std::uint64_t index_bytes = 0;
    std::uint64_t stored_bytes = 0;
    std::uint64_t content_bytes = 0;
  };

  void Put(const std::string& bytes);
  void EndChunk();

  ExportFile& file_;
  std::uint64_t offset_ = 0;  // bytes written
  std::string schemas_;       // records
  std::string channels_;
  std::uint16_t channel_count_ = 0;
  std::string chunk_;                                                                             // records
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> chunk_messages_;  // time, offset
  std::uint64_t chunk_first_ = 0;
  std::uint64_t last_ = 0;
  std::vector<Chunk> chunks_;
  std::map<std::uint16_t, std::uint64_t> counts_;  // messages of each channel
};

}  // namespace swarmanoid
