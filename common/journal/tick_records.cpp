#include "common/journal/tick_records.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "common/checkpoint/checkpoint_format.h"
#include "common/serialisation/fields.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint8_t kLast = 1;
constexpr std::uint8_t kSave = 2;

// Differences of the bits of doubles, small ones of either sign as small numbers.
std::uint64_t Folded(std::uint64_t difference) { return (difference << 1U) ^ (0 - (difference >> 63U)); }
std::uint64_t Unfolded(std::uint64_t folded) { return (folded >> 1U) ^ (0 - (folded & 1U)); }

// What the two rows before let expect of a number: that it goes on as before, or if it is no pose, that it stays.
double Expected(const double* column, std::size_t tick, std::size_t row, bool moves)
{
  if (tick == 0) return 0;
  const double before = column[(tick - 1) * row];
  if (!moves || tick == 1) return before;
  return before + (before - column[(tick - 2) * row]);
}

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

constexpr auto kStartFields = [](auto& archive, auto& start)
{
  ForEachOriginField(archive, start.origin);
  archive.Number(start.hosts);
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
  FieldReader archive(content);
  T value;
  fields(archive, value);
  return value;
}

}  // namespace

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
  }
  else if (poses_ != state.poses.size() || others_ != others || hosts_ != commands.size() ||
           state.tick != first_tick_ + ticks_)
    return false;
  ++ticks_;
  numbers_.insert(numbers_.end(), state.poses.begin(), state.poses.end());
  rest_.Put(static_cast<std::uint8_t>((state.last ? kLast : 0) | (save ? kSave : 0)));
  Put(rest_, state.attributes);
  rest_.PutArray(state.moved);
  rest_.Put(static_cast<std::uint32_t>(frames.size()));
  for (const SensorFrame& frame : frames)
  {
    numbers_.insert(numbers_.end(), frame.values.begin(), frame.values.end());
    rest_.Put(static_cast<std::uint64_t>(frame.values.size()));
  }
  rest_.Put(static_cast<std::uint32_t>(commands.size()));
  for (const ControlCommands& command : commands)
  {
    numbers_.insert(numbers_.end(), command.values.begin(), command.values.end());
    rest_.Put(static_cast<std::uint64_t>(command.values.size()));
    Put(rest_, command.attributes);
    rest_.PutArray(command.faults.robots);
    rest_.PutArray(command.faults.kinds);
  }
  return true;
}

void TickRows::Clear()
{
  ticks_ = 0;
  numbers_.clear();
  rest_.Clear();
}

std::vector<char> TickRows::Content() const
{
  const std::size_t row = poses_ + others_;
  const std::span<const char> rest = rest_.Bytes();
  const std::array<std::uint64_t, 4> head{first_tick_, ticks_, poses_, row * ticks_};
  const std::uint64_t rest_bytes = rest.size();
  std::vector<char> content;
  // Filled from front to back: to clear it first costs as much.
  content.reserve(sizeof head + row * ticks_ * sizeof(double) + sizeof rest_bytes + rest.size());
  const auto append = [&](const auto* values, std::size_t count)
  {
    const char* bytes = reinterpret_cast<const char*>(values);
    content.insert(content.end(), bytes, bytes + count * sizeof *values);
  };
  append(head.data(), head.size());
  // As many numbers of a row at a time as a line of the cache has.
  constexpr std::size_t kTogether = 8;
  std::vector<std::uint64_t> columns(kTogether * ticks_);
  for (std::size_t first = 0; first < row; first += kTogether)
  {
    const std::size_t count = std::min(kTogether, row - first);
    for (std::size_t tick = 0; tick < ticks_; ++tick)
      for (std::size_t k = 0; k < count; ++k)
      {
        const double* column = numbers_.data() + first + k;
        const auto bits = std::bit_cast<std::uint64_t>(column[tick * row]);
        const auto expected = std::bit_cast<std::uint64_t>(Expected(column, tick, row, first + k < poses_));
        columns[k * ticks_ + tick] = Folded(bits - expected);
      }
    append(columns.data(), count * ticks_);
  }
  append(&rest_bytes, 1);
  append(rest.data(), rest.size());
  return content;
}

TickRecordReader::TickRecordReader(std::span<const char> content, bool with_numbers)
    : with_numbers_(with_numbers), rest_(bytes_)
{
  ByteReader reader(content);
  const auto first_tick = reader.Get<std::uint64_t>();
  left_ = reader.Get<std::uint64_t>();
  const auto poses = reader.Get<std::uint64_t>();
  const auto columns = reader.GetArray<std::uint64_t>();
  if (left_ == 0 || columns.size() % left_ != 0 || poses > columns.size() / left_)
    throw std::runtime_error("journal: the rows of a block are none");
  row_ = columns.size() / left_;
  if (with_numbers_) numbers_.resize(columns.size());
  for (std::size_t k = 0; with_numbers_ && k < row_; ++k)
    for (std::size_t tick = 0; tick < left_; ++tick)
    {
      const double expected = Expected(numbers_.data() + k, tick, row_, k < poses);
      numbers_[tick * row_ + k] =
          std::bit_cast<double>(std::bit_cast<std::uint64_t>(expected) + Unfolded(columns[k * left_ + tick]));
    }
  poses_ = poses;
  tick_ = first_tick;
  bytes_ = reader.GetArray<char>();
  rest_ = ByteReader(bytes_);
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
  Get(rest_, record.state.attributes);
  record.state.moved = rest_.GetArray<std::uint32_t>();
  record.frames.resize(rest_.Get<std::uint32_t>());
  std::uint32_t number = 0;
  for (SensorFrame& frame : record.frames)
  {
    frame.tick = record.state.tick;
    frame.engine = number++;
    take(frame.values, rest_.Get<std::uint64_t>());
  }
  record.commands.resize(rest_.Get<std::uint32_t>());
  number = 0;
  for (ControlCommands& commands : record.commands)
  {
    commands.tick = record.state.tick;
    commands.host = number++;
    take(commands.values, rest_.Get<std::uint64_t>());
    Get(rest_, commands.attributes);
    commands.faults.robots = rest_.GetArray<std::uint32_t>();
    commands.faults.kinds = rest_.GetArray<FaultKind>();
  }
  if (at_ != end) throw std::runtime_error("journal: a row is too long");
  return true;
}

std::vector<char> ContentOf(const JournalStart& start) { return Written(start, kStartFields); }
JournalStart ReadStart(std::span<const char> content) { return Read<JournalStart>(content, kStartFields); }

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
