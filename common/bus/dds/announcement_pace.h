// Fast DDS announces a process to all processes that it knows whenever it finds another one. Where N processes start
// together, each would be told N times. The pace leaves out what a process was told shortly before. Fast DDS repeats
// announcements, so one that is lost comes again.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace swarmanoid
{

class AnnouncementPace
{
public:
  using Clock = std::chrono::steady_clock;
  static constexpr auto kPause = std::chrono::milliseconds(200);

  // Returns whether it is a datagram of the built-in writer that announces processes (RTPS 2.2, 8.5.3 and 9.3.1.3).
  // `datagram` has a valid structure, as Fast DDS made it.
  static bool IsAnnouncement(std::span<const char> datagram)
  {
    constexpr std::size_t kHeader = 20, kWriterAt = 12;
    constexpr char kData = 0x15;
    constexpr char kAnnouncer[4] = {0, 1, 0, static_cast<char>(0xc2)};
    for (std::size_t at = kHeader; at + kWriterAt + sizeof kAnnouncer <= datagram.size();)
    {
      const char* const submessage = datagram.data() + at;
      if (submessage[0] == kData) return std::memcmp(submessage + kWriterAt, kAnnouncer, sizeof kAnnouncer) == 0;
      const auto byte = [&](std::size_t k) { return static_cast<unsigned>(static_cast<unsigned char>(submessage[k])); };
      at += 4 + ((byte(1) & 1U) != 0 ? byte(2) | byte(3) << 8U : byte(3) | byte(2) << 8U);
    }
    return false;
  }

  // A socket, and an address with its port.
  using Way = std::pair<const void*, std::uint64_t>;

  // Takes an announcement that goes a way now. Returns whether the same bytes went it less than kPause before. Then
  // they need not go.
  bool IsEarly(std::span<const char> announcement, const Way& way, Clock::time_point now)
  {
    if (last_.size() != announcement.size() || std::memcmp(last_.data(), announcement.data(), last_.size()) != 0)
    {
      last_.assign(announcement.begin(), announcement.end());
      told_.clear();
    }
    const auto [known, is_new] = told_.try_emplace(way, now);
    if (!is_new && now - known->second < kPause) return true;
    known->second = now;
    return false;
  }

private:
  std::vector<char> last_;
  std::map<Way, Clock::time_point> told_;
};

}  // namespace swarmanoid
