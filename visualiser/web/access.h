// Who may look at an experiment and who may steer it: the checks of web_render's server, free of sockets. Used in the
// server's thread.
//
// A page of any web site can open a connection to this machine, so an open port is no secret: the Host header must not
// be a name that somebody's DNS could point here, a page must come from this very server (Origin), and commands need a
// token that only the printed address has.
#pragma once

#include <string>
#include <string_view>

namespace swarmanoid
{

// Whether a Host header names a machine as somebody who knows it would: an IP address, localhost or this machine's own
// name, with or without a port.
bool IsKnownHost(std::string_view host);

// Whether an Origin header is that of a page from the server that the Host header names. Programs send no Origin: an
// empty one is allowed.
bool IsOwnOrigin(std::string_view origin, std::string_view host);

// The part of a request's target before '?', and the value of one of its parameters; empty if there is none.
std::string_view PathOf(std::string_view target);
std::string_view QueryValue(std::string_view target, std::string_view name);

enum class Authority
{
  kReadOnly,    // no token was given, or none would help
  kWrongToken,  // may look, not steer
  kControl
};

struct AccessRules
{
  bool allow_control = false;
  std::string token;
};

// Takes the same time for every token of the right length.
Authority AuthorityOf(const AccessRules& rules, std::string_view token);

// 128 random bits of the operating system, as hexadecimal digits.
std::string MakeToken();

}  // namespace swarmanoid
