// Who may look at an experiment and who may steer it: the checks of web_render's server, free of sockets. Used in the
// server's thread.
//
// A page of any web site can open a connection to this machine, so an open port is no secret: the Host header must not
// be a name that somebody's DNS could point here, a page must come from this very server (Origin), and commands need a
// token that only the printed address has. The token itself is never sent: each client gets a challenge of its own and
// answers with what only a holder of the token can make of it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace swarmanoid
{

// Whether a Host header names a machine as somebody who knows it would: an IP address, localhost or this machine's own
// name, with or without a port.
bool IsKnownHost(std::string_view host);

// Whether an Origin header is that of a page from the server that the Host header names. Programs send no Origin: an
// empty one is allowed. `tls`: whether the server is reached by https.
bool IsOwnOrigin(std::string_view origin, std::string_view host, bool tls = false);

// The part of a request's target before '?'.
std::string_view PathOf(std::string_view target);

enum class Authority
{
  kReadOnly,    // nothing was proved yet, or no token would help
  kWrongToken,  // may look, not steer
  kControl
};

struct AccessRules
{
  bool allow_control = false;
  std::string token;
};

// 128 random bits of the operating system, as hexadecimal digits.
std::string MakeToken();

// What a holder of the token answers to a challenge: HMAC-SHA256 (RFC 2104) of the challenge under the token, both as
// the text that they are, in 64 hexadecimal digits.
std::string ProofOf(std::string_view token, std::string_view challenge);

// The clients of a server, and which of them have proved that they hold the token.
class Visitors
{
public:
  explicit Visitors(AccessRules rules) : rules_(std::move(rules)) {}

  // A client has come: the challenge for it, which no other client gets.
  std::string Join(std::uint64_t client);
  // Its answer; takes the same time for every proof of the right length.
  Authority Prove(std::uint64_t client, std::string_view proof);
  bool MayControl(std::uint64_t client) const;
  void Leave(std::uint64_t client) { visitors_.erase(client); }

private:
  struct Visitor
  {
    std::string challenge;
    Authority authority = Authority::kReadOnly;
  };

  AccessRules rules_;
  std::map<std::uint64_t, Visitor> visitors_;
};

}  // namespace swarmanoid
