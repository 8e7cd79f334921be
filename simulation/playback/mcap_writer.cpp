// The file is written from front to back, so all that readers need to find messages is collected and follows at the
// end: the indexes of each chunk after it, and those of the chunks in the summary. The numbers of records and their
// fields are from the specification (https://mcap.dev/spec).
//
// Invariant: offset_ is the number of bytes written, and each stored offset points to the first byte of a record.
#include "simulation/playback/mcap_writer.h"

#include <zstd.h>

#include <array>
#include <stdexcept>
#include <type_traits>

namespace swarmanoid
{
namespace
{

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
constexpr std::size_t kChunkBytes = 1U << 20U;  // bytes of messages after which a chunk ends
constexpr const char* kCompression = "zstd";

enum class Record : std::uint8_t
{
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0b,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f
};

constexpr std::array<std::uint32_t, 256> CrcTable()
{
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte)
  {
    std::uint32_t value = byte;
    for (int bit = 0; bit < 8; ++bit) value = (value & 1U) != 0 ? value >> 1U ^ 0xedb88320U : value >> 1U;
    table[byte] = value;
  }
  return table;
}

// Computes the CRC-32 of IEEE 802.3, as zlib does.
std::uint32_t Crc(std::string_view bytes)
{
  static constexpr std::array<std::uint32_t, 256> kTable = CrcTable();
  std::uint32_t crc = 0xffffffffU;
  for (const char byte : bytes) crc = crc >> 8U ^ kTable[(crc ^ static_cast<std::uint8_t>(byte)) & 0xffU];
  return ~crc;
}

// It gathers the fields of a record, in little-endian order.
class Fields
{
public:
  template <class T>
  requires std::is_integral_v<T> Fields& Add(T number)
  {
    for (std::size_t byte = 0; byte < sizeof number; ++byte)
      bytes_ += static_cast<char>(static_cast<std::uint64_t>(number) >> 8 * byte & 0xff);
    return *this;
  }
  // Appends the length of the text, and the text.
  Fields& Text(std::string_view text)
  {
    Add(static_cast<std::uint32_t>(text.size()));
    return Bytes(text);
  }
  template <class Key, class Value>
  Fields& Map(const std::map<Key, Value>& map)
  {
    Add(static_cast<std::uint32_t>(map.size() * (sizeof(Key) + sizeof(Value))));
    for (const auto& [key, value] : map) Add(key).Add(value);
    return *this;
  }
  Fields& Bytes(std::string_view bytes)
  {
    bytes_ += bytes;
    return *this;
  }
  std::string RecordOf(Record kind) const
  {
    Fields record;
    record.Add(static_cast<std::uint8_t>(kind)).Add(static_cast<std::uint64_t>(bytes_.size()));
    return record.bytes_ + bytes_;
  }
  const std::string& Get() const { return bytes_; }

private:
  std::string bytes_;
};

std::string Compressed(const std::string& content)
{
  std::string stored(ZSTD_compressBound(content.size()), '\0');
  const std::size_t bytes = ZSTD_compress(stored.data(), stored.size(), content.data(), content.size(), 1);
  if (ZSTD_isError(bytes) != 0) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(bytes));
  stored.resize(bytes);
  return stored;
}

}  // namespace

McapWriter::McapWriter(ExportFile& file) : file_(file)
{
  Put(std::string(kMagic) + Fields().Text("").Text("swarmanoid").RecordOf(Record::kHeader));
}

void McapWriter::Put(const std::string& bytes)
{
  file_.Write(bytes);
  offset_ += bytes.size();
}

std::uint16_t McapWriter::AddChannel(const std::string& topic, const std::string& schema_name,
                                     const std::string& schema)
{
  const std::uint16_t number = ++channel_count_;  // schema 0 means that a channel has no schema
  const std::string of_schema =
      Fields().Add(number).Text(schema_name).Text("jsonschema").Text(schema).RecordOf(Record::kSchema);
  const std::string of_channel = Fields()
                                     .Add(number)
                                     .Add(number)
                                     .Text(topic)
                                     .Text("json")
                                     .Map(std::map<std::uint16_t, std::uint16_t>())
                                     .RecordOf(Record::kChannel);
  schemas_ += of_schema;
  channels_ += of_channel;
  chunk_ += of_schema + of_channel;
  return number;
}

void McapWriter::Write(std::uint16_t channel, std::uint64_t time, std::string_view json)
{
  if (chunk_messages_.empty()) chunk_first_ = time;
  last_ = time;
  chunk_messages_[channel].emplace_back(time, chunk_.size());
  const auto sequence = static_cast<std::uint32_t>(counts_[channel]++);
  chunk_ += Fields().Add(channel).Add(sequence).Add(time).Add(time).Bytes(json).RecordOf(Record::kMessage);
  if (chunk_.size() >= kChunkBytes) EndChunk();
}

void McapWriter::EndChunk()
{
  if (chunk_.empty()) return;
  const std::string stored = Compressed(chunk_);
  Chunk chunk;
  chunk.first_time = chunk_messages_.empty() ? 0 : chunk_first_;
  chunk.last_time = chunk_messages_.empty() ? 0 : last_;
  chunk.offset = offset_;
  chunk.stored_bytes = stored.size();
  chunk.content_bytes = chunk_.size();
  Put(Fields()
          .Add(chunk.first_time)
          .Add(chunk.last_time)
          .Add(chunk.content_bytes)
          .Add(Crc(chunk_))
          .Text(kCompression)
          .Add(chunk.stored_bytes)
          .Bytes(stored)
          .RecordOf(Record::kChunk));
  chunk.bytes = offset_ - chunk.offset;
  for (const auto& [channel, messages] : chunk_messages_)
  {
    chunk.index_offsets[channel] = offset_;
    Fields index;
    index.Add(channel).Add(static_cast<std::uint32_t>(messages.size() * 2 * sizeof(std::uint64_t)));
    for (const auto& [time, offset] : messages) index.Add(time).Add(offset);
    Put(index.RecordOf(Record::kMessageIndex));
  }
  chunk.index_bytes = offset_ - chunk.offset - chunk.bytes;
  chunks_.push_back(std::move(chunk));
  chunk_.clear();
  chunk_messages_.clear();
}

void McapWriter::Finish()
{
  EndChunk();
  Put(Fields().Add(std::uint32_t{0}).RecordOf(Record::kDataEnd));  // no checksum, since each chunk has its own

  const std::uint64_t start = offset_;
  std::string summary;
  std::string offsets;
  const auto add = [&](Record kind, const std::string& records)
  {
    if (records.empty()) return;
    offsets += Fields()
                   .Add(static_cast<std::uint8_t>(kind))
                   .Add(start + summary.size())
                   .Add(static_cast<std::uint64_t>(records.size()))
                   .RecordOf(Record::kSummaryOffset);
    summary += records;
  };
  add(Record::kSchema, schemas_);
  add(Record::kChannel, channels_);
  std::uint64_t messages = 0;
  for (const auto& [channel, count] : counts_) messages += count;
  add(Record::kStatistics, Fields()
                               .Add(messages)
                               .Add(channel_count_)
                               .Add(static_cast<std::uint32_t>(channel_count_))
                               .Add(std::uint32_t{0})  // attachments
                               .Add(std::uint32_t{0})  // metadata
                               .Add(static_cast<std::uint32_t>(chunks_.size()))
                               .Add(chunks_.empty() ? std::uint64_t{0} : chunks_.front().first_time)
                               .Add(last_)
                               .Map(counts_)
                               .RecordOf(Record::kStatistics));
  std::string indexes;
  for (const Chunk& chunk : chunks_)
    indexes += Fields()
                   .Add(chunk.first_time)
                   .Add(chunk.last_time)
                   .Add(chunk.offset)
                   .Add(chunk.bytes)
                   .Map(chunk.index_offsets)
                   .Add(chunk.index_bytes)
                   .Text(kCompression)
                   .Add(chunk.stored_bytes)
                   .Add(chunk.content_bytes)
                   .RecordOf(Record::kChunkIndex);
  add(Record::kChunkIndex, indexes);
  const std::uint64_t offset_start = start + summary.size();
  summary += offsets;
  // The checksum covers all bytes from the start of the summary up to the checksum itself.
  Fields footer;
  footer.Add(start).Add(offset_start);
  constexpr std::uint64_t kFooterBytes = 2 * sizeof(std::uint64_t) + sizeof(std::uint32_t);
  summary += Fields().Add(static_cast<std::uint8_t>(Record::kFooter)).Add(kFooterBytes).Get() + footer.Get();
  summary += Fields().Add(Crc(summary)).Get();
  Put(summary + std::string(kMagic));
}

}  // namespace swarmanoid
