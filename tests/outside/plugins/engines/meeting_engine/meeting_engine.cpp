// An engine whose robots all move towards the one that is farthest along x. It can be split: its regions tell each
// other the positions of their robots, and keep them.
#include <algorithm>
#include <stdexcept>

#include "engine_worker/physics_engine.h"

using namespace swarmanoid;

namespace
{

double FarthestOf(const std::vector<double>& x) { return x.empty() ? -1e300 : *std::max_element(x.begin(), x.end()); }

void Step(std::vector<double>& x, double farthest)
{
  for (double& at : x) at += 0.01 * (farthest + 0.001 - at);
}

class MeetingRegion : public EngineRegion
{
public:
  MeetingRegion(unsigned number, RegionExchange& exchange)
      : number_(number), exchange_(exchange), out_(exchange.RegionCount()), in_(exchange.RegionCount())
  {
  }

  void Work(std::span<const char> task, ByteWriter& result) override
  {
    ByteReader reader(task);
    if (reader.Get<bool>()) x_ = reader.GetArray<double>();
    double farthest = FarthestOf(x_);
    for (ByteWriter& message : out_)
    {
      message.Clear();
      message.Put(farthest);
    }
    exchange_.Swap(out_, in_);
    for (unsigned region = 0; region < in_.size(); ++region)
      if (region != number_) farthest = std::max(farthest, ByteReader(in_[region]).Get<double>());
    Step(x_, farthest);
    result.PutArray(x_);
  }

private:
  unsigned number_;
  RegionExchange& exchange_;
  std::vector<ByteWriter> out_;
  std::vector<std::vector<char>> in_;
  std::vector<double> x_;
};

}  // namespace

class CMeetingEngine : public CPhysicsEngine
{
public:
  void Init(const EngineSetup& setup) override
  {
    space_ = &setup.space;
    layout_ = &setup.layout;
    team_ = setup.team;
  }
  void AddEntity(const CSwarmanoidSpaceEntity& entity, EBinding binding) override
  {
    if (binding == EBinding::kOwned) x_.push_back(entity.GetPosition().x());
  }

  void Update(const EngineCommands&, EngineUpdate& update, std::span<double>) override
  {
    if (team_ != nullptr && team_->IsReady())
      AskRegions();
    else
    {
      Step(x_, FarthestOf(x_));
      knows_all_ = false;
    }
    const std::size_t count = x_.size();
    for (std::size_t k = 0; k < count; ++k)
    {
      const Pose pose = space_->GetPose(layout_->owned[k]);
      const Quaternion& q = pose.orientation;
      const double values[] = {x_[k], pose.position.y(), pose.position.z(), q.x(), q.y(), q.z(), q.w()};
      for (std::size_t part = 0; part < 7; ++part) update.poses[part * count + k] = values[part];
    }
  }

  void EntityMoved(std::uint32_t entity) override
  {
    const auto& owned = layout_->owned;
    x_[std::lower_bound(owned.begin(), owned.end(), entity) - owned.begin()] = space_->GetPose(entity).position.x();
    knows_all_ = false;
  }
  void SaveState(ByteWriter& state) const override { state.PutArray(x_); }
  void LoadState(ByteReader& state) override
  {
    x_ = state.GetArray<double>();
    knows_all_ = false;
  }
  void Canonicalise() override {}
  std::unique_ptr<EngineRegion> MakeRegion(unsigned region, RegionExchange& exchange) override
  {
    if (space_ != nullptr) throw std::logic_error("something was called before");
    return std::make_unique<MeetingRegion>(region, exchange);
  }

private:
  // Robot k is of region k modulo their number.
  void AskRegions()
  {
    const unsigned regions = team_->RegionCount();
    results_.resize(regions);
    team_->Work(
        !knows_all_,
        [&](bool all_data, std::span<ByteWriter> tasks)
        {
          std::vector<std::vector<double>> parts(regions);
          for (std::size_t k = 0; k < x_.size(); ++k) parts[k % regions].push_back(x_[k]);
          for (unsigned region = 0; region < regions; ++region)
          {
            tasks[region].Put(all_data);
            if (all_data) tasks[region].PutArray(parts[region]);
          }
        },
        results_);
    for (unsigned region = 0; region < regions; ++region)
    {
      const std::vector<double> part = ByteReader(results_[region]).GetArray<double>();
      for (std::size_t k = 0; k < part.size(); ++k) x_.at(k * regions + region) = part[k];
    }
    knows_all_ = true;
  }

  const CSwarmanoidSpace* space_ = nullptr;
  const EngineLayout* layout_ = nullptr;
  RegionTeam* team_ = nullptr;
  bool knows_all_ = false;
  std::vector<double> x_;
  std::vector<std::vector<char>> results_;
};

REGISTER_PHYSICS_ENGINE(CMeetingEngine, {.label = "meeting_engine",
                                         .brief = "robots go towards the farthest one",
                                         .channels = {"footbot_wheels"},
                                         .entity_tags = {"footbot"},
                                         .can_split = true})
