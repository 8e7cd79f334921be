// The fields of every message, in the order of idl/swarmanoid.idl. The code that counts, writes, reads and checks the
// bytes of a message (cdr.h) visits them here. A test compares the bytes with those of the types made from the IDL.
// Used only by the bus.
#pragma once

#include <numeric>

#include "common/bus/topics/cdr.h"
#include "common/messages/attribute_changes.h"

namespace swarmanoid
{

// Values of the IDL; a test compares them.
inline constexpr std::uint32_t kFlagLast = 1;
inline constexpr std::uint32_t kFlagTerminate = 1;
inline constexpr std::uint32_t kFlagRepeated = 2;
inline constexpr std::uint32_t kFlagSave = 4;
inline constexpr std::uint32_t kFlagUniformX = 8;  // and the next six bits

// A message is sent on the topic of this name, as the type swarmanoid::wire::<name>.
template <class Message>
inline constexpr const char* kTopicOf = nullptr;

// ---- The messages of a tick: a header, then the rest. Their arrays stand where no padding is needed. ----

template <>
inline constexpr const char* kTopicOf<SpaceState> = "SpaceState";
template <>
inline constexpr const char* kTopicOf<LocalState> = "LocalState";
template <>
inline constexpr const char* kTopicOf<ControlCommands> = "ControlCommands";
template <>
inline constexpr const char* kTopicOf<UpdateMessage> = "EngineUpdate";
template <>
inline constexpr const char* kTopicOf<SensorFrame> = "SensorFrame";
template <>
inline constexpr const char* kTopicOf<DrawnMessage> = "Drawn";

template <>
inline constexpr const char* kTopicOf<RegionTaskMessage> = "RegionTask";
template <>
inline constexpr const char* kTopicOf<RegionHaloMessage> = "RegionHalo";
template <>
inline constexpr const char* kTopicOf<RegionResultMessage> = "RegionResult";

template <class Archive>
void Fields(Archive& archive, MessageHeader& header)
{
  archive.Integer("run", header.run);
  archive.Integer("tick", header.tick);
  archive.Short("source", header.source);
  archive.Short("incarnation", header.incarnation);
}

template <class Archive>
void Fields(Archive& archive, AttributeChanges& changes)
{
  archive.Array("attribute_values", changes.values);
  archive.Array("attribute_slots", changes.slots);
  if (!IsOrdered(changes)) RefuseField("attribute_slots", "they do not ascend, or are not as many as the values");
}

// Poses, and the flags behind them.
template <class Archive>
void PoseFields(Archive& archive, std::vector<double>& poses, std::initializer_list<FlagBit> flags)
{
  if constexpr (Archive::kReads)
  {
    archive.Array("poses", poses);
    constexpr std::uint32_t kUniform = ((1U << kPoseColumns) - 1) * kFlagUniformX;
    const std::uint32_t uniform = archive.Flags("flags", flags, kUniform) / kFlagUniformX;
    if (!SpreadColumns(poses, uniform)) RefuseField("poses", "they are not as many as the flags say");
  }
  else
  {
    const std::uint32_t uniform = UniformColumns(poses);
    archive.Columns(poses, uniform);
    archive.Flags("flags", flags, uniform * kFlagUniformX);
  }
}

// TickLimits checks the shapes, because it knows the entities.
template <class Archive>
void Fields(Archive& archive, Drawing& drawing)
{
  archive.List("shapes", drawing.shapes,
               [](Archive& a, DrawnShape& shape)
               {
                 a.Choice("shapes.kind", shape.kind, DrawnShape::Kind::kPoints, DrawnShape::Kind::kText);
                 a.Integer("shapes.frame", shape.frame);
                 a.Integer("shapes.colour", shape.colour);
                 a.Integer("shapes.width_16", shape.width_16);
                 a.Integer("shapes.count", shape.count);
               });
  archive.Array("shape_numbers", drawing.numbers);
  archive.List("shape_texts", drawing.texts, [](Archive& a, std::string& text) { a.Text("shape_texts", text); });
}

// The common first fields of the full state and the state for one process.
template <class Archive>
void StateFields(Archive& archive, MessageHeader& header, SpaceState& message)
{
  PoseFields(archive, message.poses,
             {{kFlagLast, &message.last}, {kFlagRepeated, &header.repeated}, {kFlagSave, &header.save}});
  Fields(archive, message.attributes);
  if constexpr (Archive::kReads) message.tick = header.tick;
}

template <class Archive>
void Fields(Archive& archive, MessageHeader& header, SpaceState& message)
{
  StateFields(archive, header, message);
  archive.Array("moved", message.moved);
  Fields(archive, message.drawing);
}

template <class Archive>
void Fields(Archive& archive, MessageHeader& header, LocalState& message)
{
  StateFields(archive, header, message);
  archive.Array("entities", message.entities);
  archive.Array("near", message.near);
  archive.Array("moved", message.moved);
}

template <class Archive>
void Fields(Archive& archive, MessageHeader& header, ControlCommands& message)
{
  archive.Array("values", message.values);
  archive.Flags("flags", {{kFlagRepeated, &header.repeated}});
  Fields(archive, message.attributes);
  archive.Array("fault_robots", message.faults.robots);
  archive.Array("fault_kinds", message.faults.kinds);
  archive.Array("fault_texts", message.faults.texts);
  if constexpr (Archive::kReads) message.tick = header.tick, message.host = header.source;
}

template <class Archive>
void Fields(Archive& archive, MessageHeader& header, UpdateMessage& message)
{
  PoseFields(archive, message.poses, {{kFlagRepeated, &header.repeated}});
  Fields(archive, message.attributes);
  archive.Array("recorded", message.recorded);
  if constexpr (Archive::kReads) message.tick = header.tick, message.engine = header.source;
}

template <class Archive>
void Fields(Archive& archive, MessageHeader& header, SensorFrame& message)
{
  archive.Array("values", message.values);
  if constexpr (Archive::kReads) message.tick = header.tick, message.engine = header.source;
}

template <class Archive>
void Fields(Archive& archive, MessageHeader& header, DrawnMessage& message)
{
  archive.Flags("flags", {{kFlagTerminate, &message.terminate}, {kFlagRepeated, &header.repeated}});
}

template <class Archive>
void RegionFields(Archive& archive, MessageHeader& header, RegionMessage& message)
{
  archive.Integer("epoch", message.epoch);
  archive.Integer("number", message.number);
  archive.Flags("flags", {{kFlagRepeated, &header.repeated}});
  archive.Array("sizes", message.sizes);
  archive.Array("bytes", message.bytes);
  if (std::accumulate(message.sizes.begin(), message.sizes.end(), std::uint64_t{0}) != message.bytes.size())
    RefuseField("sizes", "they are not those of the bytes");
}
template <class Archive>
void Fields(Archive& archive, MessageHeader& header, RegionTaskMessage& message)
{
  RegionFields(archive, header, message);
}
template <class Archive>
void Fields(Archive& archive, MessageHeader& header, RegionHaloMessage& message)
{
  RegionFields(archive, header, message);
}
template <class Archive>
void Fields(Archive& archive, MessageHeader& header, RegionResultMessage& message)
{
  RegionFields(archive, header, message);
}

// ---- All others ----

template <>
inline constexpr const char* kTopicOf<WorldMessage> = "World";
template <>
inline constexpr const char* kTopicOf<JoinMessage> = "Join";
template <>
inline constexpr const char* kTopicOf<ViewMessage> = "View";
template <>
inline constexpr const char* kTopicOf<ControlRequestMessage> = "ControlRequest";
template <>
inline constexpr const char* kTopicOf<ControlReplyMessage> = "ControlReply";
template <>
inline constexpr const char* kTopicOf<StatusMessage> = "Status";
template <>
inline constexpr const char* kTopicOf<SavedStateMessage> = "SavedState";
template <>
inline constexpr const char* kTopicOf<RecoveryRequestMessage> = "RecoveryRequest";
template <>
inline constexpr const char* kTopicOf<RecoveryBlockMessage> = "RecoveryBlock";
template <>
inline constexpr const char* kTopicOf<ViewRequestMessage> = "ViewRequest";
template <>
inline constexpr const char* kTopicOf<RunStatusMessage> = "RunStatus";
template <>
inline constexpr const char* kTopicOf<RobotStatusMessage> = "RobotStatus";
template <>
inline constexpr const char* kTopicOf<LeaveMessage> = "Leave";

template <class Archive>
void Fields(Archive& archive, WorldMessage& message)
{
  archive.Version("protocol", message.protocol);
  archive.Integer("run", message.run);
  archive.Name("experiment", message.experiment);
  archive.Name("host", message.host);
  archive.Integer("pid", message.pid);
  archive.Exact("file", message.file);
  archive.Exact("folder", message.folder);
  archive.Exact("xml", message.xml);
  archive.Integer("seed", message.seed);
  archive.Integer("hosts", message.hosts.hosts);
  archive.Array("host_of_robots", message.hosts.of_robots);
  archive.Bool("spread", message.spread);
  archive.Number("tick_seconds", message.tick_seconds);
  archive.Integer("checkpoint_every", message.checkpoint_every);
  archive.Array("checkpoint", message.checkpoint);
  archive.Bool("recorded", message.recorded);
  archive.List("entities", message.entities,
               [](Archive& a, WorldEntity& entity)
               {
                 a.Exact("entities.id", entity.id);
                 a.Name("entities.kind", entity.kind);
                 a.Bool("entities.movable", entity.movable);
                 a.Integer("entities.first_slot", entity.first_slot);
               });
  archive.List("libraries", message.libraries,
               [](Archive& a, WorldLibrary& library)
               {
                 a.Exact("libraries.name", library.name);
                 a.Name("libraries.digest", library.digest);
               });
  archive.Integer("known_until", message.known.until);
  archive.List("faults", message.known.faults,
               [](Archive& a, RecordedFault& fault)
               {
                 a.Integer("faults.tick", fault.tick);
                 a.Integer("faults.robot", fault.robot);
                 a.Choice("faults.kind", fault.kind, FaultKind::kThrew, FaultKind::kTooSlow);
               });
}

template <class Archive>
void Fields(Archive& archive, JoinMessage& message)
{
  archive.Name("process", message.process);
  archive.Version("protocol", message.protocol);
  archive.Integer("run", message.run);
  archive.Name("name", message.name);
  archive.Bool("ready", message.ready);
  archive.Integer("incarnation", message.incarnation);
  archive.Name("machine", message.machine);
  archive.Number("reach", message.reach);
}

template <class Archive>
void Fields(Archive& archive, ViewMessage& message)
{
  archive.Integer("run", message.run);
  archive.Integer("tick", message.snapshot.tick);
  archive.Constant("source", 0);
  PoseFields(archive, message.snapshot.poses, {{kFlagLast, &message.snapshot.last}});
  archive.Array("attributes", message.snapshot.attributes);
  archive.Number("real_time_factor", message.snapshot.real_time_factor);
  Fields(archive, message.snapshot.drawing);
}

// A union: the number of the alternative, then its value.
template <class Archive>
void Fields(Archive& archive, ControlValue& value)
{
  auto kind = static_cast<std::uint32_t>(value.index());
  archive.Integer("arguments.kind", kind);
  if constexpr (Archive::kReads)
  {
    if (kind >= std::variant_size_v<ControlValue>) RefuseField("arguments.kind", "there is no such kind of value");
    const ControlValue kinds[] = {std::string(), std::int64_t{0}, 0.0, std::vector<double>()};
    value = kinds[kind];
  }
  if (auto* name = std::get_if<std::string>(&value)) archive.Name("arguments.value", *name);
  if (auto* whole = std::get_if<std::int64_t>(&value)) archive.Signed("arguments.value", *whole);
  if (auto* number = std::get_if<double>(&value)) archive.Number("arguments.value", *number);
  if (auto* pose = std::get_if<std::vector<double>>(&value)) archive.Array("arguments.value", *pose);
}

template <class Archive>
void Fields(Archive& archive, ControlRequestMessage& message)
{
  archive.Name("client", message.client);
  archive.Integer("number", message.number);
  archive.Name("verb", message.verb);
  archive.List("arguments", message.arguments,
               [](Archive& a, ControlArgument& argument)
               {
                 a.Name("arguments.name", argument.name);
                 Fields(a, argument.value);
               });
  archive.Name("user", message.user);
  archive.Integer("run", message.run);
}

template <class Archive>
void Fields(Archive& archive, ControlReplyMessage& message)
{
  archive.Name("client", message.client);
  archive.Integer("number", message.number);
  archive.Bool("ok", message.ok);
  archive.Integer("tick", message.tick);
  archive.Text("text", message.text);
}

template <class Archive>
void Fields(Archive& archive, StatusMessage& message)
{
  archive.Integer("run", message.run);
  archive.Integer("tick", message.tick);
  archive.Name("name", message.name);
  archive.Text("text", message.text);
}

template <class Archive>
void Fields(Archive& archive, SavedStateMessage& message)
{
  archive.Integer("run", message.run);
  archive.Integer("tick", message.tick);
  archive.Name("name", message.name);
  archive.Array("state", message.state);
}

template <class Archive>
void Fields(Archive& archive, RecoveryRequestMessage& message)
{
  archive.Integer("run", message.run);
  archive.Name("process", message.process);
  archive.Name("name", message.name);
  archive.Integer("number", message.number);
}

template <class Archive>
void Fields(Archive& archive, RecoveryBlockMessage& message)
{
  archive.Integer("run", message.run);
  archive.Name("process", message.process);
  archive.Integer("number", message.number);
  archive.Integer("count", message.count);
  archive.Array("block", message.block);
}

template <class Archive>
void Fields(Archive& archive, ViewRequestMessage& message)
{
  archive.Name("client", message.client);
  archive.Integer("run", message.run);
  archive.Number("views", message.views);
  archive.Bool("every_tick", message.every_tick);
  archive.Array("robots", message.robots);
}

template <class Archive>
void Fields(Archive& archive, RunStatusMessage& message)
{
  using Phase = RunStatus::Phase;
  RunStatus& status = message.status;
  archive.Integer("run", message.run);
  archive.Integer("tick", status.tick);
  archive.Choice("phase", status.phase, Phase::kWaiting, Phase::kFinished);
  archive.Number("speed_wanted", status.speed_wanted);
  archive.Number("real_time_factor", status.real_time_factor);
  archive.Number("ticks_per_second", status.ticks_per_second);
  archive.Text("ended", status.ended);
  archive.List("processes", status.processes,
               [](Archive& a, ProcessStatus& process)
               {
                 a.Name("processes.name", process.name);
                 a.Name("processes.process", process.process);
                 a.Integer("processes.tick", process.tick);
                 a.Number("processes.late_s", process.late_s);
                 a.Text("processes.doing", process.doing);
               });
}

template <class Archive>
void Fields(Archive& archive, std::vector<DeviceStatus>& devices)
{
  archive.List("devices", devices,
               [](Archive& a, DeviceStatus& device)
               {
                 a.Text("devices.type", device.type);
                 a.List("readings", device.readings,
                        [](Archive& b, CCI_Reading& reading)
                        {
                          b.Text("readings.name", reading.name);
                          b.Text("readings.unit", reading.unit);
                          b.AnyNumber("readings.value", reading.value);  // a range without an echo is infinite
                        });
               });
}

template <class Archive>
void Fields(Archive& archive, RobotStatusMessage& message)
{
  archive.Integer("run", message.run);
  archive.Integer("tick", message.tick);
  archive.Integer("source", message.source);
  archive.List("robots", message.robots,
               [](Archive& a, RobotStatus& robot)
               {
                 a.Integer("robots.entity", robot.entity);
                 a.Text("robots.controller", robot.controller);
                 a.Text("robots.text", robot.text);
                 a.Text("robots.state", robot.state);
                 Fields(a, robot.sensors);
                 Fields(a, robot.actuators);
               });
  if constexpr (Archive::kReads)
    for (RobotStatus& robot : message.robots) robot.tick = message.tick;
}

template <class Archive>
void Fields(Archive& archive, LeaveMessage& message)
{
  archive.Integer("run", message.run);
  archive.Integer("tick", message.tick);
  archive.Name("name", message.name);
  archive.Name("process", message.process);
  archive.Text("error", message.error);
}

// Returns the key of a topic with instances, nullptr for others.
template <class Message>
const std::string* KeyOf(const Message&)
{
  return nullptr;
}
inline const std::string* KeyOf(const JoinMessage& message) { return &message.process; }
inline const std::string* KeyOf(const ViewRequestMessage& message) { return &message.client; }

}  // namespace swarmanoid
