// The internals of WebServer, only for its own sources.
#pragma once

#include <array>
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "visualiser/web/web_server.h"

namespace swarmanoid
{

namespace asio = boost::asio;
namespace beast = boost::beast;
using tcp = asio::ip::tcp;
using ErrorCode = beast::error_code;

inline constexpr std::size_t kSlots = static_cast<std::size_t>(WebServer::Slot::kCount);
constexpr std::size_t Index(WebServer::Slot slot) { return static_cast<std::size_t>(slot); }

// All members below are used in the server's thread, except the constructor, the destructor and the counters.
class WebServer::Impl
{
public:
  class Client;      // a connected page
  class Connection;  // a connection that has not become a client
  class Relay;       // a connection that is passed on to another server

  // A connection without a place. It makes room for a new one when there are too many.
  class Droppable
  {
  public:
    Droppable(Impl& server, asio::ip::address from) : address(std::move(from)), droppables_(server.droppables_) {}
    virtual ~Droppable() { HoldPlace(); }
    Droppable(const Droppable&) = delete;
    Droppable& operator=(const Droppable&) = delete;

    // Closes the connection.
    virtual void Drop() = 0;

    const asio::ip::address address;

  protected:
    // Makes it the last one that makes room.
    void GivePlace()
    {
      HoldPlace();
      entry_ = droppables_.insert(droppables_.end(), this);
    }
    // Makes it keep its place.
    void HoldPlace()
    {
      if (entry_) droppables_.erase(*entry_);
      entry_.reset();
    }

  private:
    std::list<Droppable*>& droppables_;
    std::optional<std::list<Droppable*>::iterator> entry_;
  };

  Impl(const WebServerSettings& settings, PageFiles files, WebServerEvents& events);
  ~Impl();

  void Post(std::function<void()> work) { asio::post(context_, std::move(work)); }
  void Accept();
  void Welcome(tcp::socket socket);
  // Drops the connection that has sent no request for longest, of an address or of any. Returns false if all have
  // places.
  bool DropOne(const std::optional<asio::ip::address>& address);
  void Gone(const asio::ip::address& address);
  bool HasRoom() const;
  void Join(const std::shared_ptr<Client>& client);
  // Sends a client the current state of the run.
  void Greet(Client& client) const;
  void Admit(Client& client);
  void QueueForAll(const Bytes& text);
  void Leave(std::uint64_t client);
  void Count();
  template <class Work>
  void With(std::uint64_t client, Work work);

  WebServerSettings settings_;
  PageFiles files_;
  WebServerEvents& events_;
  std::size_t connections_ = 0;
  std::map<asio::ip::address, std::size_t> connections_of_;
  std::list<Droppable*> droppables_;  // the next one to make room is first
  asio::io_context context_{1};
  std::optional<asio::ssl::context> tls_;
  tcp::acceptor acceptor_{context_};
  asio::steady_timer pause_{context_};  // delay of the next accept after a failed one
  std::uint16_t port_ = 0;
  std::uint16_t relay_port_ = 0;
  std::string url_;
  std::map<std::uint64_t, std::shared_ptr<Client>> clients_;
  std::size_t watchers_ = 0;  // number of clients with a place that have not proved the token
  std::size_t holders_ = 0;   // number of clients that have
  std::uint64_t last_client_ = 0;
  bool closing_ = false;
  Bytes greeting_;
  std::array<Bytes, kSlots> states_;
  std::deque<Bytes> history_;
  std::atomic<std::size_t> client_count_{0};
  std::atomic<std::size_t> hungry_{0};
  std::thread thread_;
};

}  // namespace swarmanoid
