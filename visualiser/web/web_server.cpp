// One thread runs all connections by asynchronous operations of Boost.Asio; other threads only post work to it. Hence
// no member needs a lock, except the counts that other threads read, which are atomic.
//
// Connections are a limited good that strangers could use up. Each address has a limit, and a connection without a
// place, that is, one that has not yet become a page, is dropped for a new one. Pages that prove the token have places
// of their own, so other pages cannot keep the user out.
#include "visualiser/web/web_server.h"

#include <pthread.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "common/threads/start_thread.h"
#include "visualiser/web/web_connection.h"

namespace swarmanoid
{
namespace
{

constexpr auto kFarewellTime = std::chrono::milliseconds(400);
constexpr std::size_t kHistoryLength = 256;

asio::ssl::context ContextOf(const Certificate& certificate)
{
  asio::ssl::context context(asio::ssl::context::tls_server);
  SSL_CTX_set_min_proto_version(context.native_handle(), TLS1_2_VERSION);
  SSL_CTX_set_options(context.native_handle(), SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION);
  context.use_certificate_chain(asio::buffer(certificate.chain));
  context.use_private_key(asio::buffer(certificate.key), asio::ssl::context::pem);
  return context;
}

}  // namespace

WebServer::Impl::Impl(const WebServerSettings& settings, PageFiles files, WebServerEvents& events)
    : settings_(settings), files_(std::move(files)), events_(events)
{
  const auto fail = [&](const std::string& why)
  {
    throw std::runtime_error("web_render: cannot listen on " + settings_.address + " port " +
                             std::to_string(settings_.port) + ": " + why);
  };
  ErrorCode error;
  if (settings_.certificate) tls_.emplace(ContextOf(*settings_.certificate));
  const asio::ip::address address = asio::ip::make_address(settings_.address, error);
  if (error) fail("that is no IP address");
  acceptor_.open(tcp::endpoint(address, settings_.port).protocol(), error);
  if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) acceptor_.bind({address, settings_.port}, error);
  if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (error == asio::error::address_in_use) fail(error.message() + "; port 0 takes a free one");
  if (error) fail(error.message());

  port_ = acceptor_.local_endpoint().port();

  // If the address stands for all networks, pages on this machine use localhost.
  asio::ip::address shown = address;
  if (address.is_unspecified())
  {
    if (address.is_v4())
      shown = asio::ip::address_v4::loopback();
    else
      shown = asio::ip::address_v6::loopback();
  }
  url_ = (tls_ ? "https://" : "http://") + (shown.is_v6() ? "[" + shown.to_string() + "]" : shown.to_string()) + ":" +
         std::to_string(port_) + "/";

  Accept();
  thread_ = StartThread("serves the pages",
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
          // Usually the process is out of file descriptors, and some may become free.
          pause_.expires_after(std::chrono::milliseconds(100));
          pause_.async_wait(
              [this](ErrorCode)
              {
                if (!closing_) Accept();
              });
          return;
        }
        Welcome(std::move(socket));
        Accept();
      });
}

// Connections without a place make room for others. One address must leave some connections to others.
void WebServer::Impl::Welcome(tcp::socket socket)
{
  ErrorCode error;
  const asio::ip::address address = socket.remote_endpoint(error).address();
  if (error) return;
  const auto found = connections_of_.find(address);
  const std::size_t of_address = found == connections_of_.end() ? 0 : found->second;
  if (of_address >= settings_.max_connections_of_address && !DropOne(address)) return;
  if (connections_ >= settings_.max_connections && !DropOne(std::nullopt)) return;
  ++connections_;
  ++connections_of_[address];
  beast::tcp_stream stream(std::move(socket));
  std::make_shared<Connection>(*this, tls_ ? PageStream(std::move(stream), *tls_) : PageStream(std::move(stream)),
                               address)
      ->Start();
}

bool WebServer::Impl::DropOne(const std::optional<asio::ip::address>& address)
{
  const auto found = std::find_if(droppables_.begin(), droppables_.end(),
                                  [&](const Droppable* each) { return !address || each->address == *address; });
  if (found == droppables_.end()) return false;
  (*found)->Drop();
  return true;
}

void WebServer::Impl::Gone(const asio::ip::address& address)
{
  --connections_;
  if (--connections_of_.at(address) == 0) connections_of_.erase(address);
}

bool WebServer::Impl::HasRoom() const { return watchers_ < settings_.max_clients || holders_ < settings_.max_holders; }

// A client without a place has some time to prove the token. Until then it gets only the challenge.
void WebServer::Impl::Join(const std::shared_ptr<Client>& client)
{
  client->id = ++last_client_;
  clients_.emplace(client->id, client);
  if (watchers_ < settings_.max_clients) client->Take(Client::Place::kWatcher);
  client->Queue(std::make_shared<const std::string>(events_.Welcome(client->id)));
  if (client->HasPlace())
    Greet(*client);
  else
    client->WaitForProof();
  if (closing_) client->Close();
  Count();
}

void WebServer::Impl::Greet(Client& client) const
{
  if (greeting_) client.Queue(greeting_);
  for (const Bytes& text : history_) client.Queue(text);
  for (std::size_t slot = 0; slot < kSlots; ++slot)
    if (states_[slot]) client.Put(static_cast<Slot>(slot), states_[slot]);
}

// If all places for holders are taken, a client keeps the place that it has.
void WebServer::Impl::Admit(Client& client)
{
  if (holders_ >= settings_.max_holders) return;
  const bool had_place = client.HasPlace();
  client.Take(Client::Place::kHolder);
  if (!had_place) Greet(client);
  Count();
}

void WebServer::Impl::QueueForAll(const Bytes& text)
{
  const auto clients = clients_;
  for (const auto& [id, client] : clients)
    if (client->HasPlace()) client->Queue(text);
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
  client_count_ = watchers_ + holders_;
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

void WebServer::Admit(std::uint64_t client)
{
  impl_->With(client, [impl = impl_.get()](Impl::Client& c) { impl->Admit(c); });
}

void WebServer::SetGreeting(Bytes text)
{
  impl_->Post(
      [impl = impl_.get(), text = std::move(text)]
      {
        impl->greeting_ = text;
        impl->QueueForAll(text);
      });
}

void WebServer::Publish(Slot slot, Bytes bytes)
{
  impl_->Post(
      [impl = impl_.get(), slot, bytes = std::move(bytes)]
      {
        impl->states_[Index(slot)] = bytes;
        if (slot == Slot::kKey) impl->states_[Index(Slot::kChange)] = nullptr;
        const auto clients = impl->clients_;
        for (const auto& [id, client] : clients)
          if (client->HasPlace()) client->Put(slot, bytes);
        impl->Count();
      });
}

void WebServer::SendState(std::uint64_t client, Slot slot, Bytes bytes)
{
  impl_->With(client,
              [slot, bytes = std::move(bytes)](Impl::Client& c)
              {
                if (c.HasPlace()) c.Put(slot, bytes);
              });
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
        impl->QueueForAll(text);
      });
}

void WebServer::SetRelay(std::uint16_t port)
{
  impl_->Post([impl = impl_.get(), port] { impl->relay_port_ = port; });
}

void WebServer::SetFramePeriod(std::uint64_t client, unsigned period_ms)
{
  impl_->With(client,
              [impl = impl_.get(), period_ms](Impl::Client& c)
              {
                c.SetFramePeriod(std::chrono::milliseconds(period_ms));
                const Bytes& latest = impl->states_[Index(Slot::kChange)];
                if (latest && c.HasPlace()) c.Put(Slot::kChange, latest);
              });
}

}  // namespace swarmanoid
