// One connection to a WebServer. It requests files until it becomes a client. In the server's thread.
#pragma once

#include <algorithm>
#include <boost/beast/core/detect_ssl.hpp>
#include <boost/beast/http.hpp>
#include <optional>

#include "visualiser/web/access.h"
#include "visualiser/web/web_client.h"
#include "visualiser/web/web_relay.h"

namespace swarmanoid
{

// If the server uses TLS, plain HTTP is redirected to the https address.
class WebServer::Impl::Connection final : public Droppable, public std::enable_shared_from_this<Connection>
{
  static constexpr auto kRequestTime = std::chrono::seconds(15);  // also between two requests
  static constexpr std::size_t kRequestBytes = 8192;

public:
  Connection(Impl& server, PageStream stream, const asio::ip::address& from)
      : Droppable(server, from), server_(server), stream_(std::move(stream))
  {
  }
  ~Connection() override
  {
    if (!handed_over_ && !dropped_) server_.Gone(address);
  }

  void Drop() override
  {
    HoldPlace();
    dropped_ = true;
    server_.Gone(address);
    ErrorCode ignored;
    beast::get_lowest_layer(stream_).socket().close(ignored);
  }

  void Start()
  {
    if (!stream_.HasTls()) return Read();
    Wait();
    beast::async_detect_ssl(stream_.next_layer(), buffer_,
                            [self = shared_from_this()](ErrorCode error, bool tls)
                            {
                              if (self->dropped_ || error) return;
                              if (tls) return self->ShakeHands();
                              self->HandOver();
                              std::make_shared<Connection>(
                                  self->server_, PageStream(std::move(self->stream_.next_layer())), self->address)
                                  ->Redirect(std::move(self->buffer_));
                            });
  }

  // The buffer has the bytes of the first request that were read.
  void Redirect(beast::flat_buffer buffer)
  {
    buffer_ = std::move(buffer);
    Read();
  }

  void Read()
  {
    parser_.emplace();
    parser_->header_limit(kRequestBytes);
    parser_->body_limit(0);
    Wait();
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](ErrorCode error, std::size_t)
                     {
                       if (self->dropped_) return;
                       if (error == http::error::header_limit)
                         return self->Refuse(http::status::request_header_fields_too_large, "the request is too long");
                       if (error == http::error::body_limit)
                         return self->Refuse(http::status::payload_too_large, "a request has no body here");
                       if (!error) self->Answer();
                     });
  }

private:
  // Limits the time for the request and its answer.
  void Wait()
  {
    beast::get_lowest_layer(stream_).expires_after(kRequestTime);
    GivePlace();
  }

  // Passes the stream to another object.
  void HandOver()
  {
    HoldPlace();
    handed_over_ = true;
  }

  void ShakeHands()
  {
    stream_.ShakeHands(buffer_.data(),
                       [self = shared_from_this()](ErrorCode error, std::size_t used)
                       {
                         if (self->dropped_ || error) return;
                         self->buffer_.consume(used);
                         self->Read();
                       });
  }

  void Answer()
  {
    const auto& request = parser_->get();
    const std::string_view host = Field(http::field::host);
    if (!IsKnownHost(host)) return Refuse(http::status::forbidden, "this server is not known by that name");
    const std::string_view target(request.target().data(), request.target().size());
    if (!stream_.HasTls() && server_.tls_)
    {
      location_ = "https://" + std::string(host) + std::string(target.starts_with('/') ? target : "/");
      return Refuse(http::status::permanent_redirect, "this server speaks TLS: " + location_);
    }
    if (websocket::is_upgrade(request)) return Upgrade(target);
    if (request.method() != http::verb::get && request.method() != http::verb::head)
      return Refuse(http::status::method_not_allowed, "only GET and HEAD are answered");
    const PageFile* file = server_.files_.Find(PathOf(target));
    if (file == nullptr) return Refuse(http::status::not_found, "there is no such file");
    // The page asks each time whether the file has changed, and otherwise uses its copy.
    if (Field(http::field::if_none_match) == file->tag) return Respond(http::status::not_modified, *file, {});
    const bool gzipped = file->gzipped && TakesGzip(Field(http::field::accept_encoding));
    Respond(http::status::ok, *file, gzipped ? file->gzipped : file->bytes);
  }

  static bool TakesGzip(std::string_view encodings)
  {
    for (const auto& [encoding, parameters] : http::ext_list({encodings.data(), encodings.size()}))
      if (boost::beast::iequals(encoding, "gzip"))
        return std::none_of(parameters.begin(), parameters.end(),
                            [](const auto& parameter) { return parameter.first == "q" && parameter.second == "0"; });
    return false;
  }

  void Upgrade(std::string_view target)
  {
    const bool relays = PathOf(target) == "/run/stream";
    if (!relays && PathOf(target) != "/stream") return Refuse(http::status::not_found, "the stream is at /stream");
    if (!IsOwnOrigin(Field(http::field::origin), Field(http::field::host), stream_.HasTls()))
      return Refuse(http::status::forbidden, "a page of another site may not look");
    if (relays && server_.relay_port_ == 0) return Refuse(http::status::service_unavailable, "there is no run");
    if (relays)
    {
      HandOver();
      return std::make_shared<Relay>(server_, std::move(stream_), address)->Run(parser_->release(), std::move(buffer_));
    }
    if (!server_.HasRoom()) return Refuse(http::status::service_unavailable, "as many pages look as may");
    HandOver();
    std::make_shared<Client>(server_, std::move(stream_), address)->Run(parser_->release());
  }

  void Refuse(http::status status, std::string_view why)
  {
    const PageFile text{
        "text/plain; charset=utf-8", "", std::make_shared<const std::string>(std::string(why) + "\n"), {}};
    Respond(status, text, text.bytes);
  }

  // Sends a response. `bytes` are those of the file, compressed or not, or none.
  void Respond(http::status status, const PageFile& file, PageFile::Bytes bytes)
  {
    const auto& request = parser_->get();
    bytes_ = std::move(bytes);
    response_ = {};
    response_.version(11);
    response_.result(status);
    response_.set(http::field::content_type, file.type);
    response_.set(http::field::cache_control, "no-cache");
    if (!file.tag.empty()) response_.set(http::field::etag, file.tag);
    if (file.gzipped) response_.set(http::field::vary, "Accept-Encoding");
    if (bytes_ && bytes_ == file.gzipped) response_.set(http::field::content_encoding, "gzip");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("X-Frame-Options", "DENY");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("Cross-Origin-Opener-Policy", "same-origin");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    if (!location_.empty()) response_.set(http::field::location, location_);
    response_.set("Content-Security-Policy",
                  std::string("default-src 'self'; img-src 'self' data: blob:; connect-src 'self' ") +
                      (stream_.HasTls() ? "wss://" : "ws://") +
                      std::string(IsKnownHost(Field(http::field::host)) ? Field(http::field::host) : "localhost") +
                      "; frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
    if (bytes_) response_.content_length(bytes_->size());
    const bool keep = (status == http::status::ok || status == http::status::not_modified) && request.keep_alive();
    response_.keep_alive(keep);
    if (bytes_ && request.method() != http::verb::head)
    {
      response_.body().data = const_cast<char*>(bytes_->data());  // a buffer body only reads what it sends
      response_.body().size = bytes_->size();
    }
    response_.body().more = false;
    serializer_.emplace(response_);
    http::async_write(stream_, *serializer_,
                      [self = shared_from_this(), keep](ErrorCode error, std::size_t)
                      {
                        if (self->dropped_) return;
                        if (!error && keep) return self->Read();
                        if (!error) self->SayGoodbye();
                      });
  }

  void SayGoodbye()
  {
    beast::get_lowest_layer(stream_).expires_after(kRequestTime);
    stream_.SayGoodbye([self = shared_from_this()](ErrorCode) {});
  }

  std::string_view Field(http::field field) const
  {
    const auto text = parser_->get()[field];
    return {text.data(), text.size()};
  }

  Impl& server_;
  PageStream stream_;
  beast::flat_buffer buffer_{kRequestBytes * 2};
  std::optional<http::request_parser<http::empty_body>> parser_;
  http::response<http::buffer_body> response_;
  std::optional<http::response_serializer<http::buffer_body>> serializer_;
  std::shared_ptr<const std::string> bytes_;
  std::string location_;  // the address to which this request is redirected
  bool handed_over_ = false;
  bool dropped_ = false;
};

}  // namespace swarmanoid
