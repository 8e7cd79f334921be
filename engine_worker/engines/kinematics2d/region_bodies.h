// The bodies that a region of a cut plane holds, and how they come and go.
//
// A region computes the blocks of cells that it was given. It holds the bodies in them and in the cells around them,
// with numbers of its own. The region where a body is when a substep begins computes ("owns") it, and sends it to all
// regions that hold it; bodies that a region holds and does not own are copies.
#pragma once

#include <span>
#include <vector>

#include "common/math/lanes.h"
#include "engine_worker/engines/kinematics2d/region_messages.h"

namespace swarmanoid::kinematics2d
{

// Messages to and from all other regions. Each region writes to `out` and swaps; all do so equally often.
class RegionMail
{
public:
  RegionMail(unsigned number, RegionExchange& exchange)
      : exchange_(exchange), out_(exchange.RegionCount()), in_(exchange.RegionCount())
  {
    others_ = static_cast<std::uint32_t>(((std::uint64_t{1} << exchange.RegionCount()) - 1) & ~(1ULL << number));
  }

  unsigned RegionCount() const { return static_cast<unsigned>(out_.size()); }
  std::uint32_t Others() const { return others_; }  // one bit for each
  ByteWriter& To(unsigned region) { return out_[region]; }
  // Calls write(region, message) for each other region, swaps, then calls read(region, message) for each.
  template <class Write, class Read>
  void Swap(const Write& write, const Read& read)
  {
    ForEachBit(others_, [&](unsigned region) { write(region, out_[region]); });
    exchange_.Swap(out_, in_);
    for (ByteWriter& message : out_) message.Clear();
    ForEachBit(others_,
               [&](unsigned region)
               {
                 ByteReader message(in_[region]);
                 read(region, message);
               });
  }

private:
  RegionExchange& exchange_;
  std::uint32_t others_;
  std::vector<ByteWriter> out_;
  std::vector<std::vector<char>> in_;
};

class RegionBodies
{
public:
  // `plane` has the followers alone, which have these numbers in the whole plane. It outlives this object.
  RegionBodies(PlaneState& plane, std::vector<std::uint32_t> followers, unsigned number, RegionExchange& exchange,
               unsigned halo);

  void SetCuts(std::span<const std::uint8_t> region_of_block);
  // Sets all grips of the whole plane, by its numbers and in its order.
  void SetGrips(std::vector<Grip> grips);
  // The sets of held bodies are found again before the next substep. To be called in all regions at once.
  void ShareOutAnew() { is_shared_out_ = false; }
  // Owns the bodies of the message, as PutBody wrote them.
  void TakeBodies(ByteReader& message);
  // Brings the bodies and their owners up to date. Is called before each substep.
  void Share();

  // Blocks in which held bodies may be, ascending.
  std::span<const std::uint32_t> HeldBlocks() const { return held_blocks_; }
  std::uint32_t NumberInWhole(std::uint32_t body) const { return numbers_[body]; }
  // kNobody if the region does not hold it.
  std::uint32_t Find(std::uint32_t number_in_whole) const;
  bool IsOwn(std::uint32_t body) const { return is_own_[body] != 0; }
  // Throws std::runtime_error for a body that the region does not own.
  std::uint32_t FindOwn(std::uint32_t number_in_whole) const;
  // Returns the bodies that it owns, ascending. Valid until the next call.
  std::span<const std::uint32_t> ListOwn();
  // The bodies that this region and another one hold, ascending.
  std::span<const std::uint32_t> Common(unsigned region) const { return common_[region]; }
  RegionMail& Mail() { return mail_; }

private:
  using Regions = std::uint32_t;  // one bit each

  Regions Bit(unsigned region) const { return Regions{1} << region; }
  // Requires FindCells and MarkEverywhere.
  Regions HoldersOf(std::uint32_t body) const;
  // Returns whether this region owns the body and no other region holds it.
  bool IsInner(std::uint32_t body) const { return (is_own_[body] & inner_[cells_[body]]) > is_everywhere_[body]; }
  void FindCells();
  void MarkEverywhere();
  void ShareOut();
  void ShareBorder();
  void SwapBodies();
  void TakeArrived();
  bool Merge();
  void Settle(std::uint32_t body, const BodyMessage& arrived);
  void FindCommon();

  PlaneState& plane_;
  Bodies& bodies_;
  const BroadPhase& broad_;
  unsigned number_;
  unsigned halo_;
  RegionMail mail_;

  // Values of each cell.
  std::vector<std::uint8_t> owner_;
  std::vector<Regions> holders_;
  std::vector<std::uint8_t> inner_;  // this region alone holds the bodies in it
  std::vector<std::uint32_t> held_blocks_;

  bool is_shared_out_ = false;
  double way_ = 0;  // m: no body has gone further since the bodies were shared out
  // Values of each body that is held.
  std::vector<std::uint32_t> numbers_;  // in the whole plane, ascending
  std::vector<std::uint8_t> is_own_;
  std::vector<std::uint8_t> is_everywhere_;  // all regions hold it
  std::vector<std::uint32_t> cells_;
  std::vector<std::vector<std::uint32_t>> common_;
  std::vector<std::uint32_t> border_;  // bodies that any other region holds
  std::vector<std::uint32_t> own_;     // of ListOwn

  std::vector<Grip> grips_;                // of the whole plane
  std::vector<BodyMessage> arrived_;       // by number
  std::vector<std::uint32_t> arrived_at_;  // the body that each of them is
  std::vector<std::uint32_t> gone_;        // bodies that are not held any more, unless they arrive again
  std::vector<Run> runs_;                  // of the bodies that stay
  std::uint32_t new_count_ = 0;
};

}  // namespace swarmanoid::kinematics2d
