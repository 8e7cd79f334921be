// FoxgloveServer: a WebSocket server of the protocol foxglove.websocket.v1
// (https://github.com/foxglove/ws-protocol, docs/spec.md) with JSON messages, in a thread of its own. For
// foxglove_render.
//
// Nobody who looks can slow the caller: each client has one place for each channel it subscribed to, which holds the
// latest message only; who reads slowly gets fewer.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace swarmanoid
{

struct FoxgloveChannel
{
  std::string topic;
  std::string schema_name;
  std::string schema;  // of JSON
};

struct FoxgloveServerSettings
{
  std::string address = "127.0.0.1";
  std::uint16_t port = 8765;
  // Pages of other places are refused, as their browsers name them ("https://app.foxglove.dev"); those of this machine
  // and programs, which name none, are not.
  std::vector<std::string> origins;
  std::string name;  // shown by clients
  std::size_t max_clients = 16;
  std::size_t max_message_bytes = 65536;  // of a client; a longer one ends its connection
};

class FoxgloveServer
{
public:
  // Throws std::runtime_error if it cannot listen.
  FoxgloveServer(const FoxgloveServerSettings& settings, std::vector<FoxgloveChannel> channels);
  // Sends what is ready, for a moment, and closes the connections.
  ~FoxgloveServer();
  FoxgloveServer(const FoxgloveServer&) = delete;
  FoxgloveServer& operator=(const FoxgloveServer&) = delete;

  std::uint16_t Port() const;
  std::size_t Subscribers(std::size_t channel) const;
  // How many have ever subscribed to a channel: one more asks for a message at once.
  std::uint64_t Subscriptions(std::size_t channel) const;
  // A message for all subscribers; `time` in ns.
  void Publish(std::size_t channel, std::uint64_t time, std::string json);
  // The clock of the clients, in ns.
  void SetTime(std::uint64_t time);

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swarmanoid
