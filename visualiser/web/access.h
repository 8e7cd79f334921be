// Decides which clients may look at an experiment and which may control it: the checks of web_render's server, without
// sockets. Used in the server's thread.
//
// A page of any web site can open a connection to this machine, so an open port is no secret. The Host header must not
// be a name that foreign DNS could point here. A page must come from this very server (Origin). Commands need a token
// that only the printed address contains. The token itself is never sent: each client gets its own challenge, and
// answers with a value that only a holder of the token can compute.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace swarmanoid
{

// Returns whether a Host header is a name that cannot be forged by DNS: an IP address, localhost or this machine's own
// name, with or without a port.
bool IsKnownHost(std::string_view host);

// Returns whether an Origin header is that of a page from the server that the Host header names. Programs send no
// Origin, so an empty one is allowed. `tls`: whether the server is reached by https.
bool IsOwnOrigin(std::string_view origin, std::string_view host, bool tls = false);

// Returns the part of a request's target before '?'.
std::string_view PathOf(std::string_view target);

enum class Authority
{
  kReadOnly,    // nothing was proved yet, or the server has no token
  kWrongToken,  // may look, but not control
  kControl
};

struct AccessRules
{
  bool allow_control = false;
  std::string token;
};

// Returns 128 random bits of the operating system, as hexadecimal digits.
std::string MakeToken();

// Returns the answer of a holder of the token to a challenge: HMAC-SHA256 (RFC 2104) of the challenge under the token,
// both as text, in 64 hexadecimal digits.
std::string ProofOf(std::string_view token, std::string_view challenge);

// The clients of a server, with those that have proved that they hold the token.
class Visitors
{
public:
  explicit Visitors(AccessRules rules) : rules_(std::move(rules)) {}

  // Adds a client and returns its challenge, which differs from those of all other clients.
  std::string Join(std::uint64_t client);
  // Checks a client's answer. It takes the same time for every proof of the right length.
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
