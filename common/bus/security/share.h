// A share: what somebody needs to look at a run, or to steer it, without being a member of it. Its key follows from the
// key of the run, and does not tell that one; the space server speaks to its holders over topics of their own
// (ShareChannel), so that they can say nothing that members believe. An open view is a share without a key: programs of
// any DDS read it, and nothing that they say is heard. Used by the launcher, the visualiser and the space server;
// docs/security.md tells what a holder can do.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/bus/bus.h"

namespace swarmanoid
{

// By the number that requests have.
enum class ShareRole
{
  kWatcher = 0,
  kOperator = 1,
  kOpenView = 2,  // anybody looks
};
// nullopt for a number that is none.
std::optional<ShareRole> ShareRoleOf(double number);
// "watcher", "operator", "open view"
const char* RoleName(ShareRole role);

struct Share
{
  std::string id;  // 8 hexadecimal digits
  ShareRole role = ShareRole::kWatcher;
  std::int64_t ends = 0;  // seconds since 1970; 0: with the run

  bool HasEnded() const;
  // "operator share 1a2b3c4d"
  std::string Name() const;
};

// What the topics of an open view have behind their slash.
inline constexpr const char* kOpenChannel = "open";

std::string NewShareId();
bool IsShareId(const std::string& text);
ShareChannel ChannelOf(const RunKey& run_key, const Share& share);

// What the holder of one with a key is given, in one word, beside the name of the experiment.
struct ShareTicket
{
  Share share;
  int domain = 0;
  std::string address;           // of the space server
  std::string discovery_server;  // BusOptions
  RunKey key{};
  std::string experiment;
};

std::string TextOf(const ShareTicket& ticket);
// nullopt for anything else.
std::optional<ShareTicket> TicketOfText(const std::string& text);

// The ticket in the environment of this process, which other users cannot see, unlike its words. Throws BusError if it
// is none, or has ended.
inline constexpr const char* kShareVariable = "SWARMANOID_SHARE";
std::optional<ShareTicket> TicketOfEnvironment();
// What a bus needs to use it. The interface is that by which this machine reaches the space server. Throws BusError.
void UseTicket(const ShareTicket& ticket, BusOptions& options);

// 2026-11-23T05:15:00Z
std::string UtcText(std::int64_t seconds);

}  // namespace swarmanoid
