// CRandom: random number generators. A generator of a controller or of loop functions gets its seed from the seed of
// the experiment, the id of the robot, and the step in which it is created. So it draws the same numbers in every run,
// independent of other robots.
#pragma once

#include <argos3/core/utility/math/angles.h>
#include <argos3/core/utility/math/range.h>

#include <memory>
#include <utility>
#include <vector>

namespace argos
{

class CRandom
{
public:
  class CRNG
  {
  public:
    explicit CRNG(UInt32 seed, const std::string& type = "");
    CRNG(const CRNG& other);
    ~CRNG();

    UInt32 GetSeed() const { return static_cast<UInt32>(seed_); }
    // Sets the seed for the numbers after the next Reset.
    void SetSeed(UInt32 seed) { seed_ = seed; }
    std::string GetType() const { return "philox4x32"; }
    // Does nothing, since there is one type.
    void SetType(const std::string& /*type*/) {}
    void Reset();

    bool Bernoulli(Real probability = 0.5);
    // Return a number in [min, max).
    CRadians Uniform(const CRange<CRadians>& range);
    Real Uniform(const CRange<Real>& range);
    SInt32 Uniform(const CRange<SInt32>& range);
    UInt32 Uniform(const CRange<UInt32>& range);
    Real Exponential(Real mean);
    Real Gaussian(Real deviation, Real mean = 0);
    Real Rayleigh(Real sigma);
    Real Lognormal(Real sigma, Real mu);
    // Throws CARGoSException for a mean that is negative or above 700.
    UInt32 Poisson(Real mean);
    template <class T>
    void Shuffle(std::vector<T>& values)
    {
      for (size_t i = 0; i + 1 < values.size(); ++i)
        std::swap(values[i], values[i + Uniform(CRange<UInt32>(0, static_cast<UInt32>(values.size() - i)))]);
    }

  private:
    friend class CRandom;
    struct Stream;
    explicit CRNG(UInt64 seed, int);

    UInt64 seed_;
    std::unique_ptr<Stream> stream_;
  };

  // The generators of one name. The experiment seeds those of "argos"; the seed given here seeds others.
  class CCategory
  {
  public:
    CCategory(const std::string& id, UInt32 seed) : id_(id), seed_(seed) {}
    const std::string& GetId() const { return id_; }
    void SetId(const std::string& id) { id_ = id; }
    UInt32 GetSeed() const { return seed_; }
    // Sets the seed of generators that are created from now on, and of existing ones after the next reset.
    void SetSeed(UInt32 seed);
    CRNG* CreateRNG(const std::string& type = "");
    void ResetRNGs();
    void ReseedRNGs();
    // Changes the seeds of all generators, for CSimulator::Reset; 0 restores the initial ones.
    void Vary(UInt32 variation);

  private:
    std::string id_;
    UInt32 seed_;
    UInt32 variation_ = 0;
    std::vector<std::unique_ptr<CRNG>> generators_;
  };

  // Returns false if the name exists already.
  static bool CreateCategory(const std::string& category, UInt32 seed);
  // All functions below throw CARGoSException for an unknown category.
  static CCategory& GetCategory(const std::string& category);
  static bool ExistsCategory(const std::string& category);
  static void RemoveCategory(const std::string& category);
  // Returns a generator that belongs to the controller or loop functions that create it. A program may create
  // generators of other categories than "argos" before it loads an experiment: the seed of the category and their
  // number seed them.
  static CRNG* CreateRNG(const std::string& category, const std::string& type = "");
  static UInt32 GetSeedOf(const std::string& category);
  // Removes all categories except "argos", and the generators of "argos".
  static void Reset();
  static void SetSeedOf(const std::string& category, UInt32 seed);
};

}  // namespace argos
