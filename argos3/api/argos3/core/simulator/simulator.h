// CSimulator: the experiment of this process.
#pragma once

#include <argos3/core/simulator/physics_engine/physics_engine.h>
#include <argos3/core/simulator/space/space.h>
#include <argos3/core/utility/math/rng.h>

#include <type_traits>

namespace argos
{

class CLoopFunctions;

class CSimulator
{
public:
  static CSimulator& GetInstance();

  CSpace& GetSpace() { return space_; }
  // Throws CARGoSException if this process runs none.
  CLoopFunctions& GetLoopFunctions();
  // Whatever the id: one engine has all.
  CPhysicsEngine& GetPhysicsEngine(const std::string& id)
  {
    engine_.SetId(id);
    return engine_;
  }
  const CPhysicsEngine::TVector& GetPhysicsEngines() const { return engines_; }
  // One of each type.
  template <class Medium>
  Medium& GetMedium(const std::string& id)
  {
    static_assert(std::is_base_of<CMedium, Medium>::value, "a medium is asked for by its type");
    static Medium medium;
    medium.SetId(id);
    return medium;
  }
  UInt32 GetRandomSeed() const { return seed_; }
  // A generator of the category "argos". Throws CARGoSException where nobody draws: outside controllers and loop
  // functions.
  CRandom::CRNG* GetRNG();
  // How fast a run goes is a matter of --real-time.
  bool IsRealTimeClock() const { return false; }
  void SetRealTimeClock(bool /*is_so*/) {}
  UInt32 GetNumThreads() const { return 0; }
  bool IsProfiling() const { return false; }
  // The element of a controller, as it stands in the file. Throws CARGoSException for one that there is not, and as
  // GetConfigurationRoot.
  TConfigurationNode& GetConfigForController(const std::string& id);
  // What GetRandomSeed says from now on; random generators and noise follow it from the next Reset on.
  void SetRandomSeed(UInt32 seed) { seed_ = seed; }
  // The experiment file, as it stands there. Throws CARGoSException where no loop functions ask for it. Defined in the
  // library: `swarmanoid` tells by its name that a library asks.
  TConfigurationNode& GetConfigurationRoot();
  // Ticks; 0: no end.
  UInt32 GetMaxSimulationClock() const { return max_clock_; }
  // The experiment ends after this step.
  void Terminate() { terminated_ = true; }
  // Random generators, noise, the space and the loop functions begin again, the clock at 0: Reset of all of them. Of
  // the same seed the trial is the same. Called from Reset of the loop functions, it does not call that once more.
  // Defined in the library: `swarmanoid` tells by its name that loop functions reset runs. Throws CARGoSException where
  // CSpace::Reset does.
  void Reset();
  void Reset(UInt32 seed)
  {
    SetRandomSeed(seed);
    Reset();
  }
  bool IsTerminated() const { return terminated_; }

  // For a program that runs an experiment by itself, as often as it likes: SetExperimentFileName, LoadExperiment, then
  // Execute and Reset, at the end Destroy. The experiment needs loop functions, runs in this process and shows nothing.
  // Throw CARGoSException for what is wrong with the file, and what goes wrong in a run.
  void SetExperimentFileName(const std::string& file) { experiment_file_ = file; }
  const std::string& GetExperimentFileName() const { return experiment_file_; }
  // Up to Init of the loop functions.
  void LoadExperiment();
  // PreExperiment, steps until the experiment is over, PostExperiment.
  void Execute();
  // One step.
  void UpdateSpace();
  bool IsExperimentFinished() const;
  // Another one may be loaded then.
  void Destroy();

  // For the bridge.
  void Start(UInt32 seed, UInt32 max_clock)
  {
    seed_ = seed;
    first_seed_ = seed;
    max_clock_ = max_clock;
    terminated_ = false;
    generator_ = nullptr;
    configuration_ = TConfigurationNode();
  }
  TConfigurationNode& Configuration() { return configuration_; }

private:
  CSpace space_;
  CPhysicsEngine engine_;
  const CPhysicsEngine::TVector engines_{&engine_};
  UInt32 seed_ = 0;
  UInt32 first_seed_ = 0;
  bool resets_ = false;
  UInt32 max_clock_ = 0;
  bool terminated_ = false;
  CRandom::CRNG* generator_ = nullptr;
  std::string experiment_file_;
  TConfigurationNode configuration_;
};

}  // namespace argos
