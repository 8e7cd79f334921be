// McapWriter: writes messages in the container format MCAP (https://mcap.dev/spec, version 0), which Foxglove and
// rosbag2 read. Messages are JSON, in chunks compressed by zstd. Each chunk has an index of its messages; an index of
// the chunks and statistics end the file. It is written from front to back, so that it may go into a pipe.
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
  // The file must outlive the object. All functions throw std::runtime_error if it cannot be written.
  explicit McapWriter(ExportFile& file);

  // Adds a topic before the first message, and returns the number of its channel. `schema` is the JSON Schema of its
  // messages, with the name `schema_name`.
  std::uint16_t AddChannel(const std::string& topic, const std::string& schema_name, const std::string& schema);
  // Writes a message. Times are in nanoseconds and must not descend.
  void Write(std::uint16_t channel, std::uint64_t time, std::string_view json);
  // Writes the indexes by which readers find messages. Nothing can be written afterwards.
  void Finish();

private:
  struct Chunk
  {
    std::uint64_t first_time = 0;
    std::uint64_t last_time = 0;
    std::uint64_t offset = 0;  // position in the file
    std::uint64_t bytes = 0;
    std::map<std::uint16_t, std::uint64_t> index_offsets;  // by channel
    std::uint64_t index_bytes = 0;
    std::uint64_t stored_bytes = 0;
    std::uint64_t content_bytes = 0;
  };

  void Put(const std::string& bytes);
  void EndChunk();

  ExportFile& file_;
  std::uint64_t offset_ = 0;  // bytes written
  std::string schemas_;       // records of the schemas
  std::string channels_;
  std::uint16_t channel_count_ = 0;
  std::string chunk_;  // records of the open chunk
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> chunk_messages_;  // time, offset
  std::uint64_t chunk_first_ = 0;
  std::uint64_t last_ = 0;
  std::vector<Chunk> chunks_;
  std::map<std::uint16_t, std::uint64_t> counts_;  // number of messages by channel
};

}  // namespace swarmanoid
