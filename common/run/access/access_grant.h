// An access grant lets a program observe or steer a run without being a member of it. The grant's key is derived from
// the run's key and does not reveal it. The space server uses separate topics for grants (GrantChannel), so holders
// cannot send messages that members accept. An open view is a grant without a key. Programs of any DDS can read it, and
// their messages are ignored. The launcher, the visualiser and the space server use it. docs/security.md lists what a
// holder can do.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/run/access/bus_options.h"

namespace swarmanoid
{

enum class GrantRole
{
  kWatcher,   // observes the run
  kOperator,  // also steers it
  kOpenView,  // every program may read
};
// Returns "watch", "operate" and "open", in tokens and requests. The inverse returns nullopt for other words.
const char* RoleWord(GrantRole role);
std::optional<GrantRole> GrantRoleOf(const std::string& word);
// Returns "watcher", "operator" and "open view", for people.
const char* RoleName(GrantRole role);

struct AccessGrant
{
  std::string id;  // 8 hexadecimal digits
  GrantRole role = GrantRole::kWatcher;
  std::int64_t ends = 0;  // seconds since 1970; 0: with the run

  bool HasEnded() const;
  // "operator grant 1a2b3c4d"
  std::string Name() const;
};

// The partition of an open view's topics ends with this word, behind a slash.
inline constexpr const char* kOpenChannel = "open";

std::string NewGrantId();
bool IsGrantId(const std::string& text);

// The token that the holder of a grant with a key gets, beside the experiment's name.
struct AccessToken
{
  AccessGrant grant;
  int domain = 0;
  std::string address;           // address of the space server
  std::string discovery_server;  // BusOptions
  RunKey key{};
  std::string experiment;
};

std::string TextOf(const AccessToken& token);
// Returns nullopt for anything else.
std::optional<AccessToken> TokenOfText(const std::string& text);

// Reads the token from the environment of this process, which other users cannot see, unlike its arguments. Throws
// BusError if the token is invalid or has ended.
inline constexpr const char* kTokenVariable = "SWARMANOID_SHARE";
std::optional<AccessToken> TokenOfEnvironment();
// Sets `options` to use the token. The interface is the one that reaches the space server. Throws BusError.
void UseToken(const AccessToken& token, BusOptions& options);

// Returns a time such as 2026-11-23T05:15:00Z.
std::string UtcText(std::int64_t seconds);

}  // namespace swarmanoid
