// Iterated racing for noisy values: candidates run seed by seed, and those that a statistical test shows to be worse
// are dropped, so that most runs go to good ones. Sources: M. Birattari, Z. Yuan, P. Balaprakash and T. Stuetzle,
// "F-Race and iterated F-Race: an overview", 2010; M. Lopez-Ibanez et al., "The irace package: Iterated racing for
// automatic algorithm configuration", 2016. As Optimiser it has no state to store: each call races again over the known
// values. One thread.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/design/study.h"
#include "studies/search/optimiser.h"

namespace swarmanoid
{

// A run that a race needs.
struct RaceRun
{
  std::vector<double> place;  // in the unit cube
  std::size_t seed;           // its number among the seeds of the study
};

class Race
{
public:
  // Returns the value of a run; smaller ones are better. Refused: the run has no value.
  using Known = std::function<KnownValue(std::span<const double> place, std::size_t seed)>;
  // Returns a text that is equal for places with equal values of all factors; nothing if the place is not allowed.
  using Identity = std::function<std::optional<std::string>(std::span<const double> place)>;

  // `levels`: for each side of the unit cube 0 for a range of numbers, or the number of its values, which have no order
  // and equal parts of the side. `seeds`: the number of seeds. Throws ConfigurationError if runs or seeds do not
  // suffice for a race.
  Race(const SearchChoice& search, std::vector<double> start, std::vector<std::size_t> levels, std::size_t seeds,
       Identity identity);

  struct Step
  {
    std::vector<RaceRun> wanted;                 // they do not depend on each other; none if the last race has ended
    std::vector<std::vector<double>> survivors;  // of the last race that ended, the best first
    std::size_t iteration = 0;                   // of the race that needs the runs, from 1 on
    std::size_t alive = 0;                       // its candidates that are left
  };
  Step Next(const Known& known) const;

private:
  friend class RaceReplay;
  const SearchChoice& search_;
  std::vector<double> start_;
  std::vector<std::size_t> levels_;
  std::size_t seeds_;
  Identity identity_;
  std::size_t iterations_, most_survivors_;
};

}  // namespace swarmanoid
