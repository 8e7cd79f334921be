// ARGoS3's generators draw from the counter-based streams of the simulator. A generator gets its seed from the stream
// of the robot or functions that create it, so its numbers depend on the experiment's seed, on that owner, and on the
// order of the owner's calls only. Ranges are half open, as in ARGoS3: the upper limit is not drawn, and an empty range
// of whole numbers yields its lower limit.
#include <argos3/core/utility/math/rng.h>

#include "argos3/library/running.h"
#include "common/math/random.h"

namespace argos
{
namespace
{

std::map<std::string, CRandom::CCategory>& Categories()
{
  // The seed of "argos" is not needed, since the experiment's seed is part of the robots' streams.
  static std::map<std::string, CRandom::CCategory> categories = []
  {
    std::map<std::string, CRandom::CCategory> first;
    first.emplace("argos", CRandom::CCategory("argos", 0));
    return first;
  }();
  return categories;
}

}  // namespace

struct CRandom::CRNG::Stream
{
  explicit Stream(UInt64 seed) : random(seed, swarmanoid::StreamName("generator"), swarmanoid::StreamName("ARGoS3"), 0)
  {
  }
  swarmanoid::RandomStream random;
};

CRandom::CRNG::CRNG(UInt32 seed, const std::string& /*type*/) : CRNG(UInt64{seed}, 0) {}
CRandom::CRNG::CRNG(UInt64 seed, int) : seed_(seed), stream_(std::make_unique<Stream>(seed)) {}
CRandom::CRNG::CRNG(const CRNG& other) : CRNG(other.seed_, 0) {}
CRandom::CRNG::~CRNG() = default;

void CRandom::CRNG::Reset() { stream_ = std::make_unique<Stream>(seed_); }

bool CRandom::CRNG::Bernoulli(Real probability) { return stream_->random.Uniform() < probability; }

Real CRandom::CRNG::Uniform(const CRange<Real>& range)
{
  return stream_->random.Uniform(range.GetMin(), range.GetMax());
}

CRadians CRandom::CRNG::Uniform(const CRange<CRadians>& range)
{
  return CRadians(stream_->random.Uniform(range.GetMin().GetValue(), range.GetMax().GetValue()));
}

UInt32 CRandom::CRNG::Uniform(const CRange<UInt32>& range)
{
  const UInt32 span = range.GetMax() - range.GetMin();
  return span == 0 ? range.GetMin() : range.GetMin() + stream_->random.Below(span);
}

SInt32 CRandom::CRNG::Uniform(const CRange<SInt32>& range)
{
  const auto low = static_cast<UInt32>(range.GetMin());
  const UInt32 span = static_cast<UInt32>(range.GetMax()) - low;
  return static_cast<SInt32>(span == 0 ? low : low + stream_->random.Below(span));
}

// The number is drawn by inversion.
Real CRandom::CRNG::Exponential(Real mean) { return -mean * std::log(1 - stream_->random.Uniform()); }
Real CRandom::CRNG::Gaussian(Real deviation, Real mean) { return stream_->random.Gaussian(mean, deviation); }
Real CRandom::CRNG::Rayleigh(Real sigma) { return sigma * std::sqrt(-2 * std::log(1 - stream_->random.Uniform())); }
Real CRandom::CRNG::Lognormal(Real sigma, Real mu) { return std::exp(Gaussian(sigma, mu)); }

// The number is drawn by inversion (Devroye, Non-Uniform Random Variate Generation, chapter X.3.3).
UInt32 CRandom::CRNG::Poisson(Real mean)
{
  constexpr Real kMost = 700;  // exp(-mean) is no number above 0 for larger means
  if (!(mean >= 0 && mean <= kMost)) THROW_ARGOSEXCEPTION("the mean of Poisson is " << mean << ", not 0 to " << kMost);
  UInt32 count = 0;
  Real probability = std::exp(-mean);
  const Real drawn = stream_->random.Uniform();
  for (Real sum = probability; drawn > sum && probability > 0; sum += probability) probability *= mean / ++count;
  return count;
}

void CRandom::CCategory::SetSeed(UInt32 seed)
{
  seed_ = seed;
  ReseedRNGs();
}

CRandom::CRNG* CRandom::CCategory::CreateRNG(const std::string& /*type*/)
{
  // Programs draw their own numbers before they load an experiment.
  const bool is_of_program = id_ != "argos" && !swarmanoid::argos3::Speaker::Speaks();
  const UInt64 first =
      is_of_program ? swarmanoid::MixedBits(generators_.size()) : swarmanoid::argos3::Speaker::RandomBits();
  const UInt64 seed = first ^ swarmanoid::MixedBits(seed_);
  generators_.push_back(std::unique_ptr<CRNG>(new CRNG(seed, 0)));
  return generators_.back().get();
}

void CRandom::CCategory::ResetRNGs()
{
  for (const auto& generator : generators_) generator->Reset();
}

void CRandom::CCategory::ReseedRNGs()
{
  for (std::size_t i = 0; i < generators_.size(); ++i)
    generators_[i]->SetSeed(static_cast<UInt32>(swarmanoid::MixedBits(seed_ + (UInt64{i} << 32U))));
}

void CRandom::CCategory::Vary(UInt32 variation)
{
  const auto bits = [](UInt32 of) { return of == 0 ? UInt64{0} : swarmanoid::MixedBits(of); };
  for (const auto& generator : generators_) generator->seed_ ^= bits(variation_) ^ bits(variation);
  variation_ = variation;
}

bool CRandom::CreateCategory(const std::string& category, UInt32 seed)
{
  return Categories().emplace(category, CCategory(category, seed)).second;
}

CRandom::CCategory& CRandom::GetCategory(const std::string& category)
{
  const auto found = Categories().find(category);
  if (found == Categories().end()) THROW_ARGOSEXCEPTION("there is no category '" << category << "' of generators");
  return found->second;
}

bool CRandom::ExistsCategory(const std::string& category) { return Categories().count(category) != 0; }

void CRandom::RemoveCategory(const std::string& category)
{
  GetCategory(category);
  Categories().erase(category);
}

CRandom::CRNG* CRandom::CreateRNG(const std::string& category, const std::string& type)
{
  return GetCategory(category).CreateRNG(type);
}

void CRandom::Reset()
{
  Categories().clear();
  CreateCategory("argos", 0);
}

UInt32 CRandom::GetSeedOf(const std::string& category) { return GetCategory(category).GetSeed(); }
void CRandom::SetSeedOf(const std::string& category, UInt32 seed) { GetCategory(category).SetSeed(seed); }

}  // namespace argos
