// The server of pages, opened as the parameters of web_render say: at the address and with the token that the last
// start of the same experiment had, by TLS where that is due. Used by web_render and the editor.
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

class PageHost
{
public:
  // `key`: whose address is kept. Throws std::runtime_error.
  PageHost(const Parameters& parameters, const std::string& key);
  // Serves from now on. The events outlive the host; the first of them may come before this returns. Throws
  // std::runtime_error.
  void Open(WebServerEvents& events);

  // After or during Open, from any thread.
  WebServer& Server()
  {
    const std::lock_guard lock(opening_);
    return *server_;
  }
  // Takes the answer of a client to its challenge. For the server's thread alone.
  Authority Prove(std::uint64_t client, std::string_view proof);
  // For the server's thread alone.
  Visitors& GetVisitors() { return *visitors_; }
  // With the token behind a '#': browsers keep that part of an address for themselves.
  std::string Url() const;
  // SHA-256 of the certificate; empty: the pages are reached without TLS.
  const std::string& Fingerprint() const { return fingerprint_; }
  // Why the next start will have another address; empty if it will not.
  const std::string& Trouble() const { return trouble_; }
  // What the user should know of who can look or steer; empty if there is nothing.
  std::string Warning() const;

private:
  void Start(const std::string& token, WebServerEvents& events);

  WebServerSettings settings_;
  bool allow_control_;
  std::string fingerprint_;
  std::string trouble_;
  std::string token_;                   // empty: nobody may control
  std::unique_ptr<Visitors> visitors_;  // of the server's thread alone
  std::unique_ptr<KeptAddress> kept_;
  std::mutex opening_;                 // of server_
  std::unique_ptr<WebServer> server_;  // last: its thread uses the above
};

}  // namespace swarmanoid
