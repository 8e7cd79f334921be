// An access grant: what somebody needs to look at a run, or to steer it, without being a member of it. Its key follows
// from the key of the run, and does not tell that one; the space server speaks to its holders over topics of their own
// (GrantChannel), so that they can say nothing that members believe. An open view is a grant without a key: programs of
// any DDS read it, and nothing that they say is heard. Used by the launcher, the visualiser and the space server;
// docs/security.md tells what a holder can do.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/bus/bus.h"

namespace swarmanoid
{

enum class GrantRole
{
  kWatcher,   // looks at the run
  kOperator,  // steers it too
  kOpenView,  // anybody looks
};
// "watch", "operate" and "open", in tokens and requests; nullopt for other words.
const char* RoleWord(GrantRole role);
std::optional<GrantRole> GrantRoleOf(const std::string& word);
// "watcher", "operator" and "open view", for people.
const char* RoleName(GrantRole role);

struct AccessGrant
{
  std::string id;  // 8 hexadecimal digits
  GrantRole role = GrantRole::kWatcher;
  std::int64_t ends = 0;  // seconds since 1970; 0: with the run

  bool HasEnded() const;
  // "operator share 1a2b3c4d"
  std::string Name() const;
};

// What the topics of an open view have behind their slash.
inline constexpr const char* kOpenChannel = "open";

std::string NewGrantId();
bool IsGrantId(const std::string& text);
GrantChannel ChannelOf(const RunKey& run_key, const AccessGrant& grant);

// What the holder of one with a key is given, in one word, beside the name of the experiment.
struct AccessToken
{
  AccessGrant grant;
  int domain = 0;
  std::string address;           // of the space server
  std::string discovery_server;  // BusOptions
  RunKey key{};
  std::string experiment;
};

std::string TextOf(const AccessToken& token);
// nullopt for anything else.
std::optional<AccessToken> TokenOfText(const std::string& text);

// The token in the environment of this process, which other users cannot see, unlike its words. Throws BusError if it
// is none, or has ended.
inline constexpr const char* kTokenVariable = "SWARMANOID_SHARE";
std::optional<AccessToken> TokenOfEnvironment();
// What a bus needs to use it. The interface is that by which this machine reaches the space server. Throws BusError.
void UseToken(const AccessToken& token, BusOptions& options);

// 2026-11-23T05:15:00Z
std::string UtcText(std::int64_t seconds);

}  // namespace swarmanoid
