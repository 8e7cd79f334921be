#include "controller_host/devices/radio/shared_channel.h"

#include <algorithm>
#include <string>

#include "common/math/elementary.h"
#include "common/math/random.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

constexpr double kNearestLink = 0.01;             // m: nearer radios are as strong as there
constexpr double kDecibel = 0.23025850929940458;  // ln(10) / 10
constexpr double kDeviations = 4;                 // of the shadowing, that are computed
constexpr double kNoCapture = 1000;               // dB

double Power(double signal_db) { return Exp(kDecibel * signal_db); }

}  // namespace

SharedChannel::SharedChannel(const Parameters& parameters, const CSwarmanoidSpace& space, std::string_view channel)
    : space_(space),
      slot_purpose_(StreamName(std::string(channel) + " slot")),
      link_purpose_(StreamName(std::string(channel) + " shadowing")),
      exponent_(parameters.Number("path_loss")),
      shadowing_db_(parameters.Number("shadowing")),
      capture_db_(parameters.Number("capture")),
      slots_(static_cast<std::uint32_t>(parameters.Integer("slots")))
{
  const double range_m = parameters.Number("range");
  least_db_ = -exponent_ / kDecibel * Log(range_m);
  reach_m_ = range_m * Power(kDeviations * shadowing_db_ / exponent_);
}

std::uint32_t SharedChannel::SlotOf(std::uint64_t name) const
{
  if (slots_ == 1) return 0;
  RandomStream random(space_.GetExperiment().seed, name, slot_purpose_, space_.StreamTick());
  return std::min(static_cast<std::uint32_t>(random.Uniform() * slots_), slots_ - 1);
}

double SharedChannel::Signal_dB(std::uint64_t sender, std::uint64_t receiver, double square_m2) const
{
  const double square = std::max(square_m2, kNearestLink * kNearestLink);
  const double signal_db = -exponent_ / kDecibel * Log(square) / 2;
  if (shadowing_db_ == 0) return signal_db;
  const auto [first, second] = std::minmax(sender, receiver);
  RandomStream random(space_.GetExperiment().seed, first, MixedBits(second ^ link_purpose_), 0);
  return signal_db +
         std::clamp(random.Gaussian(0, shadowing_db_), -kDeviations * shadowing_db_, kDeviations * shadowing_db_);
}

void SharedChannel::Receive(std::vector<Arrival>& arrivals, std::optional<std::uint32_t> own_slot) const
{
  // The order of the sums is that of the slots and entities, in every host.
  std::ranges::sort(arrivals, [](const Arrival& a, const Arrival& b)
                    { return a.slot != b.slot ? a.slot < b.slot : a.sender < b.sender; });
  std::size_t kept = 0;
  for (std::size_t first = 0, behind = 0; first < arrivals.size(); first = behind)
  {
    double all = 0;
    std::size_t strongest = first;
    for (behind = first; behind < arrivals.size() && arrivals[behind].slot == arrivals[first].slot; ++behind)
    {
      all += Power(arrivals[behind].signal_db);
      if (arrivals[behind].signal_db > arrivals[strongest].signal_db) strongest = behind;
    }
    const Arrival best = arrivals[strongest];
    const bool is_alone = behind == first + 1;
    if (best.signal_db < least_db_ || own_slot == best.slot) continue;
    if (!is_alone && capture_db_ >= kNoCapture) continue;
    const double power = Power(best.signal_db);
    if (!is_alone && power < Power(capture_db_) * (all - power)) continue;
    arrivals[kept++] = best;
  }
  arrivals.resize(kept);
  std::ranges::sort(arrivals, {}, &Arrival::sender);
}

}  // namespace swarmanoid
