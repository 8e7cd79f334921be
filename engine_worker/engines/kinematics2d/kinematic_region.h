// What a kinematic world has and does more if it is one of the regions into which a plane is cut. Private to it.
//
// A region computes the blocks of cells that it was given, and holds the bodies in them and in the cells around them.
// It needs those next to its blocks and holds two rows of cells, so that who holds whom lasts until somebody may have
// gone as far as a cell is wide. Then, and when somebody is put elsewhere, whoever computes a body tells it to all who
// are to hold it: so bodies migrate. Who of those computes it follows from where it is when a substep begins. All that
// happens to a body is told to all who hold it, by who does it; each computes the same from it.
//
// What is not bound to a place is told to all regions, and computed by each: the largest ways, who grips whom, contacts
// of groups and of large bodies, and the limits of motions, whose rounds end for all at once. There is little of it.
#pragma once

#include <compare>
#include <initializer_list>
#include <map>

#include "common/experiment/experiment.h"
#include "common/math/lanes.h"
#include "common/messages/regions.h"
#include "engine_worker/engines/kinematics2d/kinematic_world.h"

namespace swarmanoid::kinematics2d
{

// Throws std::runtime_error for what is no cut of the plane into so many regions.
void CheckCuts(const BroadPhase& broad, std::span<const std::uint8_t> region_of_block, unsigned regions);

class KinematicWorld::Region final : public ContactSolver::Border
{
public:
  using Stamp = ContactSolver::Stamp;

  // Of a world that has the followers alone, which have these numbers in the whole one.
  Region(KinematicWorld& world, std::vector<std::uint32_t> followers, unsigned number, RegionExchange& exchange,
         unsigned halo);

  void SetCuts(KinematicWorld& world, std::span<const std::uint8_t> region_of_block);

  // Blocks in which bodies may be that it holds, ascending.
  std::span<const std::uint32_t> HeldBlocks() const { return held_blocks_; }
  // Those of all regions, by numbers in the whole world and in its order.
  void SetGrips(std::vector<Grip> grips);
  // Who holds whom is decided anew before the next substep. For all regions at once.
  void ShareOutAnew() { is_shared_out_ = false; }
  // It computes those that follow, as PutBody wrote them.
  void TakeBodies(KinematicWorld& world, ByteReader& bodies);

  // In this order in Advance: before each substep the bodies.
  void ShareBodies(KinematicWorld& world);
  // Each number becomes the largest one of all regions.
  void ShareMaxima(std::initializer_list<double*> numbers);
  // Of the pairs of large bodies, those that this region computes, each as a part of its own.
  void ChoosePairsOfLarge(KinematicWorld& world);
  // Contacts of groups and of large bodies in all regions take the place of those in this one.
  void ShareContacts(KinematicWorld& world);
  bool OverlapsAnywhere() const { return overlaps_anywhere_; }
  bool AfterColour(Stamp begin, bool moved) override;
  ContactSolver::Leaders TakeShared(double most) override;
  void PutShared(Stamp begin) override;
  // Those that came to be involved since the last call in this substep. Returns whether there are any, or `more` is
  // true, in any region.
  bool ShareInvolved(KinematicWorld& world, bool more);
  // Those of the other regions, in numbers of this world; of bodies that it does not hold, numbers behind its own.
  const LimitList& ShareLimits(KinematicWorld& world);

  std::uint32_t NumberInWhole(std::uint32_t body) const { return numbers_[body]; }
  std::uint32_t FindBody(std::uint32_t number_in_whole) const;
  bool IsOwn(std::uint32_t body) const { return is_own_[body] != 0; }
  // The bodies that it computes, ascending.
  std::span<const std::uint32_t> FindOwn();
  static void PutBody(const KinematicWorld& world, std::uint32_t body, std::uint32_t number, ByteWriter& message);

private:
  using Regions = std::uint32_t;  // one bit each

  // A body on the wire, and what follows if it is true.
  struct Arrival
  {
    std::uint32_t number;
    std::uint32_t model : 30, is_present : 1, has_turret : 1;
    Pose2 pose;
    Twist twist;
  };
  struct TurretState
  {
    double angle, rate;
  };
  struct Travel
  {
    double forward, turn;
  };
  struct ArrivedBody
  {
    Arrival body;
    TurretState turret;
    Travel travel;
  };
  // Of bodies that keep their order: they go from some numbers to others.
  struct Run
  {
    std::uint32_t from, to, count;
  };
  // A push of a body, which is numbered among those that two regions hold.
  struct Pushed
  {
    std::uint32_t index;
    std::uint32_t stamp;
    double x, y;
  };
  // A leader in a shared contact, where its motion ended.
  struct SharedLeader
  {
    std::uint32_t number;
    std::uint32_t padding;
    double x, y, mobility;
  };
  // What comes first: contacts of groups by blocks; then those of large bodies, by large body, then by the cell of the
  // other one, by the other one.
  struct Order
  {
    std::uint32_t large;  // 0, or 1 + its number in the whole world
    std::uint32_t place;  // block or cell; behind all cells large bodies and static shapes
    std::uint32_t other;

    auto operator<=>(const Order&) const = default;
  };
  struct SharedContact
  {
    Order order;
    std::uint16_t face, overlaps;
    SharedLeader first, second;
    ContactList::Outline outline;
  };

  static constexpr std::uint32_t kNobody = ~0U;
  Regions Bit(unsigned region) const { return Regions{1} << region; }
  // After FindCells and MarkEverywhere.
  Regions HoldersOf(std::uint32_t body) const;
  // Whether it stays where nobody else knows of it.
  bool IsInner(std::uint32_t body) const { return (is_own_[body] & inner_[cells_[body]]) > is_everywhere_[body]; }
  template <class Act>
  void ForEachOther(const Act& act) const
  {
    ForEachBit(others_, act);
  }
  void Swap();
  void ShareOut(KinematicWorld& world);
  void TellBorder(KinematicWorld& world);
  void FindCells(const KinematicWorld& world);
  void ReadBodies(const KinematicWorld& world);
  void ReadBodies(const KinematicWorld& world, ByteReader& message);
  void SortArrived();
  void TakeArrived(KinematicWorld& world);
  void MarkEverywhere(const KinematicWorld& world);
  bool Merge(const KinematicWorld& world);
  void FindRuns(std::uint32_t count);
  void Rearrange(KinematicWorld& world);
  void Settle(KinematicWorld& world, std::uint32_t body, const ArrivedBody& arrived);
  void FindCommon(const KinematicWorld& world);
  SharedLeader LeaderAt(const KinematicWorld& world, std::uint32_t leader) const;
  void AddOwnContacts(const KinematicWorld& world);
  void NumberLeaders(KinematicWorld& world);
  std::uint32_t IndexOfShared(std::uint32_t number) const;
  std::uint32_t LimitedBody(const KinematicWorld& world, std::uint32_t number);
  [[noreturn]] static void Refuse(const char* what);

  unsigned number_;
  unsigned halo_;
  RegionExchange& exchange_;
  Regions others_;  // all but this one
  std::vector<ByteWriter> out_;
  std::vector<std::vector<char>> in_;

  // Of each cell.
  std::vector<std::uint8_t> owner_;
  std::vector<Regions> holders_;
  std::vector<std::uint8_t> inner_;  // this region alone holds what is in it

  std::vector<std::uint32_t> held_blocks_;
  bool is_shared_out_ = false;
  double way_ = 0;  // metres: nobody has gone further since the bodies were shared out
  // Of each body that is held.
  std::vector<std::uint32_t> numbers_;  // in the whole world, ascending
  std::vector<std::uint8_t> is_own_, is_told_;
  std::vector<std::uint8_t> is_everywhere_;  // all regions hold it
  std::vector<std::uint32_t> cells_;
  std::vector<std::vector<std::uint32_t>> common_;  // bodies that this region and another one hold, ascending
  std::vector<std::uint32_t> border_;               // those of all the others
  std::vector<std::uint32_t> own_;                  // room for FindOwn

  std::vector<Grip> grips_;             // of all regions, by numbers in the whole world
  std::vector<std::uint32_t> grouped_;  // bodies in groups, as numbers in the whole world, ascending

  std::vector<ArrivedBody> arrived_;
  std::vector<std::uint32_t> places_;          // of those that arrived
  std::vector<std::uint32_t> gone_;            // bodies that are not held any more, unless they arrive again
  std::vector<std::uint32_t> removed_;         // those of them that do not
  std::vector<std::uint32_t> stayed_, added_;  // among the arrived: those that were here before, and the others
  std::vector<Run> runs_;
  std::uint32_t new_count_ = 0;

  KinematicWorld* solved_ = nullptr;
  bool overlaps_anywhere_ = false;
  std::vector<Order> order_of_large_;  // of each pair of the world's pairs_of_large_
  std::vector<SharedContact> shared_contacts_;
  // Of each leader in a shared contact, by number in the whole world; one more for static shapes.
  std::vector<std::uint32_t> shared_numbers_;
  std::vector<std::uint32_t> shared_bodies_;  // kNobody if it is not held
  std::vector<double> shared_x_, shared_y_, shared_mobility_;
  std::vector<Stamp> shared_pushes_;
  std::vector<Pushed> pushed_;

  LimitList limits_of_others_;
  std::map<std::uint32_t, std::uint32_t> limited_elsewhere_;  // by number in the whole world
};

}  // namespace swarmanoid::kinematics2d
