#include "visualiser/web/page_stream.h"

#include <boost/asio/post.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <optional>

namespace swarmanoid
{

using TlsStream = beast::ssl_stream<beast::tcp_stream>;

// Exactly one of the two streams exists.
struct PageStream::Streams
{
  std::optional<beast::tcp_stream> plain;
  std::optional<TlsStream> tls;
};

PageStream::PageStream(beast::tcp_stream stream) : streams_(std::make_unique<Streams>())
{
  streams_->plain.emplace(std::move(stream));
}

PageStream::PageStream(beast::tcp_stream stream, asio::ssl::context& context) : streams_(std::make_unique<Streams>())
{
  streams_->tls.emplace(std::move(stream), context);
}

PageStream::PageStream(PageStream&& other) noexcept = default;
PageStream& PageStream::operator=(PageStream&& other) noexcept = default;
PageStream::~PageStream() = default;

bool PageStream::HasTls() const { return streams_->tls.has_value(); }

beast::tcp_stream& PageStream::next_layer() { return HasTls() ? streams_->tls->next_layer() : *streams_->plain; }
const beast::tcp_stream& PageStream::next_layer() const
{
  return HasTls() ? streams_->tls->next_layer() : *streams_->plain;
}

void PageStream::ShakeHands(const asio::const_buffer& begun, Done done)
{
  streams_->tls->async_handshake(asio::ssl::stream_base::server, begun, std::move(done));
}

void PageStream::SayGoodbye(std::function<void(ErrorCode)> done)
{
  if (HasTls()) return streams_->tls->async_shutdown(std::move(done));
  ErrorCode error;
  streams_->plain->socket().shutdown(asio::socket_base::shutdown_send, error);
  asio::post(get_executor(), [error, done = std::move(done)] { done(error); });
}

void PageStream::TearDown(beast::role_type role, ErrorCode& error)
{
  using beast::websocket::teardown;
  if (HasTls()) return teardown(role, *streams_->tls, error);
  teardown(role, streams_->plain->socket(), error);
}

void PageStream::TearDown(beast::role_type role, std::function<void(ErrorCode)> done)
{
  using beast::websocket::async_teardown;
  if (HasTls()) return async_teardown(role, *streams_->tls, std::move(done));
  async_teardown(role, streams_->plain->socket(), std::move(done));
}

void PageStream::ReadSome(const FewBuffers<asio::mutable_buffer>& buffers, Done done)
{
  if (HasTls()) return streams_->tls->async_read_some(buffers, std::move(done));
  streams_->plain->async_read_some(buffers, std::move(done));
}

void PageStream::WriteSome(const FewBuffers<asio::const_buffer>& buffers, Done done)
{
  if (HasTls()) return streams_->tls->async_write_some(buffers, std::move(done));
  streams_->plain->async_write_some(buffers, std::move(done));
}

}  // namespace swarmanoid
