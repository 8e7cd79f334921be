// WebServer: serves the page's files by HTTP and the live state by WebSocket, on one port, in its own thread. Only its
// sources (web_server.cpp and the headers that it includes) know Boost.Beast.
//
// Clients cannot slow the caller, since every function only passes on a message. Each client has one slot for each kind
// of state, which holds the latest only, and a bounded queue for messages that must not be lost. A slow client gets
// fewer states.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "visualiser/web/certificate.h"
#include "visualiser/web/page_files.h"

namespace swarmanoid
{

struct WebServerSettings
{
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;            // 0: a free one
  std::size_t max_clients = 16;      // limit of clients that have not proved the token
  std::size_t max_holders = 0;       // limit of clients that have, with places of their own; 0: there is no token
  std::size_t max_connections = 64;  // clients, and requests for files
  std::size_t max_connections_of_address = 40;
  // The time in which another client must prove the token, if max_clients are connected.
  std::chrono::milliseconds proof_time{5000};
  std::size_t max_message_bytes = 65536;  // limit for a client's message; longer ones end its connection
  // The limit is for each client. After a burst of that many, the other messages wait unread.
  std::size_t max_messages_per_second = 200;
  std::optional<Certificate> certificate;  // if it is set, only TLS is accepted
};

// The events of the server. It calls these functions in its own thread.
class WebServerEvents
{
public:
  virtual ~WebServerEvents() = default;
  // Returns the first message for a new client.
  virtual std::string Welcome(std::uint64_t client) = 0;
  // Gets a text message of a client.
  virtual void Received(std::uint64_t client, std::string_view text) = 0;
  // Called when a client has disconnected.
  virtual void Left(std::uint64_t client) = 0;
};

class WebServer
{
public:
  using Bytes = std::shared_ptr<const std::string>;

  enum class Slot
  {
    kKey,     // binary: the whole state, which later changes refer to
    kChange,  // binary: the changes since the key; replaced by the next key
    kPast,    // binary: the whole state of a requested tick of the past
    kPastDetails,
    kRobotPlayback,
    kTimeline,
    kStatus,
    kColours,
    kWatched,
    kMarks,
    kDrawing,   // binary: drawings of experiment functions
    kDocument,  // text: the document of the editor
    kCount
  };

  // Throws std::runtime_error if it cannot listen. The events must outlive the server.
  WebServer(const WebServerSettings& settings, PageFiles files, WebServerEvents& events);
  // Sends the waiting messages, for a short time, and closes the connections.
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  // Returns the port, also if the system has chosen it.
  std::uint16_t Port() const;
  // Returns "http://127.0.0.1:8080/", or with a certificate "https://…".
  std::string Url() const;
  // Returns the number of clients that have a place.
  std::size_t Clients() const;
  // Returns the number of clients that have taken their last state. If it is 0, no new state is needed.
  std::size_t Hungry() const;

  // Gives a client that has proved the token one of the places of max_holders.
  void Admit(std::uint64_t client);

  // Sets the message that follows the welcome. Clients that are welcomed already get it now.
  void SetGreeting(Bytes text);
  // Publishes the state for all present and later clients.
  void Publish(Slot slot, Bytes bytes);
  // Sets a state for one client alone.
  void SendState(std::uint64_t client, Slot slot, Bytes bytes);
  // Queues a message. The last 256 messages for all clients are repeated to later ones.
  void Send(std::uint64_t client, Bytes text);
  void SendAll(Bytes text);
  // Passes connections to /run/stream on to the stream of another server, at this port of this machine. 0: refuses
  // them. That server decides which of them may look or control.
  void SetRelay(std::uint16_t port);
  // Limits the frames for this client to one in so many milliseconds.
  void SetFramePeriod(std::uint64_t client, unsigned period_ms);

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swarmanoid
