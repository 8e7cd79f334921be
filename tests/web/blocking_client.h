// BlockingClient: a blocking client of WebServer for its tests.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace swarmanoid
{

class BlockingClient
{
public:
  using Tcp = boost::asio::ip::tcp;
  using ErrorCode = boost::beast::error_code;

  explicit BlockingClient(std::uint16_t port) : port_(port), stream_(context_)
  {
    stream_.next_layer().connect({boost::asio::ip::make_address("127.0.0.1"), port});
  }

  std::string Host() const { return "127.0.0.1:" + std::to_string(port_); }

  // Sends bytes unchanged.
  void Write(const std::string& bytes) { boost::asio::write(stream_.next_layer(), boost::asio::buffer(bytes)); }
  // Sends bytes unchanged, and returns the answer.
  boost::beast::http::response<boost::beast::http::string_body> Ask(const std::string& bytes)
  {
    Write(bytes);
    boost::beast::http::response<boost::beast::http::string_body> response;
    boost::beast::http::read(stream_.next_layer(), buffer_, response);
    return response;
  }
  boost::beast::http::response<boost::beast::http::string_body> Get(const std::string& target,
                                                                    const std::string& host = "")
  {
    return Ask("GET " + target + " HTTP/1.1\r\nHost: " + (host.empty() ? Host() : host) + "\r\n\r\n");
  }

  // Returns the status of the answer: 101 if the server accepts the client.
  unsigned Open(const std::string& target = "/stream", const std::string& origin = "", const std::string& host = "")
  {
    stream_.set_option(boost::beast::websocket::stream_base::decorator(
        [origin](boost::beast::websocket::request_type& request)
        {
          if (!origin.empty()) request.set(boost::beast::http::field::origin, origin);
        }));
    ErrorCode refused;
    stream_.handshake(host.empty() ? Host() : host, target, refused);
    if (!refused) return 101;
    // Beast does not return the answer, so the same request is made by hand.
    return BlockingClient(port_)
        .Ask("GET " + target + " HTTP/1.1\r\nHost: " + (host.empty() ? Host() : host) +
             "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
             "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n" +
             (origin.empty() ? "" : "Origin: " + origin + "\r\n") + "\r\n")
        .result_int();
  }

  void Send(const std::string& text)
  {
    stream_.text(true);
    stream_.write(boost::asio::buffer(text));
  }

  // Returns the next message. Sets `error` if the connection ends.
  std::string Read(ErrorCode& error)
  {
    boost::beast::flat_buffer buffer;
    stream_.read(buffer, error);
    return boost::beast::buffers_to_string(buffer.data());
  }
  std::string Read()
  {
    ErrorCode error;
    std::string text = Read(error);
    if (error) throw std::runtime_error(error.message());
    return text;
  }
  // Returns the next text of a type.
  nlohmann::json ReadUntil(const std::string& type)
  {
    while (true)
    {
      const std::string text = Read();
      if (stream_.got_text())
        if (nlohmann::json json = nlohmann::json::parse(text); json["type"] == type) return json;
    }
  }
  bool GotBinary() const { return stream_.got_binary(); }
  auto CloseReason() const { return stream_.reason(); }

private:
  std::uint16_t port_;
  // shared, since each context takes several open files
  inline static boost::asio::io_context context_;
  boost::beast::websocket::stream<Tcp::socket> stream_;
  boost::beast::flat_buffer buffer_;
};

}  // namespace swarmanoid
