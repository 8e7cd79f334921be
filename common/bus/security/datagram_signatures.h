// Signed datagrams: nobody without the key of the run speaks in the name of its processes, or about them, to DDS
// itself: who they are, which writers they have, what was lost. Of one bus; from any thread. No header of Fast DDS is
// used.
//
// A process that holds the key of its run ends each datagram with a submessage of RTPS of its own, which others skip:
//
//   kind, flags, length 4 | salt 12 | number 8 | code 16
//
// in front of the statistics that Fast DDS ends them with, which are not signed, and not read by who holds a key.
// The code is that of AES-256-GCM over all before it, under a key that follows from that of the run and the salt, which
// the process draws when it starts. A process that signed once is known by its GUID prefix; from then on nothing
// without a signature is heard that is said by it, or that names it. Others are heard as before: processes of other
// users and runs, and holders of shares. A signed datagram that comes again is for RTPS, which numbers what changes
// anything.
#pragma once

#include <array>
#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "common/bus/security/key_ring.h"
#include "common/bus/security/seal.h"

namespace swarmanoid
{

// Of a process in RTPS.
using GuidPrefix = std::array<char, 12>;

class DatagramSignatures
{
public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kBytes = 4 + kSaltBytes + 8 + kCodeBytes;

  // What a process sent before it signed may come behind what it signed: that is not heard, and not told, for
  // `settling`. A stranger that is silent for `absence` is not counted any more.
  explicit DatagramSignatures(std::shared_ptr<KeyRing> keys, Clock::duration settling = std::chrono::seconds(2),
                              Clock::duration absence = std::chrono::seconds(100))
      : keys_(std::move(keys)), settling_(settling), absence_(absence)
  {
  }

  // Processes without the key that may announce themselves at a time. Each costs a process memory and, when it ends,
  // tens of milliseconds. With a few hundred a run goes on as without; a thousand make it end half a minute late.
  static constexpr std::size_t kMostStrangers = 256;

  // Itself without a key; otherwise signed, in `room`. Throws BusError.
  std::span<const char> Sign(std::span<const char> datagram, std::vector<char>& room);

  struct Checked
  {
    std::span<const char> datagram;  // without its signature; empty if nobody may hear it
    // The process that it is about, if somebody else sent it.
    std::optional<GuidPrefix> forged{};
    // There are too many strangers for this one to be heard.
    bool is_one_too_many = false;
    // This process has a key, and the sender did not sign with it.
    bool is_of_stranger = false;
  };
  // Throws BusError.
  Checked Check(std::span<const char> datagram);

private:
  // Cuts off a signature that is there. True if it is good.
  bool IsSigned(std::span<const char>& datagram);
  // Whether it speaks for a member, or names one.
  Checked CheckUnsigned(std::span<const char> datagram);
  // Counts it among the strangers. False if there are too many.
  bool MayAnnounce(const GuidPrefix& stranger);
  Checked Forged(const GuidPrefix& member) const;
  std::optional<GuidPrefix> FindMember(std::span<const char> submessage) const;

  const std::shared_ptr<KeyRing> keys_;
  const Clock::duration settling_;
  const Clock::duration absence_;
  std::mutex signs_;  // of the next four
  std::optional<RunKey> key_;
  Salt salt_{};
  Cipher signer_;
  std::uint64_t number_ = 0;
  std::mutex checks_;                                  // of what follows
  std::map<Salt, Cipher> checkers_;                    // of those who signed
  std::map<GuidPrefix, Clock::time_point> members_;    // likewise, and this process: since when
  std::map<GuidPrefix, Clock::time_point> strangers_;  // that announced themselves without the key: when last
};

}  // namespace swarmanoid
