// Robots mostly go on as they did, so each column of a pose is stored as the differences of its differences, which are
// small numbers. Those of one entity are beside each other, and a general compressor then needs two to three bits for
// each. A block begins with a whole state, so that a page can show any tick after reading one block.
#include "visualiser/web/recording_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "common/space/attributes.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

constexpr std::int64_t kHalfTurn = 32767;
constexpr std::size_t kStatesOfEntities = 262'144;  // in a block: states times entities
constexpr std::size_t kFewestStates = 16;
constexpr std::size_t kMostStates = 256;
constexpr double kLargestWhole = 1 << 28;  // of an attribute that is stored as a whole number

// The bits of an entity's mode in a block: which columns change, and whether it has a quaternion instead of a heading.
constexpr unsigned kVaries[] = {1, 2, 4};
constexpr unsigned kTurns = 8;
constexpr unsigned kIsSpatial = 16;

void PutCount(std::uint64_t value, std::string& bytes)
{
  for (; value >= 128; value >>= 7U) bytes += static_cast<char>((value & 127U) | 128U);
  bytes += static_cast<char>(value);
}

// Returns 0, 1, 2, 3 … for 0, -1, 1, -2, …
std::uint64_t Zigzag(std::int64_t value)
{
  return (static_cast<std::uint64_t>(value) << 1U) ^ static_cast<std::uint64_t>(value >> 63U);
}

void PutSigned(std::int64_t value, std::string& bytes) { PutCount(Zigzag(value), bytes); }

// Writes a whole number as twice its zigzag number, and others as 1 and a float.
void PutValue(double value, std::string& bytes)
{
  if (std::abs(value) <= kLargestWhole && value == std::trunc(value))
    return PutCount(2 * Zigzag(static_cast<std::int64_t>(value)), bytes);
  PutCount(1, bytes);
  const auto number = static_cast<float>(value);
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

}  // namespace

const std::vector<std::string>& RecordingWriter::LeftOut()
{
  // Bytes that devices show in readable form.
  static const std::vector<std::string> names{"message", "radio", "report", "instruction"};
  return names;
}

RecordingWriter::RecordingWriter(const CSwarmanoidSpace& space)
    : space_(space),
      frames_(space),
      slots_(space.Movable().size()),
      most_states_(std::clamp(kStatesOfEntities / std::max<std::size_t>(slots_, 1), kFewestStates, kMostStates))
{
  for (std::uint32_t e = 0; e < space.Size(); ++e)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(e);
    for (const AttributeSpec& spec : AttributesOf(entity.GetKind()))
      if (std::ranges::find(LeftOut(), spec.name) == LeftOut().end())
        for (int element = 0; element < spec.count; ++element)
          attribute_places_.push_back(static_cast<std::uint32_t>(entity.SlotOf(spec.name, element)));
  }
  last_attributes_.resize(attribute_places_.size());
}

void RecordingWriter::Add()
{
  const std::string frame = frames_.WriteKey();
  FrameHeader header;
  std::memcpy(&header, frame.data(), sizeof header);
  const std::size_t colours = sizeof header + 20 * slots_;
  AddPoses();
  AddColours(frame.data() + colours);
  AddLists(std::string_view(frame).substr(colours + 4 * slots_), header);
  AddAttributes();
  ticks_.push_back(space_.GetTick());
}

void RecordingWriter::AddPoses()
{
  const PoseArrays& poses = space_.Poses();
  const bool begins = ticks_.empty();
  if (begins) headings_.assign(slots_, 0);
  std::size_t slot = 0;
  for (const std::uint32_t e : space_.Movable())
  {
    const double position[] = {poses.x[e], poses.y[e], poses.z[e]};
    for (std::size_t k = 0; k < 3; ++k) columns_[k].push_back(std::llround(position[k] / kUnit_m));
    const double turn[] = {poses.qx[e], poses.qy[e], poses.qz[e], poses.qw[e]};
    for (std::size_t k = 0; k < 4; ++k)
      columns_[kQuaternion + k].push_back(std::llround(std::clamp(turn[k], -1.0, 1.0) * kHalfTurn));
    const double half_turns = std::remainder(2 * std::atan2(turn[2], turn[3]) / std::numbers::pi, 2);
    const std::int64_t heading = std::llround(half_turns * kHalfTurn);
    // The heading goes on beyond a full turn instead of jumping back.
    std::int64_t& last = headings_[slot++];
    const std::int64_t turned = begins ? heading : heading - last;
    last = begins ? heading
                  : last + turned -
                        2 * kHalfTurn * std::llround(static_cast<double>(turned) / static_cast<double>(2 * kHalfTurn));
    columns_[kHeading].push_back(last);
  }
}

void RecordingWriter::AddColours(const char* colours)
{
  if (ticks_.empty())
    colours_.append(colours, 4 * slots_);
  else
  {
    std::string changes;
    std::uint64_t changed = 0;
    std::int64_t last = -1;
    for (std::size_t slot = 0; slot < slots_; ++slot)
    {
      if (std::memcmp(colours + 4 * slot, &last_colours_[4 * slot], 4) == 0) continue;
      ++changed;
      PutCount(static_cast<std::uint64_t>(static_cast<std::int64_t>(slot) - last), changes);
      last = static_cast<std::int64_t>(slot);
      changes.append(colours + 4 * slot, 4);
    }
    PutCount(changed, colours_);
    colours_ += changes;
  }
  last_colours_.assign(colours, colours + 4 * slots_);
}

// Beams, grips and rings of LEDs as they are in a frame.
void RecordingWriter::AddLists(std::string_view lists, const FrameHeader& counts)
{
  std::string now;
  for (const std::uint32_t count : {counts.beams, counts.grips, counts.rings}) PutCount(count, now);
  now += lists;
  const bool is_new = ticks_.empty() || now != last_lists_;
  lists_ += is_new ? '\1' : '\0';
  if (!is_new) return;
  lists_ += now;
  last_lists_ = std::move(now);
}

void RecordingWriter::AddAttributes()
{
  const bool begins = ticks_.empty();
  if (begins) std::ranges::fill(last_attributes_, 0);
  if (!begins && attribute_revision_ == space_.AttributeRevision()) return PutCount(0, attributes_);
  attribute_revision_ = space_.AttributeRevision();
  const SparseVector<double>& values = space_.Attributes();
  std::string changes;
  std::uint64_t changed = 0;
  std::int64_t last = -1;
  for (std::size_t number = 0; number < attribute_places_.size(); ++number)
  {
    const double value = values[attribute_places_[number]];
    if (value == last_attributes_[number]) continue;
    last_attributes_[number] = value;
    ++changed;
    PutCount(static_cast<std::uint64_t>(static_cast<std::int64_t>(number) - last), changes);
    last = static_cast<std::int64_t>(number);
    PutValue(value, changes);
  }
  PutCount(changed, attributes_);
  attributes_ += changes;
}

std::int64_t RecordingWriter::At(Column column, std::size_t state, std::size_t slot) const
{
  return columns_[column][state * slots_ + slot];
}

bool RecordingWriter::Varies(Column column, std::size_t slot) const
{
  for (std::size_t state = 1; state < ticks_.size(); ++state)
    if (At(column, state, slot) != At(column, 0, slot)) return true;
  return false;
}

void RecordingWriter::WriteColumn(Column column, std::size_t slot, bool varies, std::string& bytes) const
{
  PutSigned(At(column, 0, slot), bytes);
  if (!varies) return;
  std::int64_t step = 0;
  for (std::size_t state = 1; state < ticks_.size(); ++state)
  {
    const std::int64_t next = At(column, state, slot) - At(column, state - 1, slot);
    PutSigned(next - step, bytes);
    step = next;
  }
}

void RecordingWriter::WritePoses(std::size_t slot, std::string& bytes) const
{
  unsigned mode = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (Varies(static_cast<Column>(k), slot)) mode |= kVaries[k];
  for (const Column tilt : {kQuaternion, static_cast<Column>(kQuaternion + 1)})
    if (At(tilt, 0, slot) != 0 || Varies(tilt, slot)) mode |= kIsSpatial;
  const std::size_t first = (mode & kIsSpatial) != 0 ? kQuaternion : kHeading;
  const std::size_t end = (mode & kIsSpatial) != 0 ? kColumns : kQuaternion;
  for (std::size_t column = first; column < end; ++column)
    if (Varies(static_cast<Column>(column), slot)) mode |= kTurns;
  bytes += static_cast<char>(mode);
  for (std::size_t k = 0; k < 3; ++k) WriteColumn(static_cast<Column>(k), slot, (mode & kVaries[k]) != 0, bytes);
  for (std::size_t column = first; column < end; ++column)
    WriteColumn(static_cast<Column>(column), slot, (mode & kTurns) != 0, bytes);
}

std::string RecordingWriter::TakeBlock()
{
  std::string bytes;
  PutCount(ticks_.size(), bytes);
  PutCount(ticks_.front(), bytes);
  for (std::size_t state = 1; state < ticks_.size(); ++state) PutCount(ticks_[state] - ticks_[state - 1], bytes);
  for (std::size_t slot = 0; slot < slots_; ++slot) WritePoses(slot, bytes);
  bytes += colours_ + lists_ + attributes_;
  ticks_.clear();
  for (auto& column : columns_) column.clear();
  for (std::string* part : {&colours_, &lists_, &attributes_}) part->clear();
  return bytes;
}

}  // namespace swarmanoid
