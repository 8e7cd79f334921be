// The server of pages, opened according to the parameters of web_render: at the address and with the token of the last
// start of the same experiment, by TLS if required. web_render and the editor use it.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "common/configuration/parameter.h"
#include "visualiser/web/access.h"
#include "visualiser/web/kept_address.h"
#include "visualiser/web/web_server.h"

namespace swarmanoid
{

class PageServer
{
public:
  // `key` is the name under which the address is kept. Throws std::runtime_error.
  PageServer(const Parameters& parameters, const std::string& key);
  // Starts serving. The events must outlive the host; the first of them may come before this returns. Throws
  // std::runtime_error.
  void Open(WebServerEvents& events);

  // Call it after or during Open. Any thread may call it.
  WebServer& Server()
  {
    const std::lock_guard lock(opening_);
    return *server_;
  }
  // Takes the answer of a client to its challenge. Only the server's thread calls it.
  Authority Prove(std::uint64_t client, std::string_view proof);
  // Only the server's thread calls it.
  Visitors& GetVisitors() { return *visitors_; }
  // Returns the address, with the token behind a '#', which browsers do not send.
  std::string Url() const;
  // Returns the SHA-256 of the certificate; empty: the pages do not use TLS.
  const std::string& Fingerprint() const { return fingerprint_; }
  // Returns why the next start will have another address; empty if it will not.
  const std::string& Trouble() const { return trouble_; }
  // States which other users can look or control; empty if none can.
  std::string Warning() const;

private:
  void Start(const std::string& token, WebServerEvents& events);

  WebServerSettings settings_;
  bool allow_control_;
  std::string fingerprint_;
  std::string trouble_;
  std::string token_;                   // empty: no page may control the run
  std::unique_ptr<Visitors> visitors_;  // only for the server's thread
  std::unique_ptr<KeptAddress> kept_;
  std::mutex opening_;                 // guards server_
  std::unique_ptr<WebServer> server_;  // last, since its thread uses the members above
};

}  // namespace swarmanoid
