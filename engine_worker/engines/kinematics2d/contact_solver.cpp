#include "engine_worker/engines/kinematics2d/contact_solver.h"

#include <cmath>

namespace swarmanoid::kinematics2d
{
namespace
{

constexpr std::uint8_t kMostSweeps = 16;
// A push can wake contacts that were at rest; they are looked for once in so many sweeps.
constexpr std::uint8_t kSweepsPerSearch = 4;

}  // namespace

void ContactSolver::Configure(std::size_t bodies)
{
  contacts_.reserve(4 * bodies + 64);
  active_.reserve(4 * bodies + 64);
  pushed_.reserve(bodies + 1);
  last_push_.assign(bodies + 1, 0);
}

void ContactSolver::Clear()
{
  contacts_.clear();
  active_.clear();
  for (const PushedLeader& pushed : pushed_) last_push_[pushed.leader] = 0;
  pushed_.clear();
}

void ContactSolver::NotePush(std::uint32_t leader, std::uint8_t sweep, double x, double y)
{
  if (last_push_[leader] == 0) pushed_.push_back({leader, x, y});
  last_push_[leader] = sweep;
}

void ContactSolver::Sweep(std::uint8_t sweep, double tolerance, const std::vector<double>& mobility,
                          std::vector<double>& x, std::vector<double>& y)
{
  const double limit = sweep == 1 ? 0 : tolerance;
  std::size_t kept = 0;
  for (const std::uint32_t index : active_)
  {
    const Contact& contact = contacts_[index];
    const std::uint32_t i = contact.first;
    const std::uint32_t j = contact.second;
    const double dx = x[i] - x[j];
    const double dy = y[i] - y[j];
    double nx = contact.touch.x;
    double ny = contact.touch.y;
    double depth;
    bool deep;
    if (contact.touch.face)
    {
      depth = contact.touch.reach - (dx * nx + dy * ny);
      deep = depth > limit;
    }
    else
    {
      nx += dx;
      ny += dy;
      const double squared = nx * nx + ny * ny;
      const double near = contact.touch.reach - limit;
      deep = squared < near * near;
      if (deep)
      {
        const double length = std::sqrt(squared);
        depth = contact.touch.reach - length;
        // Two centres at one place: any direction will do.
        nx = length > 0 ? nx / length : 1;
        ny = length > 0 ? ny / length : 0;
      }
    }
    if (deep)
    {
      const double push = (sweep == 1 ? depth + contact.bounce : depth) / (mobility[i] + mobility[j]);
      if (mobility[i] > 0)
      {
        NotePush(i, sweep, x[i], y[i]);
        x[i] += nx * (push * mobility[i]);
        y[i] += ny * (push * mobility[i]);
      }
      if (mobility[j] > 0)
      {
        NotePush(j, sweep, x[j], y[j]);
        x[j] -= nx * (push * mobility[j]);
        y[j] -= ny * (push * mobility[j]);
      }
    }
    active_[kept] = index;
    kept += last_push_[i] >= sweep - 1 || last_push_[j] >= sweep - 1 ? 1 : 0;
  }
  active_.resize(kept);
}

// All contacts of leaders that were pushed in sweep `since` or later.
void ContactSolver::ActivateNeighbours(std::uint8_t since)
{
  active_.clear();
  for (std::uint32_t index = 0; index < contacts_.size(); ++index)
    if (last_push_[contacts_[index].first] >= since || last_push_[contacts_[index].second] >= since)
      active_.push_back(index);
}

void ContactSolver::Solve(const std::vector<double>& mobility, double tolerance, double reach, std::vector<double>& x,
                          std::vector<double>& y)
{
  Sweep(1, tolerance, mobility, x, y);
  for (std::uint8_t sweep = 2; sweep <= kMostSweeps; ++sweep)
  {
    if ((sweep - 2) % kSweepsPerSearch == 0)
    {
      ActivateNeighbours(sweep == 2 ? 1 : static_cast<std::uint8_t>(sweep - kSweepsPerSearch));
      if (active_.empty()) break;
    }
    Sweep(sweep, tolerance, mobility, x, y);
  }

  for (const PushedLeader& pushed : pushed_)
  {
    const double dx = x[pushed.leader] - pushed.x;
    const double dy = y[pushed.leader] - pushed.y;
    const double squared = dx * dx + dy * dy;
    if (squared <= reach * reach) continue;
    const double scale = reach / std::sqrt(squared);
    x[pushed.leader] = pushed.x + dx * scale;
    y[pushed.leader] = pushed.y + dy * scale;
  }
}

}  // namespace swarmanoid::kinematics2d
