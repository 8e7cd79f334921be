// Frames for messages between a study and the processes that run it, through sockets, pipes and in files. Each content
// follows a mark, its length and its checksum. So a reader distinguishes messages from output of other programs, from
// cut frames and from changed bytes.
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

// Returns the mark (8 bytes), length (u64), XXH3 (64 bits) and the content.
std::vector<char> Framed(std::span<const char> content);

class FrameReader
{
public:
  // Appends received bytes.
  void Add(std::span<const char> bytes);
  // Returns the next content; nothing if it is not complete yet. Before the first one, some lines of other programs are
  // allowed, such as a shell's greeting. Throws FrameError.
  std::optional<std::vector<char>> Next();
  // Returns whether all added bytes have been read.
  bool AtEnd() const { return begin_ == bytes_.size(); }
  // Returns the bytes before the first mark.
  std::string Noise() const;

private:
  void SkipNoise();

  std::vector<char> bytes_;
  std::size_t begin_ = 0;
  std::string noise_;
  bool has_begun_ = false;
};

}  // namespace swarmanoid
