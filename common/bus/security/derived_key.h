// Keys that follow from the key of a run: those of messages, and those of access grants.
#pragma once

#include <span>
#include <string>

#include "common/run/access/access_grant.h"

namespace swarmanoid
{

// Derives a key from another one (HKDF-SHA256, RFC 5869) that does not reveal it. Throws BusError.
RunKey DerivedKey(const RunKey& key, std::span<const char> salt, const std::string& purpose);

// Returns the channel of a grant, with its own key. Throws BusError.
GrantChannel ChannelOf(const RunKey& run_key, const AccessGrant& grant);

}  // namespace swarmanoid
