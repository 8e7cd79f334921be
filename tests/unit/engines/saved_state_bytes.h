// Finds bytes of a saved state that do not count. The tests of checkpoints use it.
#pragma once

#include <functional>
#include <stdexcept>
#include <vector>

#include "common/serialisation/bytes.h"

namespace swarmanoid
{

// Returns the positions of bytes that are lost when a state is loaded: a changed byte is neither refused nor in the
// result of `saved_again`, which loads a state and saves it again. The lowest bit is changed, so that no number becomes
// infinite.
inline std::vector<std::size_t> LostBytes(const std::vector<char>& saved,
                                          const std::function<std::vector<char>(const std::vector<char>&)>& saved_again)
{
  std::vector<std::size_t> lost;
  for (std::size_t place = 0; place < saved.size(); ++place)
  {
    std::vector<char> changed = saved;
    changed[place] ^= 1;
    try
    {
      if (saved_again(changed) == saved) lost.push_back(place);
    }
    catch (const std::runtime_error&)
    {
      // The change was refused, so the byte counts.
    }
  }
  return lost;
}

// Loads a state into an engine and saves it again.
template <class Engine>
std::vector<char> SavedAgain(Engine& engine, const std::vector<char>& state)
{
  ByteReader reader(state);
  engine.LoadState(reader);
  ByteWriter writer;
  engine.SaveState(writer);
  return writer.Bytes();
}

}  // namespace swarmanoid
