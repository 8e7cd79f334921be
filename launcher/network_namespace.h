// A run in a network of its own on this machine (`swarmanoid run --isolated`): a network namespace with nothing but a
// loopback interface, and for those who are not root a user namespace that owns it. Nobody else's program can send
// anything to the run, or see that it is there; whoever is the same user enters. docs/security.md says what it costs.
// Used by the launcher while it has one thread.
#pragma once

#include <sys/types.h>

namespace swarmanoid
{

// This process, and those that it starts. Throws UsageError if the system forbids it.
void IsolateNetwork();
// Into the network of another process of this user, if that is in another one. Throws UsageError.
void EnterNetworkOf(pid_t process);
bool IsInAnotherNetwork(pid_t process);

}  // namespace swarmanoid
