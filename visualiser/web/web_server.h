// WebServer: the page's files by HTTP and the live state by WebSocket, on one port, in a thread of its own. Only
// its sources (web_server.cpp and the headers that it includes) know Boost.Beast.
//
// Nobody who looks can slow the caller: every function only hands over a message. Each client has one slot for each
// kind of state, which holds the latest only, and a bounded queue for what must not be lost; one that reads slowly or
// not at all gets less.
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
  std::size_t max_clients = 16;      // that have not shown the token
  std::size_t max_holders = 0;       // clients that have shown it, who have places of their own; 0: there is no token
  std::size_t max_connections = 64;  // clients, and requests for files
  std::size_t max_connections_of_address = 40;
  // When max_clients look, the time that another client has to show the token.
  std::chrono::milliseconds proof_time{5000};
  std::size_t max_message_bytes = 65536;  // of a client; longer ones end its connection
  // Of each client; after a burst of that many, the others wait unread.
  std::size_t max_messages_per_second = 200;
  std::optional<Certificate> certificate;  // with one, by TLS only
};

// What the server tells, in its own thread.
class WebServerEvents
{
public:
  virtual ~WebServerEvents() = default;
  // The first message for a new client.
  virtual std::string Welcome(std::uint64_t client) = 0;
  virtual void Received(std::uint64_t client, std::string_view text) = 0;
  virtual void Left(std::uint64_t client) = 0;
};

class WebServer
{
public:
  using Bytes = std::shared_ptr<const std::string>;

  enum class Slot
  {
    kKey,     // binary: the whole state, before the changes that refer to it
    kChange,  // binary: what has changed since; replaced by the next key
    kPast,    // binary: the whole state of a tick that is looked back at
    kPastDetails,
    kPastInside,
    kTimeline,
    kStatus,
    kColours,
    kWatched,
    kMarks,
    kDrawing,   // binary: what experiment functions draw
    kDocument,  // of the editor
    kCount
  };

  // Throws std::runtime_error if it cannot listen. The events outlive the server.
  WebServer(const WebServerSettings& settings, PageFiles files, WebServerEvents& events);
  // Sends what is ready, for a moment, and closes the connections.
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  std::uint16_t Port() const;
  // "http://127.0.0.1:8080/", or with a certificate "https://…"
  std::string Url() const;
  // Clients that have a place.
  std::size_t Clients() const;
  // Clients that have taken their last state: without any, a new one would be made for nobody.
  std::size_t Hungry() const;

  // The client has shown the token: it takes one of the places of max_holders.
  void Admit(std::uint64_t client);

  // The message that follows the welcome; those who are welcomed already get it now.
  void SetGreeting(Bytes text);
  // The state for all clients, and for those who come later.
  void Publish(Slot slot, Bytes bytes);
  // A state for one client alone.
  void SendState(std::uint64_t client, Slot slot, Bytes bytes);
  // Queued. The last 256 messages for all are repeated to those who come later.
  void Send(std::uint64_t client, Bytes text);
  void SendAll(Bytes text);
  // Frames for this client at most every so many milliseconds.
  void SetFramePeriod(std::uint64_t client, unsigned period_ms);

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swarmanoid
