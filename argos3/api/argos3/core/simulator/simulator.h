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
  // Throws CARGoSException if this process runs no loop functions.
  CLoopFunctions& GetLoopFunctions();
  // Returns the only engine for any id.
  CPhysicsEngine& GetPhysicsEngine(const std::string& id)
  {
    engine_.SetId(id);
    return engine_;
  }
  const CPhysicsEngine::TVector& GetPhysicsEngines() const { return engines_; }
  // Returns the only medium of each type.
  template <class Medium>
  Medium& GetMedium(const std::string& id)
  {
    static_assert(std::is_base_of<CMedium, Medium>::value, "a medium is asked for by its type");
    static Medium medium;
    medium.SetId(id);
    return medium;
  }
  UInt32 GetRandomSeed() const { return seed_; }
  // Returns a generator of the category "argos". Throws CARGoSException outside controllers and loop functions.
  CRandom::CRNG* GetRNG();
  // Returns false, since --real-time sets the speed of a run.
  bool IsRealTimeClock() const { return false; }
  void SetRealTimeClock(bool /*is_so*/) {}
  UInt32 GetNumThreads() const { return 0; }
  bool IsProfiling() const { return false; }
  // Returns the element of a controller as it is in the file. Throws CARGoSException for an unknown id, and as
  // GetConfigurationRoot.
  TConfigurationNode& GetConfigForController(const std::string& id);
  // Sets the result of GetRandomSeed. Random generators and noise use it from the next Reset on.
  void SetRandomSeed(UInt32 seed) { seed_ = seed; }
  // Returns the experiment file. Throws CARGoSException outside loop functions. The function is defined in the library,
  // since `swarmanoid` finds by its name which libraries call it.
  TConfigurationNode& GetConfigurationRoot();
  // Returns ticks; 0: no end.
  UInt32 GetMaxSimulationClock() const { return max_clock_; }
  // Ends the experiment after this step.
  void Terminate() { terminated_ = true; }
  // Resets random generators, noise, the space and the loop functions, with the clock at 0. With the same seed the
  // trial is the same. A call from Reset of the loop functions does not call that again. The function is defined in the
  // library, since `swarmanoid` finds by its name which loop functions reset runs. Throws CARGoSException as
  // CSpace::Reset does.
  void Reset();
  void Reset(UInt32 seed)
  {
    SetRandomSeed(seed);
    Reset();
  }
  bool IsTerminated() const { return terminated_; }

  // These functions are for a program that runs experiments itself: SetExperimentFileName, LoadExperiment, then Execute
  // and Reset as often as needed, at the end Destroy. The experiment needs loop functions, runs in this process and
  // shows nothing. The functions throw CARGoSException for mistakes in the file and errors in a run.
  void SetExperimentFileName(const std::string& file) { experiment_file_ = file; }
  const std::string& GetExperimentFileName() const { return experiment_file_; }
  // Loads the experiment, up to Init of the loop functions.
  void LoadExperiment();
  // Loads an experiment in memory, which the program may have changed. Paths in it are those of the document's file.
  void Load(ticpp::Document& document);
  // Calls PreExperiment, steps until the experiment is over, and calls PostExperiment.
  void Execute();
  // Does one step.
  void UpdateSpace();
  bool IsExperimentFinished() const;
  // Ends the experiment; another one may be loaded then.
  void Destroy();

  // Starts the experiment, for the bridge to the simulator.
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
