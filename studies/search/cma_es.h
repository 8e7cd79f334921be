// The covariance matrix adaptation evolution strategy (CMA-ES) with rank-one and rank-mu update, negative weights and
// cumulative step-size adaptation. Source: N. Hansen, "The CMA Evolution Strategy: A Tutorial", arXiv:1604.00772v2
// (2023); its equations are cited as (n). Values of one generation do not depend on each other. Used by searches of
// studies; one thread.
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace swarmanoid
{

class CmaEs
{
public:
  // Begins at `mean` with the standard deviation `step` in each dimension. `population`: places in a generation, at
  // least 4. All random numbers follow from `random_seed` and `run`.
  CmaEs(Eigen::VectorXd mean, double step, std::size_t population, std::uint64_t random_seed, std::uint64_t run);

  // Returns the tutorial's default, 4 + floor(3 ln n).
  static std::size_t DefaultPopulation(std::size_t dimensions);

  // Draws the places of the next generation.
  const std::vector<Eigen::VectorXd>& Ask();
  // Adapts the distribution to the values of these places; smaller ones are better, and only their order counts. Equal
  // values are ranked in the order of the places.
  void Tell(std::span<const double> values);

  // Returns the largest standard deviation of the distribution along an axis of the space.
  double Deviation() const;
  // Returns whether the generations no longer make progress: all last values are equal, or the axes of the distribution
  // differ by more than rounding errors permit (criteria TolFun and ConditionCov of the tutorial).
  bool HasStalled() const;

private:
  // Constant after construction.
  std::size_t dimensions_, population_;
  std::uint64_t random_seed_, run_;
  std::vector<double> weights_;  // of the ranks, (53); the first half is positive
  double selected_mass_;         // mu_eff
  double step_path_rate_, step_damping_, rank_one_path_rate_, rank_one_rate_, rank_mu_rate_;
  double normal_length_;       // the mean length of a standard normal vector
  std::size_t stalled_after_;  // generations

  // The distribution N(mean, step^2 C) with C = axes lengths^2 axes^T, and the paths.
  Eigen::VectorXd mean_;
  double step_;
  Eigen::MatrixXd covariance_, axes_;
  Eigen::VectorXd lengths_, step_path_, rank_one_path_;

  std::uint64_t generation_ = 0;
  std::vector<Eigen::VectorXd> steps_, places_;  // of this generation; a place is mean + step * its steps
  std::vector<double> best_values_;              // of each generation
  double last_spread_ = 0;                       // of the values of the last generation
};

}  // namespace swarmanoid
