// A run in a network of its own on this machine (`swarmanoid run --isolated`): a network namespace with only a loopback
// interface. Users other than root also get a user namespace that owns it. Programs of other users can neither send to
// the run nor see it; programs of the same user can enter. docs/security.md has the costs. The launcher uses it while
// it has one thread.
#pragma once

#include <sys/types.h>

namespace swarmanoid
{

// Isolates this process and those that it starts. Throws UsageError if the system forbids it.
void IsolateNetwork();
// Enters the network of another process of this user, if it is another one. Throws UsageError.
void EnterNetworkOf(pid_t process);
bool IsInAnotherNetwork(pid_t process);

}  // namespace swarmanoid
