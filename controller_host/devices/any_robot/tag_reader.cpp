// The reader of radio tags (RFID): the ids of the tagged entities within range of its antenna. Bodies do not hide tags.
// Generic.
#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <memory>
#include <sstream>

#include "common/control_interface/ci_tag_reader_sensor.h"
#include "common/space/space.h"
#include "common/space/space_query.h"
#include "controller_host/devices/device_plugins.h"

namespace swarmanoid
{
namespace
{

struct TagReader : public CCI_TagReaderSensor
{
  std::span<const Tag> GetAllTags() const override { return tags; }
  std::vector<Tag> tags;
};

class TagReaderSensor : public SensorBatch
{
public:
  void Init(const DeviceSetup& setup) override
  {
    space_ = &setup.space;
    robots_ = setup.robots;
    range_ = setup.parameters.Number("range");
    height_ = setup.parameters.Number("height");
    miss_ = setup.parameters.Number("miss_probability");
    noise_ = NoiseFrom(setup.parameters);
    streams_ = DeviceStreams(setup);
    miss_streams_ = DeviceStreams(setup, "miss");
    query_ = std::make_unique<SpaceQuery>(setup.space);
    readers_.resize(robots_.size());
    FindTagged(setup.parameters);
  }
  TagReader* Sensor(std::size_t k) override { return &readers_[k]; }
  void Expose(std::size_t k, ExposedValues& values) override { values.SetList(readers_[k].tags); }
  double Reach() const override { return std::abs(height_) + range_; }

  void Update(const ChannelView&) override
  {
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      readers_[k].tags.clear();
      const Vector3 antenna = space_->GetPose(robots_[k]).Apply({0, 0, height_});
      for (const std::uint32_t entity : query_->FindWithin(antenna, range_))
        if (entity != robots_[k] && names_[entity] != 0) Read(k, entity, antenna);
    }
  }

private:
  // Patterns have * for any characters and ? for one, as in <arena_physics>.
  void FindTagged(const Parameters& parameters)
  {
    names_.assign(space_->Size(), 0);
    std::istringstream patterns(parameters.Text("tagged"));
    for (std::string pattern; std::getline(patterns, pattern, ',');)
    {
      pattern.erase(0, pattern.find_first_not_of(' '));
      pattern.erase(pattern.find_last_not_of(' ') + 1);
      bool fits = false;
      for (std::uint32_t e = 0; e < space_->Size(); ++e)
      {
        const std::string& id = space_->GetEntity(e).GetId();
        if (fnmatch(pattern.c_str(), id.c_str(), FNM_NOESCAPE) != 0) continue;
        fits = true;
        names_[e] = StreamName(id);
      }
      if (!fits)
        throw ConfigurationError(parameters.Tree().ValueLocation("tagged"),
                                 fmt::format("no entity fits '{}' of 'tagged'; write ids of entities, or patterns such "
                                             "as prey_*, with commas between",
                                             pattern));
    }
  }

  void Read(std::size_t k, std::uint32_t entity, const Vector3& antenna)
  {
    if (miss_ > 0 && miss_streams_.Of(k, names_[entity]).Uniform() < miss_) return;
    double distance = __builtin_sqrt((space_->GetPose(entity).position - antenna).squaredNorm());
    if (noise_.IsActive()) distance = std::max(distance + noise_.Sample(streams_.Of(k, names_[entity])), 0.0);
    readers_[k].tags.push_back({space_->GetEntity(entity).GetId(), distance});
  }

  const CSwarmanoidSpace* space_ = nullptr;
  std::vector<std::uint32_t> robots_;
  std::unique_ptr<SpaceQuery> query_;
  double range_ = 0, height_ = 0;  // m
  double miss_ = 0;
  NoiseModel noise_;
  DeviceStreams streams_, miss_streams_;
  std::vector<std::uint64_t> names_;  // of the tagged entities; 0: no tag
  std::vector<TagReader> readers_;
};

}  // namespace

const DeviceCode kTagReaderCode([] { BindSensor<TagReaderSensor>("tag_reader", "generic_tag_reader"); });

}  // namespace swarmanoid
