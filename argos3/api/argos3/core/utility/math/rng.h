// CRandom: random number generators. One that a controller or loop functions create is seeded from the seed of the
// experiment, the id of the robot and the step in which it is created, so that it draws the same numbers in every run,
// whatever the other robots do.
#pragma once

#include <argos3/core/utility/math/angles.h>
#include <argos3/core/utility/math/range.h>

#include <memory>

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
    // Of the numbers after the next Reset.
    void SetSeed(UInt32 seed) { seed_ = seed; }
    std::string GetType() const { return "philox4x32"; }
    // There is one type.
    void SetType(const std::string& /*type*/) {}
    void Reset();

    bool Bernoulli(Real probability = 0.5);
    // In [min, max).
    CRadians Uniform(const CRange<CRadians>& range);
    Real Uniform(const CRange<Real>& range);
    SInt32 Uniform(const CRange<SInt32>& range);
    UInt32 Uniform(const CRange<UInt32>& range);
    Real Exponential(Real mean);
    Real Gaussian(Real deviation, Real mean = 0);
    Real Rayleigh(Real sigma);
    Real Lognormal(Real sigma, Real mu);

  private:
    friend class CRandom;
    struct Stream;
    explicit CRNG(UInt64 seed, int);

    UInt64 seed_;
    std::unique_ptr<Stream> stream_;
  };

  // Generators of one name. Those of "argos" are seeded by the experiment, others by the seed given here.
  class CCategory
  {
  public:
    CCategory(const std::string& id, UInt32 seed) : id_(id), seed_(seed) {}
    const std::string& GetId() const { return id_; }
    void SetId(const std::string& id) { id_ = id; }
    UInt32 GetSeed() const { return seed_; }
    // Of the generators that are created from now on, and of those there are after the next reset.
    void SetSeed(UInt32 seed);
    CRNG* CreateRNG(const std::string& type = "");
    void ResetRNGs();
    void ReseedRNGs();
    // For CSimulator::Reset: the seeds of all generators; 0 gives back those that they were created with.
    void Vary(UInt32 variation);

  private:
    std::string id_;
    UInt32 seed_;
    UInt32 variation_ = 0;
    std::vector<std::unique_ptr<CRNG>> generators_;
  };

  // False if there is one of that name.
  static bool CreateCategory(const std::string& category, UInt32 seed);
  // All below throw CARGoSException for an unknown category.
  static CCategory& GetCategory(const std::string& category);
  static bool ExistsCategory(const std::string& category);
  static void RemoveCategory(const std::string& category);
  // Belongs to the controller or loop functions that create it. Those of other categories than "argos" may be created
  // by a program before it loads an experiment: the seed of the category and their number seed them.
  static CRNG* CreateRNG(const std::string& category, const std::string& type = "");
  static UInt32 GetSeedOf(const std::string& category);
  // Removes all categories but "argos", and the generators of that one.
  static void Reset();
  static void SetSeedOf(const std::string& category, UInt32 seed);
};

}  // namespace argos
