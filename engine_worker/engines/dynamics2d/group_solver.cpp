// Problem: bodies strive for a velocity against the ground with limited force, while contacts and grips hold them. A
// load that is too heavy must stand still, and a free robot must reach its speed, at a few hundred nanoseconds a body.
//
// The law of the ground. In a step of h seconds, the ground gives a body of mass m at most the impulse h F, and turns
// it by at most h T: wheels by their friction or motors, propellers by their force, and what lies on the ground by
// Coulomb's friction. It strives for the wanted velocity w, which is 0 for what lies. Without other forces this has a
// closed form:
//
//   v' = v + (w - v) min(1, h F / (m |w - v|))
//
// because the shortest way to w is straight, so that the impulse m (w - v) is cut to the disc of radius h F (the cone
// of Coulomb). The same holds for the turn, with T and the moment of inertia. Bodies that nothing else holds in a step
// get this impulse, and no iteration.
//
// If contacts or grips hold a body, the same cut is a row of the solver. It cannot come before the contacts: a robot
// that pushes a load would get h F / M of speed, the contact would give a part to the load, and the friction of the
// load would see it only in the next step. The load would creep with h F / m, however heavy it is.
//
// Method: sequential impulses with the sums of all impulses kept (E. Catto, Iterative dynamics with temporal coherence,
// 2005), as in Box2D: grips, ground and contacts in turn, then positions, then overlaps (nonlinear Gauss-Seidel). Sums
// begin with those of the last step. The iterations end early if none changes a velocity by 0.1 µm/s. Contacts begin
// before bodies meet: along the normal of a gap g they may approach with g / h, so that they do not overlap. If they
// would meet in this step and bounce, they bounce now. Pairs that can meet within the tick are found once.
//
// Friction under a face opposes the slip at each of its points, so that sliding and turning share one limit: nearly an
// ellipsoid (Howe and Cutkosky, "Practical force-motion models for sliding manipulation", 1996). A body that slides
// gives way to the smallest push across, and to the smallest torque.
//
// Invariants: all rows come in the order of the bodies. Forces that are kept do not depend on the length of the step.
#include "engine_worker/engines/dynamics2d/group_solver.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/math/elementary.h"

namespace swarmanoid::dynamics2d
{
namespace
{

// The tolerances of Box2D for bodies of a decimetre.
constexpr double kSlop = 5e-4;          // m: overlaps that stay
constexpr double kBounceSpeed = 0.1;    // m/s: slower bodies do not bounce
constexpr double kCorrected = 0.2;      // part of an overlap that an iteration removes
constexpr double kLargestPush = 0.02;   // m, that an iteration removes at most
constexpr double kStill = 1e-7;         // m/s: a change of velocity that no iteration need follow
constexpr double kHoldGain = 0.2;       // part of the error of a held turret that is corrected in a step
constexpr double kHoldSpeed = 1.0;      // rad/s, at most
constexpr double kOverload = 0.999;     // of the motor's torque: the turret slips
constexpr std::size_t kFewBodies = 24;  // all pairs of so many are compared

void SetAngle(Mover& mover, double angle)
{
  mover.angle = angle;
  const SinCos heading = SinCosOf(angle);
  mover.place.cos = heading.cos;
  mover.place.sin = heading.sin;
}

// Turns the square of a gripper to the turret.
void TurnGripper(Mover& mover)
{
  constexpr double kBack = kGripperReach - kGripperSide;
  constexpr double kHalf = kGripperSide / 2;
  const double c = mover.turret_cos;
  const double s = mover.turret_sin;
  const auto corner = [&](double forward, double left, double normal_forward, double normal_left) -> Corner
  {
    return {c * forward - s * left, s * forward + c * left, c * normal_forward - s * normal_left,
            s * normal_forward + c * normal_left};
  };
  mover.square = {corner(kGripperReach, -kHalf, 1, 0), corner(kGripperReach, kHalf, 0, 1), corner(kBack, kHalf, -1, 0),
                  corner(kBack, -kHalf, 0, -1)};
  mover.parts[1].x = c * kGripperMiddle;
  mover.parts[1].y = s * kGripperMiddle;
}

void TurnTurret(Mover& mover, double angle)
{
  const SinCos turret = angle == 0 ? SinCos{0, 1} : SinCosOf(angle);
  mover.turret_cos = turret.cos;
  mover.turret_sin = turret.sin;
  if (mover.parts[1].count > 0) TurnGripper(mover);
}

class Solver
{
public:
  Solver(std::span<Body> bodies, GroupRun& run, const SolverSettings& settings, double seconds, int steps)
      : bodies_(bodies), run_(run), settings_(settings), seconds_(seconds), steps_(steps)
  {
  }

  void Run()
  {
    Gather();
    FindCandidates();
    for (; run_.steps_done < steps_; ++run_.steps_done)
    {
      if (run_.goes_too_far && run_.is_bounded) break;
      if (!run_.is_bounded && run_.steps_done > 0)
      {
        KeepContacts();
        FindCandidates();
      }
      Step();
      for (std::size_t i = 0; i < run_.bodies.size(); ++i)
        run_.goes_too_far = run_.goes_too_far || IsTooFar(run_.movers[i], run_.ways[i]);
    }
    Scatter();
    KeepContacts();
  }

private:
  Body& BodyOf(const Mover& mover) { return bodies_[mover.body]; }

  Mover MoverOf(std::uint32_t number) const
  {
    const Body& body = bodies_[number];
    const BodyModel& model = body.model;
    Mover mover{};
    mover.body = number;
    mover.vx = body.state.vx;
    mover.vy = body.state.vy;
    mover.turn = body.state.turn;
    mover.place.x = body.state.x;
    mover.place.y = body.state.y;
    mover.moves = model.motion == EMotion::kDynamic && body.solid;
    if (mover.moves)
    {
      mover.mass = model.mass;
      mover.inertia = model.inertia;
      mover.inverse_mass = 1 / model.mass;
      mover.inverse_inertia = 1 / model.inertia;
      mover.chord = ChordOf(body.drive.turn * seconds_);
    }
    mover.parts[0] = {body.corners.data(),
                      static_cast<int>(body.corners.size()),
                      model.radius > 0 ? model.radius : kPolygonSkin,
                      model.radius > 0 ? model.radius : body.radius,
                      0,
                      0};
    mover.angle = body.state.angle;
    mover.place.cos = body.heading.cos;
    mover.place.sin = body.heading.sin;
    return mover;
  }

  // Copies the bodies that move, and then the static ones, into movers.
  void Gather()
  {
    run_.movers.clear();
    run_.movers.reserve(run_.bodies.size() + run_.fixed.size());  // squares are pointed to
    run_.grips.clear();
    for (const std::uint32_t number : run_.bodies)
    {
      const Body& body = bodies_[number];
      Mover& mover = run_.movers.emplace_back(MoverOf(number));
      if (body.model.has_gripper && !body.model.grips_by_rod)
        mover.parts[1] = {mover.square.data(), 4, kPolygonSkin, kGripperRadius + kPolygonSkin, 0, 0};
      if (body.model.has_gripper || body.gripped != kNoBody) TurnTurret(mover, body.turret_angle);
    }
    for (const std::uint32_t number : run_.fixed) run_.movers.push_back(MoverOf(number));
    for (std::uint32_t i = 0; i < run_.bodies.size(); ++i)
    {
      const Body& body = bodies_[run_.bodies[i]];
      if (body.gripped == kNoBody || !run_.movers[i].moves) continue;
      GripRow& grip = run_.grips.emplace_back();
      grip = {};
      grip.holder = i;
      grip.held = static_cast<std::uint32_t>(
          std::ranges::lower_bound(run_.bodies, static_cast<std::uint32_t>(body.gripped)) - run_.bodies.begin());
      if (body.model.has_turret_motor) TurnTurret(run_.movers[i], AngleOfGrip(body, bodies_[run_.bodies[grip.held]]));
    }
  }

  void Scatter()
  {
    for (std::size_t i = 0; i < run_.bodies.size(); ++i)
    {
      const Mover& mover = run_.movers[i];
      Body& body = BodyOf(mover);
      if (!body.solid) continue;
      body.state = {mover.place.x, mover.place.y, mover.angle, mover.vx, mover.vy, mover.turn};
    }
  }

  // The pairs of bodies that can meet before the groups are found again, in their order.
  void FindPairs()
  {
    const auto bodies = static_cast<std::uint32_t>(run_.bodies.size());
    const auto count = static_cast<std::uint32_t>(run_.movers.size());
    const auto reach_of = [&](std::uint32_t i)
    {
      const Body& body = BodyOf(run_.movers[i]);
      if (i >= bodies) return body.radius;
      if (run_.is_bounded) return body.radius + run_.ways[i].most;
      return body.radius + WayOf(run_.movers[i], body, seconds_) + kLargestPush;
    };
    const auto x_of = [&](std::uint32_t i)
    { return i < bodies && run_.is_bounded ? run_.ways[i].x : run_.movers[i].place.x; };
    const auto y_of = [&](std::uint32_t i)
    { return i < bodies && run_.is_bounded ? run_.ways[i].y : run_.movers[i].place.y; };
    const auto can_meet = [&](std::uint32_t a, std::uint32_t b)
    {
      if (!run_.movers[a].moves && !run_.movers[b].moves) return false;
      const double dx = x_of(b) - x_of(a);
      const double dy = y_of(b) - y_of(a);
      const double reach = reach_of(a) + reach_of(b) + 2 * kPolygonSkin;
      if (dx * dx + dy * dy >= reach * reach) return false;
      // Long walls are near many bodies that do not meet them.
      return b < bodies || !IsBeyondEdge(run_.movers[b].parts[0], run_.movers[b].place, x_of(a), y_of(a),
                                         reach_of(a) + 2 * kPolygonSkin);
    };
    run_.pairs.clear();
    if (count <= kFewBodies)
    {
      for (std::uint32_t a = 0; a < bodies; ++a)
        for (std::uint32_t b = a + 1; b < count; ++b)
          if (can_meet(a, b)) run_.pairs.push_back({a, b});
      return;
    }
    run_.by_x.resize(count);
    std::iota(run_.by_x.begin(), run_.by_x.end(), 0U);
    const auto begin_of = [&](std::uint32_t i) { return x_of(i) - reach_of(i); };
    std::ranges::sort(run_.by_x,
                      [&](std::uint32_t a, std::uint32_t b)
                      {
                        const double begin_a = begin_of(a);
                        const double begin_b = begin_of(b);
                        return begin_a < begin_b || (begin_a == begin_b && a < b);
                      });
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::uint32_t a = run_.by_x[i];
      const double end = x_of(a) + reach_of(a) + 2 * kPolygonSkin;
      for (std::size_t k = i + 1; k < count && begin_of(run_.by_x[k]) < end; ++k)
      {
        const std::uint32_t b = run_.by_x[k];
        const std::uint32_t first = std::min(a, b);
        if (first < bodies && can_meet(first, std::max(a, b))) run_.pairs.push_back({first, std::max(a, b)});
      }
    }
    std::ranges::sort(run_.pairs);
  }

  bool AreJoined(const Mover& a, const Mover& b)
  {
    const auto holds = [&](const Mover& holder, const Mover& held)
    {
      const Body& body = BodyOf(holder);
      const bool is_rod = body.model.grips_by_rod && !body.model.has_turret_motor;
      return body.gripped == static_cast<int>(held.body) && !is_rod;
    };
    return holds(a, b) || holds(b, a);
  }

  // Lists the parts that can meet, with the forces of the contacts that were before.
  void FindCandidates()
  {
    FindPairs();
    run_.candidates.clear();
    std::size_t first = 0;
    for (const auto& [a, b] : run_.pairs)
    {
      const Mover& one = run_.movers[a];
      const Mover& other = run_.movers[b];
      const Body& body = BodyOf(one);
      const Body& other_body = BodyOf(other);
      if (!body.solid || !other_body.solid || AreJoined(one, other)) continue;
      while (first < run_.contacts.size() && run_.contacts[first].a < one.body) ++first;
      Candidate candidate{};
      candidate.a = a;
      candidate.b = b;
      candidate.friction = std::sqrt(body.model.friction * other_body.model.friction);
      candidate.restitution = std::max(body.model.restitution, other_body.model.restitution);
      for (std::uint8_t part_a = 0; part_a < 2; ++part_a)
        for (std::uint8_t part_b = 0; part_b < 2; ++part_b)
        {
          if (one.parts[part_a].radius <= 0 || other.parts[part_b].radius <= 0) continue;
          candidate.part_a = part_a;
          candidate.part_b = part_b;
          candidate.forces = {};
          for (std::size_t k = first; k < run_.contacts.size() && run_.contacts[k].a == one.body; ++k)
          {
            const Contact& contact = run_.contacts[k];
            if (contact.b != other.body || contact.part_a != part_a || contact.part_b != part_b) continue;
            candidate.forces = contact.forces;
          }
          run_.candidates.push_back(candidate);
        }
    }
  }

  void KeepContacts()
  {
    run_.contacts.clear();
    for (const Candidate& candidate : run_.candidates)
      if (candidate.forces.points > 0)
        run_.contacts.push_back({run_.movers[candidate.a].body, run_.movers[candidate.b].body, candidate.part_a,
                                 candidate.part_b, static_cast<std::uint8_t>(candidate.touches ? 1 : 0),
                                 candidate.forces});
  }

  // How far a body can get by itself.
  static double WayOf(const Mover& mover, const Body& body, double seconds)
  {
    double speed = Length(mover.vx, mover.vy);
    double turn = std::abs(mover.turn);
    if (mover.moves)
    {
      speed = std::max(speed, Length(body.drive.forward, body.drive.left));
      turn = std::max(turn, std::abs(body.drive.turn)) + std::abs(body.turret_speed);
    }
    const double arm = body.corners.empty() ? body.arm : body.radius;
    return seconds * (speed + turn * arm);
  }

  bool IsTooFar(const Mover& mover, const Way& way)
  {
    if (!mover.moves) return false;
    const double arm = BodyOf(mover).arm;
    const double gone = Length(mover.place.x - way.x, mover.place.y - way.y) + arm * std::abs(mover.angle - way.angle);
    return gone + seconds_ * (Length(mover.vx, mover.vy) + arm * std::abs(mover.turn)) > way.most;
  }

  void Step()
  {
    for (std::size_t i = 0; i < run_.bodies.size(); ++i) Prepare(run_.movers[i]);
    MakeGripRows();
    MakeContactRows();
    if (run_.rows.empty() && run_.grips.empty())
    {
      for (std::size_t i = 0; i < run_.bodies.size(); ++i) SolveGround(run_.movers[i]);
    }
    else
    {
      SolveVelocities();
    }
    KeepForces();
    for (std::size_t i = 0; i < run_.bodies.size(); ++i) Move(run_.movers[i]);
    if (!run_.rows.empty() || !run_.grips.empty()) SolvePositions();
    for (std::size_t i = 0; i < run_.bodies.size(); ++i) MeasureWheels(run_.movers[i]);
    if (settings_.measures_loads != 0)
      for (const GripRow& grip : run_.grips) MeasureLoad(grip);
  }

  // The wanted velocity, the limits of the ground and the turret of a body.
  void Prepare(Mover& mover)
  {
    Body& body = BodyOf(mover);
    mover.is_bound = false;
    mover.before = mover.place;
    mover.angle_before = mover.angle;
    mover.ground_x = mover.ground_y = mover.ground_turn = 0;
    mover.way = WayOf(mover, body, seconds_);
    if (!mover.moves) return;
    mover.wanted = {0, 0, body.drive.turn};
    if (body.drive.forward != 0 || body.drive.left != 0)
    {
      const ChordOfStep& chord = mover.chord;
      const double c = chord.shortening * (mover.place.cos * chord.cos - mover.place.sin * chord.sin);
      const double s = chord.shortening * (mover.place.sin * chord.cos + mover.place.cos * chord.sin);
      mover.wanted.u = c * body.drive.forward - s * body.drive.left;
      mover.wanted.v = s * body.drive.forward + c * body.drive.left;
    }
    FrictionShares shares{1, 1};
    if (body.model.lies && body.model.ground_force > 0) shares = SharesOf(body.model, mover.vx, mover.vy, mover.turn);
    mover.most_force = seconds_ * shares.sliding * body.model.ground_force;
    mover.most_turn = seconds_ * shares.turning * body.model.ground_torque;
    if (body.gripped != kNoBody || body.turret_speed == 0 || !body.model.has_gripper) return;
    body.turret_angle = WrapAngle(body.turret_angle + body.turret_speed * seconds_);
    TurnTurret(mover, body.turret_angle);
  }

  void MakeGripRows()
  {
    for (GripRow& grip : run_.grips)
    {
      Mover& holder = run_.movers[grip.holder];
      Mover& held = run_.movers[grip.held];
      Body& body = BodyOf(holder);
      holder.is_bound = held.is_bound = true;
      grip.anchor_x = held.place.cos * body.grip.anchor_x - held.place.sin * body.grip.anchor_y;
      grip.anchor_y = held.place.sin * body.grip.anchor_x + held.place.cos * body.grip.anchor_y;
      grip.impulse_x = body.grip_forces.x * seconds_;
      grip.impulse_y = body.grip_forces.y * seconds_;
      grip.impulse_turn = body.grip_forces.torque * seconds_;
      grip.turn_mass = 1 / (holder.inverse_inertia + held.inverse_inertia);
      if (IsRod(body))
        AlignRod(grip, holder, held);
      else if (body.model.has_turret_motor)
        grip.motor_speed = MotorSpeed(body, holder, held);
    }
  }

  static bool IsRod(const Body& body) { return body.model.grips_by_rod && !body.model.has_turret_motor; }

  // A turret follows its command, or holds its angle. It gives way beyond the torque of the motor.
  double MotorSpeed(Body& body, Mover& holder, const Mover& held)
  {
    const double angle = held.angle - holder.angle - body.grip.reference_angle;
    TurnTurret(holder, angle);
    if (body.turret_speed != 0)
    {
      body.held_angle.reset();
      return body.turret_speed;
    }
    const bool slips = std::abs(body.grip_forces.torque) >= kOverload * settings_.turret_torque;
    if (!body.held_angle || slips) body.held_angle = angle;
    const double speed = kHoldGain * WrapAngle(*body.held_angle - angle) / seconds_;
    return std::clamp(speed, -kHoldSpeed, kHoldSpeed);
  }

  // The axis of a rod points from the holder to the end on the held body.
  static double AlignRod(GripRow& grip, const Mover& holder, const Mover& held)
  {
    const double x = held.place.x + grip.anchor_x - holder.place.x;
    const double y = held.place.y + grip.anchor_y - holder.place.y;
    const double length = Length(x, y);
    grip.axis_x = length > kSlop ? x / length : 0;
    grip.axis_y = length > kSlop ? y / length : 0;
    const double lever = grip.anchor_x * grip.axis_y - grip.anchor_y * grip.axis_x;
    grip.mass = 1 / (holder.inverse_mass + held.inverse_mass + held.inverse_inertia * lever * lever);
    return length;
  }

  // Pushes the held body at its anchor, and the holder the other way at its middle.
  static void Push(const GripRow& grip, Mover& holder, Mover& held, double x, double y, double turn)
  {
    holder.vx -= holder.inverse_mass * x;
    holder.vy -= holder.inverse_mass * y;
    holder.turn -= holder.inverse_inertia * turn;
    held.vx += held.inverse_mass * x;
    held.vy += held.inverse_mass * y;
    held.turn += held.inverse_inertia * (turn + grip.anchor_x * y - grip.anchor_y * x);
  }

  // The impulse at the anchor that changes the velocity there by (x, y), and for a rigid grip also the turn.
  struct Impulse
  {
    double x, y, turn;
  };
  static Impulse ImpulseFor(const GripRow& grip, const Mover& holder, const Mover& held, double x, double y)
  {
    const double mass = holder.inverse_mass + held.inverse_mass;
    const double inertia = held.inverse_inertia;
    const double xx = mass + grip.anchor_y * grip.anchor_y * inertia;
    const double xy = -grip.anchor_y * grip.anchor_x * inertia;
    const double yy = mass + grip.anchor_x * grip.anchor_x * inertia;
    const double determinant = xx * yy - xy * xy;
    return {(yy * x - xy * y) / determinant, (xx * y - xy * x) / determinant, 0};
  }
  static Impulse RigidImpulseFor(const GripRow& grip, const Mover& holder, const Mover& held, double x, double y,
                                 double turn)
  {
    const double mass = holder.inverse_mass + held.inverse_mass;
    const double inertia = held.inverse_inertia;
    // The matrix is [xx xy xt; xy yy yt; xt yt tt]. First the turn is eliminated.
    const double xx = mass + grip.anchor_y * grip.anchor_y * inertia;
    const double xy = -grip.anchor_y * grip.anchor_x * inertia;
    const double yy = mass + grip.anchor_x * grip.anchor_x * inertia;
    const double xt = -grip.anchor_y * inertia;
    const double yt = grip.anchor_x * inertia;
    const double tt = holder.inverse_inertia + inertia;
    const double a = xx - xt * xt / tt;
    const double b = xy - xt * yt / tt;
    const double c = yy - yt * yt / tt;
    const double right_x = x - xt * turn / tt;
    const double right_y = y - yt * turn / tt;
    const double determinant = a * c - b * b;
    const double impulse_x = (c * right_x - b * right_y) / determinant;
    const double impulse_y = (a * right_y - b * right_x) / determinant;
    return {impulse_x, impulse_y, (turn - xt * impulse_x - yt * impulse_y) / tt};
  }

  double SolveGrip(GripRow& grip)
  {
    Mover& holder = run_.movers[grip.holder];
    Mover& held = run_.movers[grip.held];
    const Body& body = BodyOf(holder);
    const auto slip_x = [&] { return held.vx - held.turn * grip.anchor_y - holder.vx; };
    const auto slip_y = [&] { return held.vy + held.turn * grip.anchor_x - holder.vy; };
    if (IsRod(body))
    {
      const double impulse = -grip.mass * (grip.axis_x * slip_x() + grip.axis_y * slip_y());
      grip.impulse_x += impulse;
      Push(grip, holder, held, impulse * grip.axis_x, impulse * grip.axis_y, 0);
      return std::abs(impulse) / grip.mass;
    }
    double change = 0;
    Impulse impulse{};
    if (body.model.has_turret_motor)
    {
      const double most = seconds_ * settings_.turret_torque;
      const double wanted = -grip.turn_mass * (held.turn - holder.turn - grip.motor_speed);
      const double turn = std::clamp(grip.impulse_turn + wanted, -most, most) - grip.impulse_turn;
      grip.impulse_turn += turn;
      Push(grip, holder, held, 0, 0, turn);
      change = std::abs(turn) / grip.turn_mass;
      impulse = ImpulseFor(grip, holder, held, -slip_x(), -slip_y());
    }
    else
    {
      impulse = RigidImpulseFor(grip, holder, held, -slip_x(), -slip_y(), holder.turn - held.turn);
      grip.impulse_turn += impulse.turn;
    }
    grip.impulse_x += impulse.x;
    grip.impulse_y += impulse.y;
    Push(grip, holder, held, impulse.x, impulse.y, impulse.turn);
    const double mass = holder.inverse_mass + held.inverse_mass;
    return std::max({change, mass * std::abs(impulse.x), mass * std::abs(impulse.y),
                     held.inverse_inertia * std::abs(impulse.turn)});
  }

  // The law at the head of this file. Returns the change of velocity.
  static double SolveGround(Mover& mover)
  {
    if (!mover.moves) return 0;
    double x = mover.ground_x + mover.mass * (mover.wanted.u - mover.vx);
    double y = mover.ground_y + mover.mass * (mover.wanted.v - mover.vy);
    const double size = x * x + y * y;
    if (size > mover.most_force * mover.most_force)
    {
      const double part = mover.most_force / std::sqrt(size);
      x *= part;
      y *= part;
    }
    const double turn = std::clamp(mover.ground_turn + mover.inertia * (mover.wanted.turn - mover.turn),
                                   -mover.most_turn, mover.most_turn);
    const double change_x = mover.inverse_mass * (x - mover.ground_x);
    const double change_y = mover.inverse_mass * (y - mover.ground_y);
    const double change_turn = mover.inverse_inertia * (turn - mover.ground_turn);
    mover.ground_x = x;
    mover.ground_y = y;
    mover.ground_turn = turn;
    mover.vx += change_x;
    mover.vy += change_y;
    mover.turn += change_turn;
    return std::max({std::abs(change_x), std::abs(change_y), std::abs(change_turn)});
  }

  void MakeContactRows()
  {
    run_.rows.clear();
    for (Candidate& candidate : run_.candidates)
    {
      Mover& a = run_.movers[candidate.a];
      Mover& b = run_.movers[candidate.b];
      const PartShape& part_a = a.parts[candidate.part_a];
      const PartShape& part_b = b.parts[candidate.part_b];
      const ContactForces before = candidate.forces;
      candidate.forces.points = 0;
      candidate.touches = false;
      const double margin = a.way + b.way;
      const double dx = b.place.x + b.place.cos * part_b.x - b.place.sin * part_b.y -
                        (a.place.x + a.place.cos * part_a.x - a.place.sin * part_a.y);
      const double dy = b.place.y + b.place.sin * part_b.x + b.place.cos * part_b.y -
                        (a.place.y + a.place.sin * part_a.x + a.place.cos * part_a.y);
      const double reach = part_a.reach + part_b.reach + margin;
      if (dx * dx + dy * dy > reach * reach) continue;
      const Manifold manifold = Collide(part_a, a.place, part_b, b.place, margin);
      if (manifold.points == 0) continue;
      ContactRow& row = run_.rows.emplace_back();
      row.candidate = &candidate;
      row.manifold = manifold;
      candidate.forces.points = manifold.points;
      candidate.forces.features = manifold.features;
      for (int i = 0; i < manifold.points; ++i) MakePoint(row, i, before, a, b);
      a.is_bound = a.is_bound || a.moves;
      b.is_bound = b.is_bound || b.moves;
    }
  }

  void MakePoint(ContactRow& row, int i, const ContactForces& before, const Mover& a, const Mover& b)
  {
    Candidate& candidate = *row.candidate;
    const Meeting meeting =
        MeetingOf(row.manifold, i, a.parts[candidate.part_a], a.place, b.parts[candidate.part_b], b.place);
    ContactPoint& point = row.points[static_cast<std::size_t>(i)];
    row.normal_x = meeting.normal_x;
    row.normal_y = meeting.normal_y;
    point.ax = meeting.x - a.place.x;
    point.ay = meeting.y - a.place.y;
    point.bx = meeting.x - b.place.x;
    point.by = meeting.y - b.place.y;
    const double mass = a.inverse_mass + b.inverse_mass;
    const double lever_a = point.ax * row.normal_y - point.ay * row.normal_x;
    const double lever_b = point.bx * row.normal_y - point.by * row.normal_x;
    point.inverse_normal_mass = mass + a.inverse_inertia * lever_a * lever_a + b.inverse_inertia * lever_b * lever_b;
    point.normal_mass = 1 / point.inverse_normal_mass;
    const double along_a = point.ax * row.normal_x + point.ay * row.normal_y;
    const double along_b = point.bx * row.normal_x + point.by * row.normal_y;
    point.inverse_tangent_mass = mass + a.inverse_inertia * along_a * along_a + b.inverse_inertia * along_b * along_b;
    point.tangent_mass = 1 / point.inverse_tangent_mass;
    const Vector2 slip = SlipAt<true>(point, a, b);
    const double approach = slip.x() * row.normal_x + slip.y() * row.normal_y;
    const double gap = std::max(meeting.gap, 0.0);
    point.target = -gap / seconds_;
    if (candidate.restitution * -approach > 0 && approach < -kBounceSpeed && approach <= point.target)
      point.target = -candidate.restitution * approach;
    candidate.touches = candidate.touches || meeting.gap <= 0;
    point.normal = point.tangent = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(before.points); ++k)
    {
      if (before.features[k] != row.manifold.features[static_cast<std::size_t>(i)]) continue;
      point.normal = before.normal[k] * seconds_;
      point.tangent = before.tangent[k] * seconds_;
      break;
    }
  }

  // The velocity of b against a at a point. `kBoth`: b is not static.
  template <bool kBoth>
  static Vector2 SlipAt(const ContactPoint& point, const Mover& a, const Mover& b)
  {
    const double x = a.turn * point.ay - a.vx;
    const double y = -a.turn * point.ax - a.vy;
    if constexpr (!kBoth) return {x, y};
    return {x + b.vx - b.turn * point.by, y + b.vy + b.turn * point.bx};
  }

  template <bool kBoth>
  static void PushApart(const ContactPoint& point, Mover& a, Mover& b, double x, double y)
  {
    a.vx -= a.inverse_mass * x;
    a.vy -= a.inverse_mass * y;
    a.turn -= a.inverse_inertia * (point.ax * y - point.ay * x);
    if constexpr (!kBoth) return;
    b.vx += b.inverse_mass * x;
    b.vy += b.inverse_mass * y;
    b.turn += b.inverse_inertia * (point.bx * y - point.by * x);
  }

  // Friction first, since the normal impulses matter more. Returns the largest change of velocity.
  template <bool kBoth>
  double SolveContact(ContactRow& row)
  {
    const Candidate& candidate = *row.candidate;
    Mover& a = run_.movers[candidate.a];
    Mover& b = run_.movers[candidate.b];
    const double tangent_x = row.normal_y;
    const double tangent_y = -row.normal_x;
    double most = 0;
    for (int i = 0; i < row.manifold.points; ++i)
    {
      ContactPoint& point = row.points[static_cast<std::size_t>(i)];
      if (point.normal == 0 && point.tangent == 0) continue;
      const Vector2 slip = SlipAt<kBoth>(point, a, b);
      const double speed = slip.x() * tangent_x + slip.y() * tangent_y;
      const double limit = candidate.friction * point.normal;
      const double sum = std::clamp(point.tangent - point.tangent_mass * speed, -limit, limit);
      const double impulse = sum - point.tangent;
      point.tangent = sum;
      PushApart<kBoth>(point, a, b, impulse * tangent_x, impulse * tangent_y);
      most = std::max(most, std::abs(impulse) * point.inverse_tangent_mass);
    }
    for (int i = 0; i < row.manifold.points; ++i)
    {
      ContactPoint& point = row.points[static_cast<std::size_t>(i)];
      const Vector2 slip = SlipAt<kBoth>(point, a, b);
      const double speed = slip.x() * row.normal_x + slip.y() * row.normal_y;
      const double sum = std::max(point.normal - point.normal_mass * (speed - point.target), 0.0);
      const double impulse = sum - point.normal;
      if (impulse == 0) continue;
      point.normal = sum;
      PushApart<kBoth>(point, a, b, impulse * row.normal_x, impulse * row.normal_y);
      most = std::max(most, std::abs(impulse) * point.inverse_normal_mass);
    }
    return most;
  }

  void SolveVelocities()
  {
    for (std::size_t i = 0; i < run_.bodies.size(); ++i)
    {
      Mover& mover = run_.movers[i];
      if (!mover.moves) continue;
      if (!mover.is_bound)
      {
        SolveGround(mover);
        continue;
      }
      BeginWithGround(mover);
    }
    for (const GripRow& grip : run_.grips)
    {
      const bool is_rod = IsRod(BodyOf(run_.movers[grip.holder]));
      Push(grip, run_.movers[grip.holder], run_.movers[grip.held],
           is_rod ? grip.impulse_x * grip.axis_x : grip.impulse_x,
           is_rod ? grip.impulse_x * grip.axis_y : grip.impulse_y, grip.impulse_turn);
    }
    for (const ContactRow& row : run_.rows)
      for (int i = 0; i < row.manifold.points; ++i)
      {
        const ContactPoint& point = row.points[static_cast<std::size_t>(i)];
        if (point.normal == 0 && point.tangent == 0) continue;
        PushApart<true>(point, run_.movers[row.candidate->a], run_.movers[row.candidate->b],
                        point.normal * row.normal_x + point.tangent * row.normal_y,
                        point.normal * row.normal_y - point.tangent * row.normal_x);
      }
    for (int iteration = 0; iteration < settings_.velocity_iterations; ++iteration)
    {
      double change = 0;
      for (GripRow& grip : run_.grips) change = std::max(change, SolveGrip(grip));
      for (std::size_t i = 0; i < run_.bodies.size(); ++i)
        if (run_.movers[i].is_bound) change = std::max(change, SolveGround(run_.movers[i]));
      for (ContactRow& row : run_.rows)
        change = std::max(change,
                          row.candidate->b < run_.bodies.size() ? SolveContact<true>(row) : SolveContact<false>(row));
      if (change < kStill) break;
    }
  }

  // The impulse of the last step, within the limits of this one.
  void BeginWithGround(Mover& mover)
  {
    const GroundForce& before = BodyOf(mover).ground;
    double x = before.x * seconds_;
    double y = before.y * seconds_;
    const double size = x * x + y * y;
    if (size > mover.most_force * mover.most_force)
    {
      const double part = mover.most_force / std::sqrt(size);
      x *= part;
      y *= part;
    }
    mover.ground_x = x;
    mover.ground_y = y;
    mover.ground_turn = std::clamp(before.torque * seconds_, -mover.most_turn, mover.most_turn);
    mover.vx += mover.inverse_mass * x;
    mover.vy += mover.inverse_mass * y;
    mover.turn += mover.inverse_inertia * mover.ground_turn;
  }

  void KeepForces()
  {
    const double rate = 1 / seconds_;
    for (std::size_t i = 0; i < run_.bodies.size(); ++i)
    {
      const Mover& mover = run_.movers[i];
      BodyOf(mover).ground = {mover.ground_x * rate, mover.ground_y * rate, mover.ground_turn * rate};
    }
    for (const GripRow& grip : run_.grips)
      BodyOf(run_.movers[grip.holder]).grip_forces = {grip.impulse_x * rate, grip.impulse_y * rate,
                                                      grip.impulse_turn * rate};
    for (const ContactRow& row : run_.rows)
      for (std::size_t i = 0; i < static_cast<std::size_t>(row.manifold.points); ++i)
      {
        Candidate& candidate = *row.candidate;
        candidate.forces.normal[i] = row.points[i].normal * rate;
        candidate.forces.tangent[i] = row.points[i].tangent * rate;
        candidate.touches = candidate.touches || row.points[i].normal > 0;
      }
  }

  void Move(Mover& mover)
  {
    Body& body = BodyOf(mover);
    if (!body.solid) return;
    if (mover.moves)
    {
      const double longest = kLongestStep / seconds_;
      const double speed = mover.vx * mover.vx + mover.vy * mover.vy;
      if (speed > longest * longest)
      {
        const double part = longest / std::sqrt(speed);
        mover.vx *= part;
        mover.vy *= part;
      }
      const double most_turn = kLargestTurn / seconds_;
      mover.turn = std::clamp(mover.turn, -most_turn, most_turn);
    }
    mover.place.x += seconds_ * mover.vx;
    mover.place.y += seconds_ * mover.vy;
    if (mover.turn != 0) SetAngle(mover, mover.angle + seconds_ * mover.turn);
  }

  // Adds the ways of both wheels, along the heading in the middle of the step.
  void MeasureWheels(const Mover& mover)
  {
    Body& body = BodyOf(mover);
    if (body.half_axle <= 0) return;
    const double x = mover.before.cos + mover.place.cos;
    const double y = mover.before.sin + mover.place.sin;
    const double way = (x * (mover.place.x - mover.before.x) + y * (mover.place.y - mover.before.y)) / Length(x, y);
    const double turn = (mover.angle - mover.angle_before) * body.half_axle;
    body.measures.left_arc += way - turn;
    body.measures.right_arc += way + turn;
  }

  void SolvePositions()
  {
    for (int iteration = 0; iteration < settings_.position_iterations; ++iteration)
    {
      double deepest = 0;
      for (const ContactRow& row : run_.rows) deepest = std::min(deepest, SeparateContact(row));
      bool are_grips_right = true;
      for (GripRow& grip : run_.grips) are_grips_right = CloseGrip(grip) && are_grips_right;
      if (deepest >= -3 * kSlop && are_grips_right) break;
    }
  }

  static void MovePlace(Mover& mover, double x, double y, double turn)
  {
    mover.place.x += x;
    mover.place.y += y;
    if (turn != 0) SetAngle(mover, mover.angle + turn);
  }

  double SeparateContact(const ContactRow& row)
  {
    const Candidate& candidate = *row.candidate;
    Mover& a = run_.movers[candidate.a];
    Mover& b = run_.movers[candidate.b];
    double deepest = 0;
    for (int i = 0; i < row.manifold.points; ++i)
    {
      const Meeting meeting =
          MeetingOf(row.manifold, i, a.parts[candidate.part_a], a.place, b.parts[candidate.part_b], b.place);
      deepest = std::min(deepest, meeting.gap);
      const double error = std::clamp(kCorrected * (meeting.gap + kSlop), -kLargestPush, 0.0);
      if (error == 0) continue;
      const double ax = meeting.x - a.place.x;
      const double ay = meeting.y - a.place.y;
      const double bx = meeting.x - b.place.x;
      const double by = meeting.y - b.place.y;
      const double lever_a = ax * meeting.normal_y - ay * meeting.normal_x;
      const double lever_b = bx * meeting.normal_y - by * meeting.normal_x;
      const double impulse = -error / (a.inverse_mass + b.inverse_mass + a.inverse_inertia * lever_a * lever_a +
                                       b.inverse_inertia * lever_b * lever_b);
      MovePlace(a, -a.inverse_mass * impulse * meeting.normal_x, -a.inverse_mass * impulse * meeting.normal_y,
                TurnBy(-a.inverse_inertia * lever_a * impulse));
      MovePlace(b, b.inverse_mass * impulse * meeting.normal_x, b.inverse_mass * impulse * meeting.normal_y,
                TurnBy(b.inverse_inertia * lever_b * impulse));
    }
    return deepest;
  }

  // A push through the middle of a disc turns it by rounding alone.
  static double TurnBy(double turn) { return std::abs(turn) < 1e-15 ? 0 : turn; }

  bool CloseGrip(GripRow& grip)
  {
    Mover& holder = run_.movers[grip.holder];
    Mover& held = run_.movers[grip.held];
    const Body& body = BodyOf(holder);
    grip.anchor_x = held.place.cos * body.grip.anchor_x - held.place.sin * body.grip.anchor_y;
    grip.anchor_y = held.place.sin * body.grip.anchor_x + held.place.cos * body.grip.anchor_y;
    double x = held.place.x + grip.anchor_x - holder.place.x;
    double y = held.place.y + grip.anchor_y - holder.place.y;
    Impulse impulse{};
    double error = 0;
    double turn_error = 0;
    if (IsRod(body))
    {
      const double length = AlignRod(grip, holder, held);
      error = length - body.model.radius;
      impulse.x = -grip.mass * error * grip.axis_x;
      impulse.y = -grip.mass * error * grip.axis_y;
    }
    else if (body.model.has_turret_motor)
    {
      error = Length(x, y);
      impulse = ImpulseFor(grip, holder, held, -x, -y);
    }
    else
    {
      error = Length(x, y);
      turn_error = held.angle - holder.angle - body.grip.reference_angle;
      impulse = RigidImpulseFor(grip, holder, held, -x, -y, -turn_error);
    }
    MovePlace(holder, -holder.inverse_mass * impulse.x, -holder.inverse_mass * impulse.y,
              TurnBy(-holder.inverse_inertia * impulse.turn));
    const double turn = impulse.turn + grip.anchor_x * impulse.y - grip.anchor_y * impulse.x;
    MovePlace(held, held.inverse_mass * impulse.x, held.inverse_mass * impulse.y, TurnBy(held.inverse_inertia * turn));
    constexpr double kAngularSlop = 2.0 / 180 * kPi;
    return std::abs(error) <= kSlop && std::abs(turn_error) <= kAngularSlop;
  }

  void MeasureLoad(const GripRow& grip)
  {
    const Mover& holder = run_.movers[grip.holder];
    const Mover& held = run_.movers[grip.held];
    Body& body = BodyOf(holder);
    const GripForces& forces = body.grip_forces;
    const double x = IsRod(body) ? forces.x * grip.axis_x : forces.x;
    const double y = IsRod(body) ? forces.x * grip.axis_y : forces.y;
    const double angle =
        body.model.has_turret_motor ? held.angle - body.grip.reference_angle : holder.angle + body.turret_angle;
    const SinCos turret = SinCosOf(angle);
    const double part = 1.0 / steps_;
    body.measures.load.force_x -= part * (turret.cos * x + turret.sin * y);
    body.measures.load.force_y -= part * (turret.cos * y - turret.sin * x);
    body.measures.load.torque -= part * forces.torque;
  }

  std::span<Body> bodies_;
  GroupRun& run_;
  const SolverSettings& settings_;
  double seconds_;  // of a step
  int steps_;       // in the tick
};

}  // namespace

void SolveGroup(std::span<Body> bodies, GroupRun& run, const SolverSettings& settings, double seconds, int steps)
{
  Solver(bodies, run, settings, seconds, steps).Run();
}

}  // namespace swarmanoid::dynamics2d
