// Signed datagrams protect DDS itself. Without the key of the run, no process can send in the name of its processes. It
// cannot announce them, their writers or lost messages either. Each bus has one object; any thread may use it. No
// header of Fast DDS is used.
//
// A process that holds the key of its run ends each datagram with a submessage of RTPS of its own, which others skip:
//
//   kind, flags, length 4 | salt 12 | number 8 | code 16
//
// The signature stands before the statistics of Fast DDS. These are not signed, and processes with a key do not read
// them. The code is that of AES-256-GCM over all bytes before it. Its key is derived from the run's key and the salt,
// which the process draws when it starts. A process that has signed once is known by its GUID prefix. From then on,
// unsigned datagrams that come from it or name it are dropped. Other processes are heard as before: those of other
// users and runs, and holders of grants. RTPS handles repeated signed datagrams, because it numbers all changes.
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

// All identifiers of one process in RTPS begin with its prefix.
using GuidPrefix = std::array<char, 12>;

class DatagramSignatures
{
public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kBytes = 4 + kSaltBytes + 8 + kCodeBytes;

  // Unsigned datagrams of a process may arrive after its first signed one. They are dropped without a report for
  // `settling`. A stranger that is silent for `absence` is not counted any more.
  explicit DatagramSignatures(std::shared_ptr<KeyRing> keys, Clock::duration settling = std::chrono::seconds(2),
                              Clock::duration absence = std::chrono::seconds(100))
      : keys_(std::move(keys)), settling_(settling), absence_(absence)
  {
  }

  // How many processes without the key may be announced at a time. Each costs a process memory and, when it ends, tens
  // of milliseconds. A few hundred do not disturb a run; a thousand delay its end by half a minute.
  static constexpr std::size_t kMostStrangers = 256;

  // Returns the datagram itself without a key; otherwise the signed one, in `room`. Throws BusError.
  std::span<const char> Sign(std::span<const char> datagram, std::vector<char>& room);

  struct Checked
  {
    std::span<const char> datagram;  // without its signature; empty if it must be dropped
    // The process that it claims to be from or is about, if its sender is another process.
    std::optional<GuidPrefix> forged{};
    // The datagram is dropped because there are too many strangers.
    bool is_one_too_many = false;
    // This process has a key, and the sender did not sign with it.
    bool is_of_stranger = false;
  };
  // Checks a datagram. Throws BusError.
  Checked Check(std::span<const char> datagram);

private:
  // Removes a signature, if there is one. Returns true if it is good.
  bool IsSigned(std::span<const char>& datagram);
  // Checks whether the datagram comes from a member or names one.
  Checked CheckUnsigned(std::span<const char> datagram);
  // Counts the process among the strangers. Returns false if there are too many.
  bool MayAnnounce(const GuidPrefix& stranger);
  Checked Forged(const GuidPrefix& member) const;
  std::optional<GuidPrefix> FindMember(std::span<const char> submessage) const;

  const std::shared_ptr<KeyRing> keys_;
  const Clock::duration settling_;
  const Clock::duration absence_;
  std::mutex signs_;  // protects the next four
  std::optional<RunKey> key_;
  Salt salt_{};
  Cipher signer_;
  std::uint64_t number_ = 0;
  std::mutex checks_;                                  // protects the following members
  std::map<Salt, Cipher> checkers_;                    // by salt of a process that has signed
  std::map<GuidPrefix, Clock::time_point> members_;    // the processes that have signed, and this one: since when
  std::map<GuidPrefix, Clock::time_point> strangers_;  // announced without the key: when last
};

}  // namespace swarmanoid
