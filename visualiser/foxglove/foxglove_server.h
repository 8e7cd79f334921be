// FoxgloveServer: a WebSocket server of the protocol foxglove.websocket.v1 (https://github.com/foxglove/ws-protocol,
// docs/spec.md) with JSON messages, in its own thread. For foxglove_render.
//
// Clients cannot slow the caller. Each client has one slot for each subscribed channel, which holds only the latest
// message; slow clients get fewer messages.
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
  std::string schema;  // a JSON schema
};

struct FoxgloveServerSettings
{
  std::string address = "127.0.0.1";
  std::uint16_t port = 8765;
  // The allowed origins of pages, as browsers name them ("https://app.foxglove.dev"). Pages of this machine, and
  // programs, which have no origin, are always allowed.
  std::vector<std::string> origins;
  std::string name;  // shown by clients
  std::size_t max_clients = 16;
  std::size_t max_message_bytes = 65536;  // the limit for a client's message; a longer one ends its connection
};

class FoxgloveServer
{
public:
  // Throws std::runtime_error if the server cannot listen.
  FoxgloveServer(const FoxgloveServerSettings& settings, std::vector<FoxgloveChannel> channels);
  // Sends the waiting messages, for a short time, and closes the connections.
  ~FoxgloveServer();
  FoxgloveServer(const FoxgloveServer&) = delete;
  FoxgloveServer& operator=(const FoxgloveServer&) = delete;

  std::uint16_t Port() const;
  std::size_t Subscribers(std::size_t channel) const;
  // Returns the number of subscriptions to a channel since the start. A larger number means that a message is needed at
  // once.
  std::uint64_t Subscriptions(std::size_t channel) const;
  // Sends a message to all subscribers; `time` in ns.
  void Publish(std::size_t channel, std::uint64_t time, std::string json);
  // Sets the clock of the clients, in ns.
  void SetTime(std::uint64_t time);

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swarmanoid
