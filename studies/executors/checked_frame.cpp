#include "studies/executors/checked_frame.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

constexpr std::string_view kMark("\x93SWSTUDY", 8);
constexpr std::size_t kHead = kMark.size() + 2 * sizeof(std::uint64_t);
constexpr std::uint64_t kMostContent = 1ULL << 32U;
constexpr std::size_t kMostNoise = 1U << 16U;

}  // namespace

std::vector<char> Framed(std::span<const char> content)
{
  const std::uint64_t size = content.size();
  const std::uint64_t checksum = XXH3_64bits(content.data(), content.size());
  std::vector<char> frame(kHead + content.size());
  std::memcpy(frame.data(), kMark.data(), kMark.size());
  std::memcpy(frame.data() + kMark.size(), &size, sizeof size);
  std::memcpy(frame.data() + kMark.size() + sizeof size, &checksum, sizeof checksum);
  if (!content.empty()) std::memcpy(frame.data() + kHead, content.data(), content.size());
  return frame;
}

void FrameReader::Add(std::span<const char> bytes)
{
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(begin_));
  begin_ = 0;
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

// Bytes that could begin a mark are kept.
void FrameReader::SkipNoise()
{
  const auto from = bytes_.begin() + static_cast<std::ptrdiff_t>(begin_);
  const auto found = std::search(from, bytes_.end(), kMark.begin(), kMark.end());
  has_begun_ = found != bytes_.end();
  const auto kept = static_cast<std::ptrdiff_t>(std::min<std::size_t>(kMark.size() - 1, bytes_.size() - begin_));
  const auto end = has_begun_ ? found : bytes_.end() - kept;
  noise_.append(from, end);
  begin_ = static_cast<std::size_t>(end - bytes_.begin());
}

std::string FrameReader::Noise() const
{
  return has_begun_ ? noise_ : noise_ + std::string(bytes_.begin() + static_cast<std::ptrdiff_t>(begin_), bytes_.end());
}

std::optional<std::vector<char>> FrameReader::Next()
{
  if (!has_begun_) SkipNoise();
  if (!has_begun_ && noise_.size() > kMostNoise)
    throw FrameError(fmt::format("what comes is not of a study: {}", Quoted(noise_.substr(0, 200))));
  if (!has_begun_ || bytes_.size() - begin_ < kHead) return std::nullopt;
  const char* head = bytes_.data() + begin_;
  if (std::string_view(head, kMark.size()) != kMark)
    throw FrameError("a message is followed by something that is none: something else writes there, too");
  std::uint64_t size = 0, checksum = 0;
  std::memcpy(&size, head + kMark.size(), sizeof size);
  std::memcpy(&checksum, head + kMark.size() + sizeof size, sizeof checksum);
  if (size > kMostContent) throw FrameError(fmt::format("a message claims to have {} bytes", size));
  if (bytes_.size() - begin_ - kHead < size) return std::nullopt;
  std::vector<char> content(head + kHead, head + kHead + size);
  if (XXH3_64bits(content.data(), content.size()) != checksum)
    throw FrameError("a message was changed on its way: its checksum differs");
  begin_ += kHead + size;
  return content;
}

}  // namespace swarmanoid
