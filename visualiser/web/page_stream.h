// The bytes of a connection to a WebServer, with or without TLS. It is one type, so that HTTP and WebSockets are
// compiled once. It is a stream for asynchronous operations of Asio and Beast, in the server's thread.
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

// The number of buffers of a sequence that one operation takes.
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
  // Makes a stream with TLS. The context must outlive it.
  PageStream(beast::tcp_stream stream, asio::ssl::context& context);
  PageStream(PageStream&& other) noexcept;
  PageStream& operator=(PageStream&& other) noexcept;
  ~PageStream();

  bool HasTls() const;
  executor_type get_executor() { return next_layer().get_executor(); }
  // Returns the layer below TLS.
  beast::tcp_stream& next_layer();
  const beast::tcp_stream& next_layer() const;

  // Does the TLS handshake; `begun` has its first bytes. `done` gets the number of these bytes that were used.
  void ShakeHands(const asio::const_buffer& begun, Done done);
  // Tells the other side that no more bytes come. With TLS it waits for the answer, until the stream expires.
  void SayGoodbye(std::function<void(ErrorCode)> done);
  // Ends a WebSocket.
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

  // Wraps handlers that can only be moved, since std::function is copied.
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

// Beast finds these functions by name and ends a WebSocket with them.
inline void teardown(beast::role_type role, PageStream& stream, ErrorCode& error) { stream.TearDown(role, error); }
template <class Handler>
void async_teardown(beast::role_type role, PageStream& stream, Handler&& handler)
{
  auto shared = std::make_shared<std::decay_t<Handler>>(std::forward<Handler>(handler));
  stream.TearDown(role, [shared](ErrorCode error) { std::move (*shared)(error); });
}

}  // namespace swarmanoid
