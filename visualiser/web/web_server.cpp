#include "visualiser/web/web_server.h"

#include <pthread.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

namespace swarmanoid
{
namespace
{

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using Clock = std::chrono::steady_clock;
using ErrorCode = beast::error_code;

constexpr auto kRequestTime = std::chrono::seconds(15);
constexpr auto kFarewellTime = std::chrono::milliseconds(400);
constexpr std::size_t kRequestBytes = 8192;
constexpr std::size_t kQueueLength = 512;
constexpr std::size_t kHistoryLength = 256;
constexpr std::size_t kSlots = static_cast<std::size_t>(WebServer::Slot::kCount);
// Several frames of thousands of robots; what the system takes beyond that is only late.
constexpr int kSocketBytes = 1 << 20;

constexpr std::size_t Index(WebServer::Slot slot) { return static_cast<std::size_t>(slot); }

}  // namespace

// Everything below runs in the server's thread, but for the constructor, the destructor and the counters.
class WebServer::Impl
{
public:
  class Client;
  class Connection;

  Impl(const WebServerSettings& settings, PageFiles files, WebServerEvents& events);
  ~Impl();

  void Post(std::function<void()> work) { asio::post(context_, std::move(work)); }
  void Accept();
  void Join(const std::shared_ptr<Client>& client);
  void Leave(std::uint64_t client);
  void Count();
  template <class Work>
  void With(std::uint64_t client, Work work);

  WebServerSettings settings_;
  PageFiles files_;
  WebServerEvents& events_;
  std::size_t connections_ = 0;
  asio::io_context context_{1};
  tcp::acceptor acceptor_{context_};
  asio::steady_timer pause_{context_};  // before the next accept, after a failed one
  std::uint16_t port_ = 0;
  std::string url_;
  std::map<std::uint64_t, std::shared_ptr<Client>> clients_;
  std::uint64_t last_client_ = 0;
  bool closing_ = false;
  Bytes greeting_;
  std::array<Bytes, kSlots> states_;
  std::deque<Bytes> history_;
  std::atomic<std::size_t> client_count_{0};
  std::atomic<std::size_t> hungry_{0};
  std::thread thread_;
};

// One page that looks.
class WebServer::Impl::Client : public std::enable_shared_from_this<Client>
{
public:
  Client(Impl& server, beast::tcp_stream stream, Authority authority)
      : server_(server), stream_(std::move(stream)), authority_(authority)
  {
  }

  void Run(http::request<http::empty_body> request)
  {
    request_ = std::move(request);
    ErrorCode ignored;
    auto& socket = beast::get_lowest_layer(stream_).socket();
    socket.set_option(tcp::no_delay(true), ignored);
    socket.set_option(asio::socket_base::send_buffer_size(kSocketBytes), ignored);
    beast::get_lowest_layer(stream_).expires_never();
    websocket::stream_base::timeout times = websocket::stream_base::timeout::suggested(beast::role_type::server);
    times.keep_alive_pings = true;
    times.idle_timeout = std::chrono::seconds(60);
    stream_.set_option(times);
    // Whole messages in one piece: half the cost of sending.
    stream_.auto_fragment(false);
    stream_.write_buffer_bytes(65536);
    stream_.read_message_max(server_.settings_.max_message_bytes);
    stream_.async_accept(request_,
                         [self = shared_from_this()](ErrorCode error)
                         {
                           if (error) return self->Gone();
                           self->open_ = true;
                           self->server_.Join(self);
                           self->Read();
                           self->Write();
                         });
  }

  void Put(Slot slot, Bytes bytes)
  {
    if (slot == Slot::kFrame && frame_period_.count() > 0)
    {
      const auto now = Clock::now();
      if (now - frame_time_ < frame_period_) return;
      frame_time_ = now;
    }
    slots_[Index(slot)] = std::move(bytes);
    Write();
  }

  void Queue(Bytes text)
  {
    if (queue_.size() >= kQueueLength) queue_.pop_front();
    queue_.push_back(std::move(text));
    Write();
  }

  void SetFramePeriod(std::chrono::milliseconds period) { frame_period_ = period; }
  bool IsHungry() const { return open_ && !writing_ && !slots_[Index(Slot::kFrame)]; }
  Authority GetAuthority() const { return authority_; }

  // When everything is sent.
  void Close()
  {
    closing_ = true;
    Write();
  }

  std::uint64_t id = 0;

private:
  void Read()
  {
    stream_.async_read(buffer_,
                       [self = shared_from_this()](ErrorCode error, std::size_t)
                       {
                         if (error) return self->Gone();
                         const auto data = self->buffer_.cdata();
                         if (self->stream_.got_text())
                           self->server_.events_.Received(self->id, self->authority_,
                                                          {static_cast<const char*>(data.data()), data.size()});
                         self->buffer_.consume(self->buffer_.size());
                         self->Read();
                       });
  }

  void Write()
  {
    if (!open_ || writing_) return;
    bool binary = false;
    Bytes bytes = Next(binary);
    if (!bytes)
    {
      if (closing_) SayGoodbye();
      return;
    }
    writing_ = true;
    stream_.binary(binary);
    const auto place = asio::buffer(*bytes);
    stream_.async_write(place,
                        [self = shared_from_this(), bytes](ErrorCode error, std::size_t)
                        {
                          self->writing_ = false;
                          if (error) return self->Gone();
                          self->Write();
                          self->server_.Count();
                        });
  }

  // What is to be sent next: the queue first, then the slots in turn.
  Bytes Next(bool& binary)
  {
    if (!queue_.empty())
    {
      Bytes bytes = std::move(queue_.front());
      queue_.pop_front();
      return bytes;
    }
    for (std::size_t i = 0; i < kSlots; ++i)
    {
      const std::size_t slot = (next_slot_ + i) % kSlots;
      if (!slots_[slot]) continue;
      next_slot_ = (slot + 1) % kSlots;
      binary = slot == Index(Slot::kFrame);
      return std::exchange(slots_[slot], nullptr);
    }
    return nullptr;
  }

  void SayGoodbye()
  {
    open_ = false;
    stream_.async_close(websocket::close_code::going_away, [self = shared_from_this()](ErrorCode) { self->Gone(); });
  }

  void Gone()
  {
    open_ = false;
    if (gone_) return;
    gone_ = true;
    --server_.connections_;
    ErrorCode ignored;
    beast::get_lowest_layer(stream_).socket().close(ignored);
    if (id != 0) server_.Leave(id);
  }

  Impl& server_;
  websocket::stream<beast::tcp_stream> stream_;
  Authority authority_;
  http::request<http::empty_body> request_;
  beast::flat_buffer buffer_;
  std::deque<Bytes> queue_;
  std::array<Bytes, kSlots> slots_;
  std::size_t next_slot_ = 0;
  std::chrono::milliseconds frame_period_{0};
  Clock::time_point frame_time_;
  bool open_ = false;
  bool writing_ = false;
  bool closing_ = false;
  bool gone_ = false;
};

// One connection that asks for files, until it becomes a client.
class WebServer::Impl::Connection : public std::enable_shared_from_this<Connection>
{
public:
  Connection(Impl& server, tcp::socket socket) : server_(server), stream_(std::move(socket)) {}
  ~Connection()
  {
    if (!handed_over_) --server_.connections_;
  }

  void Read()
  {
    parser_.emplace();
    parser_->header_limit(kRequestBytes);
    parser_->body_limit(0);
    stream_.expires_after(kRequestTime);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](ErrorCode error, std::size_t)
                     {
                       if (error == http::error::header_limit)
                         return self->Refuse(http::status::request_header_fields_too_large, "the request is too long");
                       if (error == http::error::body_limit)
                         return self->Refuse(http::status::payload_too_large, "a request has no body here");
                       if (!error) self->Answer();
                     });
  }

private:
  void Answer()
  {
    const auto& request = parser_->get();
    const std::string_view host = Field(http::field::host);
    if (!IsKnownHost(host)) return Refuse(http::status::forbidden, "this server is not known by that name");
    const std::string_view target(request.target().data(), request.target().size());
    if (websocket::is_upgrade(request)) return Upgrade(target);
    if (request.method() != http::verb::get && request.method() != http::verb::head)
      return Refuse(http::status::method_not_allowed, "only GET and HEAD are answered");
    const PageFile* file = server_.files_.Find(PathOf(target));
    if (file == nullptr) return Refuse(http::status::not_found, "there is no such file");
    Respond(http::status::ok, file->type, file->bytes);
  }

  void Upgrade(std::string_view target)
  {
    if (PathOf(target) != "/stream") return Refuse(http::status::not_found, "the stream is at /stream");
    if (!IsOwnOrigin(Field(http::field::origin), Field(http::field::host)))
      return Refuse(http::status::forbidden, "a page of another site may not look");
    if (server_.clients_.size() >= server_.settings_.max_clients)
      return Refuse(http::status::service_unavailable, "as many pages look as may");
    const Authority authority = AuthorityOf(server_.settings_.access, QueryValue(target, "token"));
    handed_over_ = true;
    std::make_shared<Client>(server_, std::move(stream_), authority)->Run(parser_->release());
  }

  void Refuse(http::status status, std::string_view why)
  {
    Respond(status, "text/plain; charset=utf-8", std::make_shared<const std::string>(std::string(why) + "\n"));
  }

  void Respond(http::status status, const std::string& type, std::shared_ptr<const std::string> bytes)
  {
    const auto& request = parser_->get();
    bytes_ = std::move(bytes);
    response_ = {};
    response_.version(11);
    response_.result(status);
    response_.set(http::field::content_type, type);
    response_.set(http::field::cache_control, "no-cache");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("X-Frame-Options", "DENY");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("Content-Security-Policy",
                  "default-src 'self'; img-src 'self' data: blob:; connect-src 'self' ws://" +
                      std::string(IsKnownHost(Field(http::field::host)) ? Field(http::field::host) : "localhost") +
                      "; frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
    response_.content_length(bytes_->size());
    const bool keep = status == http::status::ok && request.keep_alive();
    response_.keep_alive(keep);
    if (request.method() != http::verb::head)
    {
      response_.body().data = const_cast<char*>(bytes_->data());  // a buffer body only reads what it sends
      response_.body().size = bytes_->size();
    }
    response_.body().more = false;
    serializer_.emplace(response_);
    http::async_write(stream_, *serializer_,
                      [self = shared_from_this(), keep](ErrorCode error, std::size_t)
                      {
                        if (!error && keep) return self->Read();
                        ErrorCode ignored;
                        self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
                      });
  }

  std::string_view Field(http::field field) const
  {
    const auto text = parser_->get()[field];
    return {text.data(), text.size()};
  }

  Impl& server_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{kRequestBytes * 2};
  std::optional<http::request_parser<http::empty_body>> parser_;
  http::response<http::buffer_body> response_;
  std::optional<http::response_serializer<http::buffer_body>> serializer_;
  std::shared_ptr<const std::string> bytes_;
  bool handed_over_ = false;
};

WebServer::Impl::Impl(const WebServerSettings& settings, PageFiles files, WebServerEvents& events)
    : settings_(settings), files_(std::move(files)), events_(events)
{
  const auto fail = [&](const std::string& why)
  {
    throw std::runtime_error("web_render: cannot listen on " + settings_.address + " port " +
                             std::to_string(settings_.port) + ": " + why);
  };
  ErrorCode error;
  const asio::ip::address address = asio::ip::make_address(settings_.address, error);
  if (error) fail("that is no IP address");
  acceptor_.open(tcp::endpoint(address, settings_.port).protocol(), error);
  if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) acceptor_.bind({address, settings_.port}, error);
  if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (error == asio::error::address_in_use) fail(error.message() + "; port 0 takes a free one");
  if (error) fail(error.message());

  port_ = acceptor_.local_endpoint().port();

  // An address that stands for all networks is reached as this machine.
  asio::ip::address shown = address;
  if (address.is_unspecified())
  {
    if (address.is_v4())
      shown = asio::ip::address_v4::loopback();
    else
      shown = asio::ip::address_v6::loopback();
  }
  url_ = "http://" + (shown.is_v6() ? "[" + shown.to_string() + "]" : shown.to_string()) + ":" + std::to_string(port_) +
         "/";
  if (settings_.access.allow_control) url_ += "?token=" + settings_.access.token;

  Accept();
  thread_ = std::thread(
      [this]
      {
        pthread_setname_np(pthread_self(), "web server");
        context_.run();
      });
}

WebServer::Impl::~Impl()
{
  Post(
      [this]
      {
        closing_ = true;
        ErrorCode ignored;
        acceptor_.close(ignored);
        pause_.cancel();
        const auto clients = clients_;
        for (const auto& [id, client] : clients) client->Close();
        if (clients_.empty()) return context_.stop();
        pause_.expires_after(kFarewellTime);
        pause_.async_wait([this](ErrorCode) { context_.stop(); });
      });
  thread_.join();
}

void WebServer::Impl::Accept()
{
  acceptor_.async_accept(
      [this](ErrorCode error, tcp::socket socket)
      {
        if (closing_) return;
        if (error)
        {
          // Out of file descriptors, as a rule: others may become free.
          pause_.expires_after(std::chrono::milliseconds(100));
          pause_.async_wait(
              [this](ErrorCode)
              {
                if (!closing_) Accept();
              });
          return;
        }
        if (connections_ < settings_.max_connections)
        {
          ++connections_;
          std::make_shared<Connection>(*this, std::move(socket))->Read();
        }
        Accept();
      });
}

void WebServer::Impl::Join(const std::shared_ptr<Client>& client)
{
  client->id = ++last_client_;
  clients_.emplace(client->id, client);
  client->Queue(std::make_shared<const std::string>(events_.Welcome(client->id, client->GetAuthority())));
  if (greeting_) client->Queue(greeting_);
  for (const Bytes& text : history_) client->Queue(text);
  for (std::size_t slot = 0; slot < kSlots; ++slot)
    if (states_[slot]) client->Put(static_cast<Slot>(slot), states_[slot]);
  if (closing_) client->Close();
  Count();
}

void WebServer::Impl::Leave(std::uint64_t client)
{
  if (clients_.erase(client) == 0) return;
  events_.Left(client);
  Count();
  if (closing_ && clients_.empty()) context_.stop();
}

void WebServer::Impl::Count()
{
  client_count_ = clients_.size();
  hungry_ = static_cast<std::size_t>(
      std::count_if(clients_.begin(), clients_.end(), [](const auto& entry) { return entry.second->IsHungry(); }));
}

template <class Work>
void WebServer::Impl::With(std::uint64_t client, Work work)
{
  Post(
      [this, client, work = std::move(work)]
      {
        const auto found = clients_.find(client);
        if (found == clients_.end()) return;
        const std::shared_ptr<Client> keeper = found->second;
        work(*keeper);
      });
}

WebServer::WebServer(const WebServerSettings& settings, PageFiles files, WebServerEvents& events)
    : impl_(std::make_unique<Impl>(settings, std::move(files), events))
{
}

WebServer::~WebServer() = default;

std::uint16_t WebServer::Port() const { return impl_->port_; }
std::string WebServer::Url() const { return impl_->url_; }
std::size_t WebServer::Clients() const { return impl_->client_count_; }
std::size_t WebServer::Hungry() const { return impl_->hungry_; }

void WebServer::SetGreeting(Bytes text)
{
  impl_->Post([impl = impl_.get(), text = std::move(text)] { impl->greeting_ = text; });
}

void WebServer::Publish(Slot slot, Bytes bytes)
{
  impl_->Post(
      [impl = impl_.get(), slot, bytes = std::move(bytes)]
      {
        impl->states_[Index(slot)] = bytes;
        const auto clients = impl->clients_;
        for (const auto& [id, client] : clients) client->Put(slot, bytes);
        impl->Count();
      });
}

void WebServer::SendState(std::uint64_t client, Slot slot, Bytes bytes)
{
  impl_->With(client, [slot, bytes = std::move(bytes)](Impl::Client& c) { c.Put(slot, bytes); });
}

void WebServer::Send(std::uint64_t client, Bytes text)
{
  impl_->With(client, [text = std::move(text)](Impl::Client& c) { c.Queue(text); });
}

void WebServer::SendAll(Bytes text)
{
  impl_->Post(
      [impl = impl_.get(), text = std::move(text)]
      {
        impl->history_.push_back(text);
        if (impl->history_.size() > kHistoryLength) impl->history_.pop_front();
        const auto clients = impl->clients_;
        for (const auto& [id, client] : clients) client->Queue(text);
      });
}

void WebServer::SetFramePeriod(std::uint64_t client, unsigned period_ms)
{
  impl_->With(client,
              [impl = impl_.get(), period_ms](Impl::Client& c)
              {
                c.SetFramePeriod(std::chrono::milliseconds(period_ms));
                const Bytes& latest = impl->states_[Index(Slot::kFrame)];
                if (latest) c.Put(Slot::kFrame, latest);
              });
}

}  // namespace swarmanoid
