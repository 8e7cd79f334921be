// The exchanges between regions of a cut plane while contacts are solved and motions limited.
#pragma once

#include <compare>
#include <initializer_list>
#include <map>
#include <vector>

#include "engine_worker/engines/kinematics2d/region_bodies.h"

namespace swarmanoid::kinematics2d
{

// The methods are called in this order in each substep, but ShareMaxima once in a tick.
class RegionBorder final : public ContactSolver::Border
{
public:
  using Stamp = ContactSolver::Stamp;

  RegionBorder(PlaneState& plane, RegionBodies& bodies) : plane_(plane), bodies_(bodies), mail_(bodies.Mail()) {}

  // Each number becomes the largest one of all regions.
  void ShareMaxima(std::initializer_list<double*> numbers);
  // Keeps only the pairs of large bodies that this region computes, each as a part of its own.
  void ChoosePairsOfLarge();
  // Replaces this region's contacts of groups and large bodies by those of all regions.
  void ShareContacts();
  bool OverlapsAnywhere() const { return overlaps_anywhere_; }
  bool AfterColour(Stamp begin, bool moved) override;
  ContactSolver::Leaders TakeShared(double most) override;
  void PutShared(Stamp begin) override;
  // Shares the bodies that came to be involved since the last call in this substep. Returns whether there are any in
  // any region, or `more` is true in any region.
  bool ShareInvolved(bool more);
  // Returns the limits of the other regions. A body that this region does not hold has a number behind its own.
  const LimitList& ShareLimits();

private:
  // A push of a body, which is numbered in the list of common bodies, or among the shared leaders.
  struct Pushed
  {
    std::uint32_t index;
    std::uint32_t stamp;
    double x, y;
  };
  // A leader in a shared contact, where its motion ended and where the substep began.
  struct SharedLeader
  {
    std::uint32_t number;
    std::uint32_t padding;
    double x, y, before_x, before_y, mobility;
  };
  // The order of shared contacts: those of groups by blocks; then those of large bodies, by large body, then by the
  // cell of the other one, then by the other one.
  struct Order
  {
    std::uint32_t large;  // 0, or 1 + its number in the whole plane
    std::uint32_t cell;   // or the block; behind all cells are large bodies, then static shapes
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

  SharedLeader LeaderAt(std::uint32_t leader) const;
  void AddOwnContacts();
  void NumberLeaders();
  std::uint32_t IndexOfShared(std::uint32_t number) const;
  void ListPushed(std::span<const std::uint32_t> bodies, Stamp begin, std::vector<Pushed>& pushed);
  std::uint32_t LimitedBody(std::uint32_t number);

  PlaneState& plane_;
  RegionBodies& bodies_;
  RegionMail& mail_;

  bool overlaps_anywhere_ = false;
  std::vector<Order> order_of_large_;  // of each pair of Contacts::PairsOfLarge
  std::vector<SharedContact> shared_contacts_;
  // Values of each leader in a shared contact, by number in the whole plane. Static shapes have one more entry.
  std::vector<std::uint32_t> shared_numbers_;
  std::vector<std::uint32_t> shared_bodies_;  // kNobody if the region does not hold it
  std::vector<double> shared_x_, shared_y_, shared_before_x_, shared_before_y_, shared_mobility_;
  std::vector<Stamp> shared_pushes_;
  std::vector<Pushed> pushed_, shared_pushed_;

  std::vector<std::uint8_t> is_sent_;  // by body: the other regions know that it is involved
  LimitList limits_of_others_;
  std::map<std::uint32_t, std::uint32_t> limited_elsewhere_;  // by number in the whole plane
};

// The part of a region in the steps of its plane.
struct Region
{
  Region(PlaneState& plane, std::vector<std::uint32_t> followers, unsigned number, RegionExchange& exchange,
         unsigned halo)
      : bodies(plane, std::move(followers), number, exchange, halo), border(plane, bodies)
  {
  }

  RegionBodies bodies;
  RegionBorder border;
};

}  // namespace swarmanoid::kinematics2d
