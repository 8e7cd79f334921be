#include "common/bus/cold_types.h"

#include <utility>

#include "common/bus/hot_layout.h"

namespace swarmanoid
{

void ToWire(const WorldMessage& message, wire::World& wire)
{
  wire.protocol(message.protocol);
  wire.run(message.run);
  wire.experiment(message.experiment);
  wire.host(message.host);
  wire.pid(message.pid);
  wire.file(message.file);
  wire.folder(message.folder);
  wire.xml(message.xml);
  wire.seed(message.seed);
  wire.hosts(message.hosts);
  wire.spread(message.spread);
  wire.tick_seconds(message.tick_seconds);
  wire.checkpoint_every(message.checkpoint_every);
  wire.checkpoint().assign(message.checkpoint.begin(), message.checkpoint.end());
  wire.entities().resize(message.entities.size());
  for (std::size_t i = 0; i < message.entities.size(); ++i)
  {
    wire.entities()[i].id(message.entities[i].id);
    wire.entities()[i].kind(message.entities[i].kind);
    wire.entities()[i].movable(message.entities[i].movable);
    wire.entities()[i].first_slot(message.entities[i].first_slot);
  }
}

void FromWire(wire::World& wire, WorldMessage& message)
{
  message.protocol = wire.protocol();
  message.run = wire.run();
  message.experiment = std::move(wire.experiment());
  message.host = std::move(wire.host());
  message.pid = wire.pid();
  message.file = std::move(wire.file());
  message.folder = std::move(wire.folder());
  message.xml = std::move(wire.xml());
  message.seed = wire.seed();
  message.hosts = wire.hosts();
  message.spread = wire.spread();
  message.tick_seconds = wire.tick_seconds();
  message.checkpoint_every = wire.checkpoint_every();
  message.checkpoint.assign(wire.checkpoint().begin(), wire.checkpoint().end());
  message.entities.clear();
  for (wire::Entity& entity : wire.entities())
    message.entities.push_back(
        {std::move(entity.id()), std::move(entity.kind()), entity.movable(), entity.first_slot()});
}

void ToWire(const HelloMessage& message, wire::Hello& wire)
{
  wire.process(message.process);
  wire.protocol(message.protocol);
  wire.run(message.run);
  wire.name(message.name);
  wire.ready(message.ready);
}

void FromWire(wire::Hello& wire, HelloMessage& message)
{
  message.process = std::move(wire.process());
  message.protocol = wire.protocol();
  message.run = wire.run();
  message.name = std::move(wire.name());
  message.ready = wire.ready();
}

void ToWire(const ControlRequestMessage& message, wire::ControlRequest& wire)
{
  wire.client(message.client);
  wire.number(message.number);
  wire.verb(message.verb);
  wire.entity(message.entity);
  wire.numbers(message.numbers);
}

void FromWire(wire::ControlRequest& wire, ControlRequestMessage& message)
{
  message.client = std::move(wire.client());
  message.number = wire.number();
  message.verb = std::move(wire.verb());
  message.entity = std::move(wire.entity());
  message.numbers = std::move(wire.numbers());
}

void ToWire(const ControlReplyMessage& message, wire::ControlReply& wire)
{
  wire.client(message.client);
  wire.number(message.number);
  wire.ok(message.ok);
  wire.tick(message.tick);
  wire.text(message.text);
}

void FromWire(wire::ControlReply& wire, ControlReplyMessage& message)
{
  message.client = std::move(wire.client());
  message.number = wire.number();
  message.ok = wire.ok();
  message.tick = wire.tick();
  message.text = std::move(wire.text());
}

void ToWire(const StatusMessage& message, wire::Status& wire)
{
  wire.run(message.run);
  wire.tick(message.tick);
  wire.name(message.name);
  wire.text(message.text);
}

void FromWire(wire::Status& wire, StatusMessage& message)
{
  message.run = wire.run();
  message.tick = wire.tick();
  message.name = std::move(wire.name());
  message.text = std::move(wire.text());
}

void ToWire(const SavedStateMessage& message, wire::SavedState& wire)
{
  wire.run(message.run);
  wire.tick(message.tick);
  wire.name(message.name);
  wire.state().assign(message.state.begin(), message.state.end());
}

void FromWire(wire::SavedState& wire, SavedStateMessage& message)
{
  message.run = wire.run();
  message.tick = wire.tick();
  message.name = std::move(wire.name());
  message.state.assign(wire.state().begin(), wire.state().end());
}

void ToWire(const ByeMessage& message, wire::Bye& wire)
{
  wire.run(message.run);
  wire.tick(message.tick);
  wire.name(message.name);
  wire.to(message.to);
  wire.error(message.error);
}

void FromWire(wire::Bye& wire, ByeMessage& message)
{
  message.run = wire.run();
  message.tick = wire.tick();
  message.name = std::move(wire.name());
  message.to = std::move(wire.to());
  message.error = std::move(wire.error());
}

void ToWire(const ViewMessage& message, wire::View& wire)
{
  wire.run(message.run);
  wire.tick(message.snapshot.tick);
  wire.source(0);
  wire.poses(message.snapshot.poses);
  wire.flags(message.snapshot.last ? kFlagLastOrTerminate : 0U);
  wire.attributes(message.snapshot.attributes);
  wire.real_time_factor(message.snapshot.real_time_factor);
}

void FromWire(wire::View& wire, ViewMessage& message)
{
  message.run = wire.run();
  message.snapshot.tick = wire.tick();
  message.snapshot.poses = std::move(wire.poses());
  message.snapshot.last = (wire.flags() & kFlagLastOrTerminate) != 0;
  message.snapshot.attributes = std::move(wire.attributes());
  message.snapshot.real_time_factor = wire.real_time_factor();
}

}  // namespace swarmanoid
