// SharedChannel: the radio channel that the senders in reach of a receiver share. A tick has slots, and each packet
// takes one at random, as in slotted ALOHA (Abramson 1970; Roberts 1975). The power of a link follows the log-distance
// model with log-normal shadowing (Rappaport, Wireless Communications, 4.9):
//
//   signal = -10 n log10(d / 1 m) + X  in dB relative to the power at 1 m, X from N(0, shadowing), one for each link
//
// A packet is received if it is at least as strong as one from the range without shadowing, if it exceeds the sum of
// all others in its slot by the capture ratio, and if the receiver does not send in that slot.
//
// Shadowing depends on the ids of both robots alone, and a slot on the id of the sender and the tick. So all receivers
// agree, in all hosts.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "common/configuration/parameter.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

class SharedChannel
{
public:
  // A packet that may arrive at a receiver.
  struct Arrival
  {
    std::uint32_t sender = 0;  // entity
    std::uint32_t slot = 0;
    double signal_db = 0;
    std::size_t index = 0;  // for the caller
  };

  // `channel` distinguishes channels that do not disturb each other. The space must outlive the object.
  SharedChannel(const Parameters& parameters, const CSwarmanoidSpace& space, std::string_view channel);

  // Returns the distance (m) beyond which packets neither arrive nor disturb: that of a link that is four deviations of
  // the shadowing stronger than usual.
  double Reach() const { return reach_m_; }
  // Returns the slot in which a sender's packet of this tick is. `name`: StreamName of its id.
  std::uint32_t SlotOf(std::uint64_t name) const;
  // Returns the signal of a link by the squared distance and the names of both robots.
  double Signal_dB(std::uint64_t sender, std::uint64_t receiver, double square_m2) const;
  // Keeps the packets that are received, in the order of the senders. `own_slot` is the slot in which the receiver
  // itself sends.
  void Receive(std::vector<Arrival>& arrivals, std::optional<std::uint32_t> own_slot) const;

private:
  const CSwarmanoidSpace& space_;
  std::uint64_t slot_purpose_, link_purpose_;
  double exponent_, shadowing_db_, capture_db_, least_db_, reach_m_;
  std::uint32_t slots_;
};

}  // namespace swarmanoid
