// How a study and the processes that run it elsewhere write to each other, through pipes and in files: contents, each
// behind a mark, its length and its checksum, so that what another program says, what is cut short and what was changed
// on its way are told apart from a message.
#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace swarmanoid
{

class FrameError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// The mark (8 bytes), length (u64), XXH3 (64 bits) and the content.
std::vector<char> Framed(std::span<const char> content);

class FrameReader
{
public:
  void Add(std::span<const char> bytes);
  // The next content; nothing if it is not whole yet. Before the first one there may be some lines of others: shells
  // greet. Throws FrameError.
  std::optional<std::vector<char>> Next();
  // Whether all that was added has been taken.
  bool AtEnd() const { return begin_ == bytes_.size(); }
  // What came before the first mark.
  std::string Noise() const;

private:
  void SkipNoise();

  std::vector<char> bytes_;
  std::size_t begin_ = 0;
  std::string noise_;
  bool has_begun_ = false;
};

}  // namespace swarmanoid
