#include "engine_worker/engines/kinematics2d/contact_solver.h"

#include <algorithm>
#include <cmath>

namespace swarmanoid::kinematics2d
{
namespace
{

constexpr int kMostSweeps = 16;

}  // namespace

void ContactSolver::Configure(std::size_t bodies)
{
  contacts_.reserve(bodies + 64);
  touched_.reserve(bodies + 1);
  is_touched_.assign(bodies + 1, 0);
}

void ContactSolver::Clear()
{
  contacts_.clear();
  for (const TouchedLeader& touched : touched_) is_touched_[touched.leader] = 0;
  touched_.clear();
}

void ContactSolver::Note(std::uint32_t leader, const std::vector<double>& x, const std::vector<double>& y)
{
  if (is_touched_[leader] != 0) return;
  is_touched_[leader] = 1;
  touched_.push_back({leader, x[leader], y[leader]});
}

void ContactSolver::Add(const Contact& contact, const std::vector<double>& x, const std::vector<double>& y)
{
  contacts_.push_back(contact);
  Note(contact.first, x, y);
  Note(contact.second, x, y);
}

double ContactSolver::Sweep(const std::vector<double>& mobility, bool bounce, std::vector<double>& x,
                            std::vector<double>& y)
{
  double deepest = 0;
  for (const Contact& contact : contacts_)
  {
    const std::uint32_t i = contact.first;
    const std::uint32_t j = contact.second;
    const double dx = x[i] - x[j];
    const double dy = y[i] - y[j];
    double nx = contact.touch.x;
    double ny = contact.touch.y;
    double depth;
    if (contact.touch.face)
    {
      depth = contact.touch.reach - (dx * nx + dy * ny);
      if (depth <= 0) continue;
    }
    else
    {
      const double px = dx + nx;
      const double py = dy + ny;
      const double squared = px * px + py * py;
      if (squared >= contact.touch.reach * contact.touch.reach) continue;
      const double length = std::sqrt(squared);
      depth = contact.touch.reach - length;
      // Two centres at one place: any direction will do.
      nx = length > 0 ? px / length : 1;
      ny = length > 0 ? py / length : 0;
    }
    const double total = mobility[i] + mobility[j];
    if (total <= 0) continue;
    deepest = std::max(deepest, depth);
    const double push = (bounce ? depth + contact.bounce : depth) / total;
    x[i] += nx * (push * mobility[i]);
    y[i] += ny * (push * mobility[i]);
    x[j] -= nx * (push * mobility[j]);
    y[j] -= ny * (push * mobility[j]);
  }
  return deepest;
}

void ContactSolver::Solve(const std::vector<double>& mobility, double tolerance, double reach, std::vector<double>& x,
                          std::vector<double>& y)
{
  if (Sweep(mobility, true, x, y) > 0)
    for (int sweep = 1; sweep < kMostSweeps; ++sweep)
      if (Sweep(mobility, false, x, y) <= tolerance) break;

  for (const TouchedLeader& touched : touched_)
  {
    const double dx = x[touched.leader] - touched.x;
    const double dy = y[touched.leader] - touched.y;
    const double squared = dx * dx + dy * dy;
    if (squared <= reach * reach) continue;
    const double scale = reach / std::sqrt(squared);
    x[touched.leader] = touched.x + dx * scale;
    y[touched.leader] = touched.y + dy * scale;
  }
}

}  // namespace swarmanoid::kinematics2d
