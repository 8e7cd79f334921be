// Any bytes are refused as a checkpoint with a reason, or are one that is written again with the same bytes. The same
// holds for the bytes with a correct length and checksum, so that the code behind the checksum is reached.
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "common/checkpoint/checkpoint.h"
#include "common/checkpoint/checkpoint_format.h"
#include "tests/fuzz/fuzz_driver.h"

namespace swarmanoid
{
namespace
{

Checkpoint SmallCheckpoint()
{
  Checkpoint checkpoint;
  checkpoint.origin = {0x0123456789abcdef, {{kSwarmanoidBuild, "00ff"}, {"libfootbot_diffusion.so", "17"}}};
  checkpoint.snapshot.tick = 200;
  checkpoint.snapshot.poses = {1, 2, 0, 0, 0, 0, 1};
  checkpoint.snapshot.attributes = {0.5, -0.0};
  checkpoint.parts = {{kServerPart, {'a', 'b'}}, {"engine 'ground'", {}}, {"controller host 0", {'c'}}};
  return checkpoint;
}

bool Take(std::span<const char> bytes)
{
  try
  {
    const std::vector<char> again = EncodeCheckpoint(DecodeCheckpoint(bytes));
    if (!std::equal(again.begin(), again.end(), bytes.begin(), bytes.end())) std::abort();
    return true;
  }
  catch (const std::runtime_error& error)
  {
    if (std::string_view(error.what()).empty()) std::abort();
    return false;
  }
}

}  // namespace

std::vector<fuzz::Input> fuzz::FirstInputs()
{
  std::vector<Input> inputs;
  for (const Checkpoint& checkpoint : {SmallCheckpoint(), Checkpoint()})
  {
    const std::vector<char> bytes = EncodeCheckpoint(checkpoint);
    if (!Take(bytes)) std::abort();
    inputs.emplace_back(bytes.begin(), bytes.end());
  }
  return inputs;
}

}  // namespace swarmanoid

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* input, std::size_t count)
{
  using namespace swarmanoid;
  std::vector<char> bytes(input, input + count);
  const bool taken = Take(bytes);
  std::vector<char> sealed = bytes;
  SealCheckpoint(sealed);
  Take(sealed);
  // One changed bit of an accepted checkpoint is enough for a refusal.
  if (taken)
    for (std::size_t at = 0; at < bytes.size(); at += 1 + bytes.size() / 64)
    {
      bytes[at] ^= 4;
      if (Take(bytes)) std::abort();
      bytes[at] ^= 4;
    }
  return 0;
}
