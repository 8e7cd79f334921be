// The bytes of a connection to a WebServer, with or without TLS: one type, so that HTTP and WebSockets over it are
// compiled once. A stream for asynchronous operations of Asio and Beast, in the server's thread.
#pragma once

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <functional>
#include <memory>
#include <utility>

namespace swarmanoid
{

namespace asio = boost::asio;
namespace beast = boost::beast;
using ErrorCode = beast::error_code;

// As many of a sequence of buffers as one operation takes.
template <class Buffer>
class FewBuffers
{
public:
  using value_type = Buffer;
  using const_iterator = const Buffer*;

  template <class Buffers>
  explicit FewBuffers(const Buffers& buffers)
  {
    const auto end = asio::buffer_sequence_end(buffers);
    for (auto each = asio::buffer_sequence_begin(buffers); each != end && count_ < buffers_.size(); ++each)
      if (const Buffer buffer = *each; buffer.size() > 0) buffers_[count_++] = buffer;
  }
  const_iterator begin() const { return buffers_.data(); }
  const_iterator end() const { return buffers_.data() + count_; }

private:
  std::array<Buffer, 16> buffers_;
  std::size_t count_ = 0;
};

class PageStream
{
public:
  using executor_type = beast::tcp_stream::executor_type;
  using next_layer_type = beast::tcp_stream;
  using Done = std::function<void(ErrorCode, std::size_t)>;

  explicit PageStream(beast::tcp_stream stream);
  // With TLS, whose context outlives it.
  PageStream(beast::tcp_stream stream, asio::ssl::context& context);
  PageStream(PageStream&& other) noexcept;
  PageStream& operator=(PageStream&& other) noexcept;
  ~PageStream();

  bool HasTls() const;
  executor_type get_executor() { return next_layer().get_executor(); }
  // Below TLS.
  beast::tcp_stream& next_layer();
  const beast::tcp_stream& next_layer() const;

  // Of TLS; `begun` has been read of it. Done gets how much of that is used.
  void ShakeHands(const asio::const_buffer& begun, Done done);
  // Tells the other side that no more comes; with TLS its answer is awaited, as long as the stream has not expired.
  void SayGoodbye(std::function<void(ErrorCode)> done);
  // The end of a WebSocket.
  void TearDown(beast::role_type role, ErrorCode& error);
  void TearDown(beast::role_type role, std::function<void(ErrorCode)> done);

  template <class Buffers, class Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler)
  {
    ReadSome(FewBuffers<asio::mutable_buffer>(buffers), Shared(std::forward<Handler>(handler)));
  }
  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler)
  {
    WriteSome(FewBuffers<asio::const_buffer>(buffers), Shared(std::forward<Handler>(handler)));
  }

private:
  struct Streams;

  // Handlers may be moved alone, std::function is copied.
  template <class Handler>
  static Done Shared(Handler&& handler)
  {
    return [shared = std::make_shared<std::decay_t<Handler>>(std::forward<Handler>(handler))](
               ErrorCode error, std::size_t bytes) { std::move (*shared)(error, bytes); };
  }
  void ReadSome(const FewBuffers<asio::mutable_buffer>& buffers, Done done);
  void WriteSome(const FewBuffers<asio::const_buffer>& buffers, Done done);

  std::unique_ptr<Streams> streams_;
};

// For Beast, which ends a WebSocket by them.
inline void teardown(beast::role_type role, PageStream& stream, ErrorCode& error) { stream.TearDown(role, error); }
template <class Handler>
void async_teardown(beast::role_type role, PageStream& stream, Handler&& handler)
{
  auto shared = std::make_shared<std::decay_t<Handler>>(std::forward<Handler>(handler));
  stream.TearDown(role, [shared](ErrorCode error) { std::move (*shared)(error); });
}

}  // namespace swarmanoid
