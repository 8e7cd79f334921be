// StatusChannel: how the space server tells the launcher what it is doing: one line an event on a descriptor, at most
// ten progress lines a second. The format is in docs/wire.md.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <string>

namespace swarmanoid
{

class StatusChannel
{
public:
  // Negative: nobody listens.
  explicit StatusChannel(int descriptor) : descriptor_(descriptor) {}

  bool IsOpen() const { return descriptor_ >= 0; }

  void Say(std::string line)
  {
    if (descriptor_ < 0) return;
    std::replace(line.begin(), line.end(), '\n', ' ');
    line += '\n';
    // A launcher that has gone is noticed elsewhere.
    if (write(descriptor_, line.data(), line.size()) < 0) descriptor_ = -1;
  }

private:
  int descriptor_;
};

}  // namespace swarmanoid
