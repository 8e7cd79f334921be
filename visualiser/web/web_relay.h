// A connection that a WebServer passes on to the stream of another server on this machine, byte by byte. In the
// server's thread.
#pragma once

#include <array>
#include <boost/asio/write.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "visualiser/web/page_stream.h"
#include "visualiser/web/web_server_impl.h"

namespace swarmanoid
{

namespace http = beast::http;

// The other server sees a program on this machine, which needs no Origin. This server has checked the Origin already.
class WebServer::Impl::Relay final : public std::enable_shared_from_this<Relay>
{
  static constexpr auto kConnectTime = std::chrono::seconds(5);

public:
  Relay(Impl& server, PageStream stream, asio::ip::address from)
      : server_(server), address_(std::move(from)), page_(std::move(stream)), other_(server.context_)
  {
  }
  ~Relay() { server_.Gone(address_); }
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;

  // `first` has the bytes after the request that were read already.
  void Run(http::request<http::empty_body> request, beast::flat_buffer first)
  {
    const tcp::endpoint end(asio::ip::address_v4::loopback(), server_.relay_port_);
    request_ = std::move(request);
    request_.target("/stream");
    request_.set(http::field::host, "127.0.0.1:" + std::to_string(end.port()));
    request_.erase(http::field::origin);
    first_ = std::move(first);
    beast::get_lowest_layer(page_).expires_never();
    other_.expires_after(kConnectTime);
    other_.async_connect(end,
                         [self = shared_from_this()](ErrorCode error)
                         {
                           if (error) return self->Close();
                           self->other_.expires_never();
                           self->SendRequest();
                         });
  }

private:
  using Bytes = std::array<char, 65536>;

  void SendRequest()
  {
    http::async_write(other_, request_,
                      [self = shared_from_this()](ErrorCode error, std::size_t)
                      {
                        if (error) return self->Close();
                        self->SendFirst();
                        self->Pump(self->other_, self->page_, self->from_other_);
                      });
  }

  void SendFirst()
  {
    asio::async_write(other_, first_.data(),
                      [self = shared_from_this()](ErrorCode error, std::size_t)
                      {
                        if (error) return self->Close();
                        self->Pump(self->page_, self->other_, self->from_page_);
                      });
  }

  // Passes on what one side sends, until a side closes.
  template <class From, class To>
  void Pump(From& from, To& to, Bytes& bytes)
  {
    from.async_read_some(asio::buffer(bytes),
                         [self = shared_from_this(), &from, &to, &bytes](ErrorCode error, std::size_t count)
                         {
                           if (error) return self->Close();
                           asio::async_write(to, asio::buffer(bytes, count),
                                             [self, &from, &to, &bytes](ErrorCode failed, std::size_t)
                                             {
                                               if (failed) return self->Close();
                                               self->Pump(from, to, bytes);
                                             });
                         });
  }

  void Close()
  {
    ErrorCode ignored;
    beast::get_lowest_layer(page_).socket().close(ignored);
    other_.socket().close(ignored);
  }

  Impl& server_;
  const asio::ip::address address_;
  PageStream page_;
  beast::tcp_stream other_;
  http::request<http::empty_body> request_;
  beast::flat_buffer first_;
  Bytes from_page_{};
  Bytes from_other_{};
};

}  // namespace swarmanoid
