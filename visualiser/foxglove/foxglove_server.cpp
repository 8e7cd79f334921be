// All sockets are used by one thread (Boost.Asio). Other threads pass messages to it by posting; they share only atomic
// counters. A client has one waiting message for each subscription, which a newer one replaces, and one write at a
// time.
#include "visualiser/foxglove/foxglove_server.h"
#include "common/threads/start_thread.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>

namespace swarmanoid
{
namespace
{

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using Json = nlohmann::json;
using Request = http::request<http::empty_body>;
using Bytes = std::shared_ptr<const std::string>;

constexpr const char* kProtocol = "foxglove.websocket.v1";
// These are constants of the protocol.
constexpr char kMessageData = 1;
constexpr char kTime = 2;
constexpr int kWarning = 1, kError = 2;
constexpr auto kTimeToClose = std::chrono::milliseconds(300);
constexpr auto kHandshakeTime = std::chrono::seconds(10);
constexpr std::size_t kMostSubscriptions = 64;  // for each client
constexpr std::size_t kMostTexts = 64;          // the limit of waiting texts for a client

template <class Number>
void Append(std::string& bytes, Number number)
{
  for (std::size_t k = 0; k < sizeof number; ++k) bytes.push_back(static_cast<char>(number >> (8 * k) & 0xffU));
}

// Returns whether the origin is on this machine, such as "http://localhost:3000", or a file.
bool IsOfThisMachine(std::string_view origin)
{
  if (origin == "file://" || origin == "null") return true;
  for (const std::string_view scheme : {"http://", "https://"})
  {
    if (!origin.starts_with(scheme)) continue;
    const std::string_view host = origin.substr(scheme.size(), origin.find(':', scheme.size()) - scheme.size());
    return host == "localhost" || host == "127.0.0.1";
  }
  return false;
}

bool Speaks(std::string_view protocols)
{
  while (!protocols.empty())
  {
    const std::size_t comma = std::min(protocols.find(','), protocols.size());
    std::string_view one = protocols.substr(0, comma);
    while (one.starts_with(' ')) one.remove_prefix(1);
    while (one.ends_with(' ')) one.remove_suffix(1);
    if (one == kProtocol) return true;
    protocols.remove_prefix(std::min(comma + 1, protocols.size()));
  }
  return false;
}

}  // namespace

class FoxgloveServer::Impl
{
public:
  Impl(FoxgloveServerSettings settings, std::vector<FoxgloveChannel> channels)
      : settings_(std::move(settings)), channels_(std::move(channels)), counts_(channels_.size())
  {
    Listen();
    Accept();
    thread_ = StartThread("serves Foxglove", [this] { context_.run(); });
  }
  ~Impl()
  {
    asio::post(context_, [this] { Close(); });
    thread_.join();
  }

  std::uint16_t Port() const { return port_; }
  std::size_t Subscribers(std::size_t channel) const { return counts_[channel].now; }
  std::uint64_t Subscriptions(std::size_t channel) const { return counts_[channel].ever; }
  void Publish(std::size_t channel, std::uint64_t time, std::string json)
  {
    asio::post(context_,
               [this, channel, time, text = std::make_shared<const std::string>(std::move(json))]
               {
                 for (const auto& client : clients_) client->Publish(channel, time, text);
               });
  }
  void SetTime(std::uint64_t time)
  {
    asio::post(context_,
               [this, time]
               {
                 for (const auto& client : clients_) client->SetTime(time);
               });
  }

private:
  struct Count
  {
    std::atomic<std::size_t> now = 0;     // subscriptions at present
    std::atomic<std::uint64_t> ever = 0;  // subscriptions since the start
  };

  // All members are used in the thread of the server.
  class Client : public std::enable_shared_from_this<Client>
  {
  public:
    Client(Impl& server, tcp::socket socket) : server_(server), stream_(std::move(socket)) {}

    void Start()
    {
      beast::get_lowest_layer(stream_).expires_after(kHandshakeTime);
      parser_.body_limit(0);
      http::async_read(beast::get_lowest_layer(stream_), buffer_, parser_,
                       [self = shared_from_this()](beast::error_code error, std::size_t)
                       {
                         if (!error) self->Upgrade();
                         if (error) self->Leave();
                       });
    }

    void Publish(std::size_t channel, std::uint64_t time, const Bytes& json)
    {
      for (auto& [id, of] : subscriptions_)
        if (of.channel == channel)
        {
          of.time = time;
          of.waiting = json;
        }
      Write();
    }
    void SetTime(std::uint64_t time)
    {
      time_ = time;
      Write();
    }
    void Close()
    {
      beast::error_code ignored;
      beast::get_lowest_layer(stream_).socket().close(ignored);
    }
    bool HasWork() const { return is_writing_; }

  private:
    struct Subscription
    {
      std::size_t channel = 0;
      std::uint64_t time = 0;
      Bytes waiting{};
    };

    void Upgrade()
    {
      const Request& request = parser_.get();
      if (!websocket::is_upgrade(request))
        return Refuse(http::status::upgrade_required,
                      "this is a server of the Foxglove WebSocket protocol: open it as a "
                      "connection in Foxglove or Lichtblick\n");
      const auto of = [&](http::field field)
      {
        const auto value = request[field];
        return std::string_view(value.data(), value.size());
      };
      const std::string_view origin = of(http::field::origin);
      if (!origin.empty() && !IsOfThisMachine(origin) &&
          std::ranges::find(server_.settings_.origins, origin) == server_.settings_.origins.end())
        return Refuse(
            http::status::forbidden,
            fmt::format("pages of {} are not let in; the parameter origins names the allowed ones\n", origin));
      if (!Speaks(of(http::field::sec_websocket_protocol)))
        return Refuse(http::status::bad_request, fmt::format("the subprotocol is {}\n", kProtocol));
      if (server_.clients_.size() > server_.settings_.max_clients)
        return Refuse(http::status::service_unavailable, "too many look already\n");
      beast::get_lowest_layer(stream_).expires_never();
      stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
      stream_.set_option(websocket::stream_base::decorator(
          [](websocket::response_type& response) { response.set(http::field::sec_websocket_protocol, kProtocol); }));
      stream_.read_message_max(server_.settings_.max_message_bytes);
      stream_.async_accept(request,
                           [self = shared_from_this()](beast::error_code error)
                           {
                             if (error) return self->Leave();
                             self->is_open_ = true;
                             self->Greet();
                             self->Read();
                           });
    }

    void Refuse(http::status status, const std::string& text)
    {
      auto response = std::make_shared<http::response<http::string_body>>(status, 11);
      response->set(http::field::content_type, "text/plain; charset=utf-8");
      response->body() = text;
      response->prepare_payload();
      response->keep_alive(false);
      http::async_write(beast::get_lowest_layer(stream_), *response,
                        [self = shared_from_this(), response](beast::error_code, std::size_t) { self->Leave(); });
    }

    void Greet()
    {
      Say({{"op", "serverInfo"},
           {"name", server_.settings_.name},
           {"capabilities", {"time"}},
           {"supportedEncodings", {"json"}},
           {"metadata", Json::object()}});
      Json channels = Json::array();
      for (std::size_t k = 0; k < server_.channels_.size(); ++k)
        channels.push_back({{"id", k + 1},
                            {"topic", server_.channels_[k].topic},
                            {"encoding", "json"},
                            {"schemaName", server_.channels_[k].schema_name},
                            {"schema", server_.channels_[k].schema},
                            {"schemaEncoding", "jsonschema"}});
      Say({{"op", "advertise"}, {"channels", std::move(channels)}});
    }

    void Read()
    {
      stream_.async_read(buffer_,
                         [self = shared_from_this()](beast::error_code error, std::size_t)
                         {
                           if (error) return self->Leave();
                           const std::string text = beast::buffers_to_string(self->buffer_.data());
                           self->buffer_.clear();
                           self->Take(text);
                           self->Read();
                         });
    }

    void Take(const std::string& text)
    {
      try
      {
        const Json message = Json::parse(text);
        const std::string op = message.at("op").get<std::string>();
        if (op == "subscribe")
          for (const Json& one : message.at("subscriptions"))
            Subscribe(one.at("id").get<std::uint32_t>(), one.at("channelId").get<std::uint64_t>());
        else if (op == "unsubscribe")
          for (const Json& id : message.at("subscriptionIds")) Unsubscribe(id.get<std::uint32_t>());
        else
          Complain(kWarning, fmt::format("this server does not do '{}'", op));
      }
      catch (const Json::exception& error)
      {
        Complain(kError, fmt::format("a message cannot be read: {}", error.what()));
      }
    }

    void Subscribe(std::uint32_t id, std::uint64_t channel)
    {
      if (channel == 0 || channel > server_.channels_.size())
        return Complain(kError, fmt::format("there is no channel {}", channel));
      if (subscriptions_.contains(id))
        return Complain(kWarning, fmt::format("the subscription {} is there already", id));
      if (subscriptions_.size() >= kMostSubscriptions) return Complain(kError, "too many subscriptions");
      subscriptions_[id] = {channel - 1};
      ++server_.counts_[channel - 1].now;
      ++server_.counts_[channel - 1].ever;
    }
    void Unsubscribe(std::uint32_t id)
    {
      const auto found = subscriptions_.find(id);
      if (found == subscriptions_.end()) return Complain(kWarning, fmt::format("there is no subscription {}", id));
      --server_.counts_[found->second.channel].now;
      subscriptions_.erase(found);
    }
    void Complain(int level, const std::string& text) { Say({{"op", "status"}, {"level", level}, {"message", text}}); }

    void Say(const Json& message)
    {
      if (texts_.size() >= kMostTexts) return Close();
      texts_.push_back(message.dump(-1, ' ', false, Json::error_handler_t::replace));
      Write();
    }

    // Sends one message at a time: texts, the time, then the waiting messages of the subscriptions in turn.
    void Write()
    {
      if (is_writing_ || !is_open_) return;
      stream_.binary(texts_.empty());
      if (!texts_.empty())
      {
        out_ = std::move(texts_.front());
        texts_.erase(texts_.begin());
      }
      else if (time_)
      {
        out_.assign(1, kTime);
        Append(out_, *time_);
        time_.reset();
      }
      else if (!TakeMessage())
        return;
      is_writing_ = true;
      stream_.async_write(asio::buffer(out_),
                          [self = shared_from_this()](beast::error_code error, std::size_t)
                          {
                            self->is_writing_ = false;
                            if (error) return self->Leave();
                            self->Write();
                          });
    }

    bool TakeMessage()
    {
      const auto waits = [](const auto& entry) { return entry.second.waiting != nullptr; };
      auto next = std::find_if(subscriptions_.upper_bound(last_), subscriptions_.end(), waits);
      if (next == subscriptions_.end()) next = std::find_if(subscriptions_.begin(), subscriptions_.end(), waits);
      if (next == subscriptions_.end()) return false;
      last_ = next->first;
      out_.assign(1, kMessageData);
      Append(out_, next->first);
      Append(out_, next->second.time);
      out_ += *next->second.waiting;
      next->second.waiting.reset();
      return true;
    }

    void Leave()
    {
      if (std::exchange(is_gone_, true)) return;
      is_open_ = false;
      for (const auto& [id, of] : subscriptions_) --server_.counts_[of.channel].now;
      subscriptions_.clear();
      Close();
      server_.clients_.erase(shared_from_this());
    }

    Impl& server_;
    websocket::stream<beast::tcp_stream> stream_;
    beast::flat_buffer buffer_;
    http::request_parser<http::empty_body> parser_;
    std::map<std::uint32_t, Subscription> subscriptions_;
    std::uint32_t last_ = 0;  // the last subscription that was sent
    std::vector<std::string> texts_;
    std::optional<std::uint64_t> time_;
    std::string out_;
    bool is_open_ = false;
    bool is_writing_ = false;
    bool is_gone_ = false;
  };

  void Listen()
  {
    beast::error_code error;
    const auto address = asio::ip::make_address(settings_.address, error);
    if (!error) acceptor_.open(tcp::endpoint(address, settings_.port).protocol(), error);
    if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind({address, settings_.port}, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error)
      throw std::runtime_error(fmt::format("cannot listen at {}:{}: {}; choose another <port>", settings_.address,
                                           settings_.port, error.message()));
    port_ = acceptor_.local_endpoint().port();
  }

  void Accept()
  {
    acceptor_.async_accept(
        [this](beast::error_code error, tcp::socket socket)
        {
          if (error == asio::error::operation_aborted || !acceptor_.is_open()) return;
          // A client beyond the limit still gets an answer that states the reason.
          if (!error && clients_.size() < 2 * settings_.max_clients)
            (*clients_.insert(std::make_shared<Client>(*this, std::move(socket))).first)->Start();
          Accept();
        });
  }

  void Close()
  {
    beast::error_code ignored;
    acceptor_.close(ignored);
    closing_ = std::chrono::steady_clock::now() + kTimeToClose;
    CloseClients();
  }
  void CloseClients()
  {
    const bool busy = std::ranges::any_of(clients_, [](const auto& client) { return client->HasWork(); });
    if (busy && std::chrono::steady_clock::now() < closing_)
    {
      timer_.expires_after(std::chrono::milliseconds(5));
      return timer_.async_wait([this](beast::error_code) { CloseClients(); });
    }
    for (const auto& client : clients_) client->Close();
  }

  const FoxgloveServerSettings settings_;
  const std::vector<FoxgloveChannel> channels_;
  std::vector<Count> counts_;
  asio::io_context context_{1};
  tcp::acceptor acceptor_{context_};
  asio::steady_timer timer_{context_};
  std::chrono::steady_clock::time_point closing_;
  std::uint16_t port_ = 0;
  std::set<std::shared_ptr<Client>> clients_;
  std::thread thread_;
};

FoxgloveServer::FoxgloveServer(const FoxgloveServerSettings& settings, std::vector<FoxgloveChannel> channels)
    : impl_(std::make_unique<Impl>(settings, std::move(channels)))
{
}
FoxgloveServer::~FoxgloveServer() = default;

std::uint16_t FoxgloveServer::Port() const { return impl_->Port(); }
std::size_t FoxgloveServer::Subscribers(std::size_t channel) const { return impl_->Subscribers(channel); }
std::uint64_t FoxgloveServer::Subscriptions(std::size_t channel) const { return impl_->Subscriptions(channel); }
void FoxgloveServer::Publish(std::size_t channel, std::uint64_t time, std::string json)
{
  impl_->Publish(channel, time, std::move(json));
}
void FoxgloveServer::SetTime(std::uint64_t time) { impl_->SetTime(time); }

}  // namespace swarmanoid
