// A block has the numbers of its ticks as rows of equal length, packed by RowPacker. A second array behind them has
// everything of varying length: attributes, moved entities, faults, flags. Rows of another length end a block.
//
// Invariant: a reader checks the lengths of the rows against the bytes that are there before it takes memory for them.
#include "common/journal/tick_records.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include "common/checkpoint/checkpoint_format.h"
#include "common/journal/packed_rows.h"
#include "common/serialisation/fields.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint8_t kLast = 1;
constexpr std::uint8_t kSave = 2;
constexpr std::uint8_t kFieldCells = 4;  // experiment functions changed cells of floor fields

void Put(ByteWriter& bytes, const AttributeChanges& changes)
{
  bytes.PutArray(changes.slots);
  bytes.PutArray(changes.values);
}

void Get(ByteReader& bytes, AttributeChanges& changes)
{
  changes.slots = bytes.GetArray<std::uint32_t>();
  changes.values = bytes.GetArray<double>();
}

// Returns an element of a list that is kept from tick to tick. The list grows by one element at most, so that a stated
// count takes no memory before its elements are there.
template <class T>
T& At(std::vector<T>& kept, std::uint32_t number)
{
  if (number == kept.size()) kept.emplace_back();
  return kept[number];
}

constexpr auto kStartFields = [](auto& archive, auto& start)
{
  ForEachOriginField(archive, start.origin);
  archive.Array(start.hosts.of_robots);
  archive.Number(start.hosts.hosts);
  archive.Number(start.first_tick);
};
constexpr auto kSnapshotFields = [](auto& archive, auto& snapshot) { ForEachSnapshotField(archive, snapshot); };
constexpr auto kPartFields = [](auto& archive, auto& part) { ForEachPartField(archive, part); };

template <class T, class Fields>
std::vector<char> Written(const T& value, const Fields& fields)
{
  ByteWriter content;
  FieldWriter archive(content);
  fields(archive, value);
  return content.Bytes();
}

template <class T, class Fields>
T Read(std::span<const char> content, const Fields& fields)
{
  ByteReader bytes(content);
  FieldReader archive(bytes);
  T value;
  fields(archive, value);
  return value;
}

}  // namespace

bool SameBits(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

bool TickRows::Add(const SpaceState& state, bool save, std::span<const SensorFrame> frames,
                   std::span<const ControlCommands> commands)
{
  std::size_t others = 0;
  for (const SensorFrame& frame : frames) others += frame.values.size();
  for (const ControlCommands& command : commands) others += command.values.size();
  if (ticks_ == 0)
  {
    first_tick_ = state.tick;
    poses_ = state.poses.size();
    others_ = others;
    hosts_ = commands.size();
    numbers_.Begin(poses_ + others_, poses_);
  }
  else if (poses_ != state.poses.size() || others_ != others || hosts_ != commands.size() ||
           state.tick != first_tick_ + ticks_)
    return false;
  ++ticks_;
  double* number = std::copy(state.poses.begin(), state.poses.end(), numbers_.NextRow());
  const bool has_cells = !state.fields.values.empty();
  rest_.Put(static_cast<std::uint8_t>((state.last ? kLast : 0) | (save ? kSave : 0) | (has_cells ? kFieldCells : 0)));
  if (has_cells)
  {
    rest_.PutArray(state.fields.runs);
    rest_.PutArray(state.fields.values);
  }
  Put(rest_, state.attributes);
  rest_.PutArray(state.moved);
  rest_.Put(static_cast<std::uint32_t>(frames.size()));
  for (const SensorFrame& frame : frames)
  {
    number = std::copy(frame.values.begin(), frame.values.end(), number);
    rest_.Put(static_cast<std::uint64_t>(frame.values.size()));
  }
  rest_.Put(static_cast<std::uint32_t>(commands.size()));
  for (const ControlCommands& command : commands)
  {
    number = std::copy(command.values.begin(), command.values.end(), number);
    rest_.Put(static_cast<std::uint64_t>(command.values.size()));
    Put(rest_, command.attributes);
    rest_.PutArray(command.faults.robots);
    rest_.PutArray(command.faults.kinds);
  }
  numbers_.Added();
  return true;
}

void TickRows::Clear()
{
  ticks_ = 0;
  rest_.Clear();
}

void TickRows::Finish(TickRows& next)
{
  numbers_.Finish();
  next.numbers_.TakeMemoryOf(numbers_);
}

std::span<const char> TickRows::Content(ReusedMemory& room)
{
  numbers_.Finish();
  const std::array<std::uint64_t, 4> header{first_tick_, ticks_, poses_, poses_ + others_};
  const std::array<std::span<const char>, 3> parts{numbers_.Widths(), numbers_.Bytes(), rest_.Bytes()};
  std::size_t size = sizeof header;
  for (const std::span<const char> part : parts) size += sizeof(std::uint64_t) + part.size();
  char* to = std::copy_n(reinterpret_cast<const char*>(header.data()), sizeof header, room.AtLeast(size));
  for (const std::span<const char> part : parts)
  {
    const std::uint64_t count = part.size();
    to = std::copy_n(reinterpret_cast<const char*>(&count), sizeof count, to);
    to = std::copy(part.begin(), part.end(), to);
  }
  return {room.Bytes(), size};
}

TickRecordReader::TickRecordReader(std::span<const char> content, std::uint64_t ticks, bool with_numbers)
    : with_numbers_(with_numbers), rest_(bytes_)
{
  ByteReader reader(content);
  tick_ = reader.Get<std::uint64_t>();
  left_ = reader.Get<std::uint64_t>();
  poses_ = reader.Get<std::uint64_t>();
  row_ = reader.Get<std::uint64_t>();
  const auto widths = reader.GetArray<char>();
  const auto packed = reader.GetArray<char>();
  bytes_ = reader.GetArray<char>();
  rest_ = ByteReader(bytes_);
  // Each eight ticks of a number take at least a byte of width, and each tick some bytes of the rest. A larger stated
  // length is refused before memory is allocated.
  if (left_ == 0 || left_ > bytes_.size() || row_ > widths.size() || poses_ > row_)
    throw std::runtime_error("journal: the rows of a block are none");
  if (with_numbers_) numbers_ = UnpackRows(widths, packed, left_, row_, poses_);
  left_ = std::min(left_, ticks);
}

bool TickRecordReader::Next(TickRecord& record)
{
  if (left_ == 0) return false;
  --left_;
  const std::size_t end = at_ + row_;
  const auto take = [&](std::vector<double>& values, std::uint64_t count)
  {
    if (count > end - at_) throw std::runtime_error("journal: a row is too short");
    const auto from = numbers_.begin() + static_cast<std::ptrdiff_t>(with_numbers_ ? at_ : 0);
    values.assign(from, from + static_cast<std::ptrdiff_t>(with_numbers_ ? count : 0));
    at_ += count;
  };
  record.state.tick = tick_++;
  take(record.state.poses, poses_);
  const auto flags = rest_.Get<std::uint8_t>();
  record.state.last = (flags & kLast) != 0;
  record.save = (flags & kSave) != 0;
  record.state.fields = {};
  if ((flags & kFieldCells) != 0)
  {
    record.state.fields.runs = rest_.GetArray<std::uint32_t>();
    record.state.fields.values = rest_.GetArray<float>();
  }
  Get(rest_, record.state.attributes);
  record.state.moved = rest_.GetArray<std::uint32_t>();
  const auto frames = rest_.Get<std::uint32_t>();
  for (std::uint32_t number = 0; number < frames; ++number)
  {
    SensorFrame& frame = At(record.frames, number);
    frame.tick = record.state.tick;
    frame.engine = number;
    take(frame.values, rest_.Get<std::uint64_t>());
  }
  record.frames.resize(frames);
  const auto hosts = rest_.Get<std::uint32_t>();
  for (std::uint32_t number = 0; number < hosts; ++number)
  {
    ControlCommands& commands = At(record.commands, number);
    commands.tick = record.state.tick;
    commands.host = number;
    take(commands.values, rest_.Get<std::uint64_t>());
    Get(rest_, commands.attributes);
    commands.faults.robots = rest_.GetArray<std::uint32_t>();
    commands.faults.kinds = rest_.GetArray<FaultKind>();
  }
  record.commands.resize(hosts);
  if (at_ != end) throw std::runtime_error("journal: a row is too long");
  return true;
}

std::vector<char> ContentOf(const JournalStart& start) { return Written(start, kStartFields); }
JournalStart ReadStart(std::span<const char> content)
{
  JournalStart start = Read<JournalStart>(content, kStartFields);
  if (!IsSound(start.hosts))
    throw std::runtime_error("the start of a journal has robots of controller hosts that it has not");
  return start;
}

std::vector<char> ContentOf(const SpaceSnapshot& snapshot) { return Written(snapshot, kSnapshotFields); }
SpaceSnapshot ReadSnapshot(std::span<const char> content) { return Read<SpaceSnapshot>(content, kSnapshotFields); }

std::vector<char> ContentOf(const SavedPart& part) { return Written(part, kPartFields); }
SavedPart ReadPart(std::span<const char> content) { return Read<SavedPart>(content, kPartFields); }

std::vector<char> ContentOf(std::span<const SensorFrame> frames)
{
  ByteWriter content;
  content.Put(static_cast<std::uint64_t>(frames.size()));
  for (const SensorFrame& frame : frames) content.PutArray(frame.values);
  return content.Bytes();
}

std::vector<SensorFrame> ReadFrames(std::span<const char> content)
{
  ByteReader reader(content);
  const auto count = reader.Get<std::uint64_t>();
  std::vector<SensorFrame> frames;
  for (std::uint64_t k = 0; k < count; ++k)
    frames.push_back({0, static_cast<std::uint32_t>(k), reader.GetArray<double>()});
  return frames;
}

}  // namespace swarmanoid
