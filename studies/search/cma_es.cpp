// Problem: the least value of a function of which only values are known, badly scaled and with correlated arguments.
//
// Method: draw a generation from a normal distribution, rank it, and move mean, step and covariance matrix towards the
// better half and away from the worse one. The names of the tutorial are: steps y (38), step path p_sigma (43),
// rank-one path p_c (45), rates c_sigma, c_c, c_1, c_mu (55 to 58).
//
// Invariants: random numbers are named by seed, run and generation, and Eigen uses no vector code, so equal values give
// equal places on every processor.
#include "studies/search/cma_es.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/math/random.h"

namespace swarmanoid
{
namespace
{

constexpr double kLeastSpread = 1e-12;     // TolFun
constexpr double kLargestCondition = 1e7;  // of the axes' lengths; 1e14 of the covariance matrix

}  // namespace

std::size_t CmaEs::DefaultPopulation(std::size_t dimensions)
{
  return 4 + static_cast<std::size_t>(3 * std::log(static_cast<double>(dimensions)));
}

CmaEs::CmaEs(Eigen::VectorXd mean, double step, std::size_t population, std::uint64_t random_seed, std::uint64_t run)
    : dimensions_(static_cast<std::size_t>(mean.size())),
      population_(population),
      random_seed_(random_seed),
      run_(run),
      mean_(std::move(mean)),
      step_(step)
{
  const auto n = static_cast<double>(dimensions_);
  // (49): the weights before normalisation, and the masses of both signs.
  double sums[2] = {0, 0}, squares[2] = {0, 0};
  for (std::size_t rank = 1; rank <= population_; ++rank)
  {
    const double weight = std::log((static_cast<double>(population_) + 1) / 2) - std::log(static_cast<double>(rank));
    weights_.push_back(weight);
    const int sign = weight < 0 ? 1 : 0;
    sums[sign] += std::abs(weight);
    squares[sign] += weight * weight;
  }
  selected_mass_ = sums[0] * sums[0] / squares[0];
  const double rejected_mass = squares[1] > 0 ? sums[1] * sums[1] / squares[1] : 0;

  step_path_rate_ = (selected_mass_ + 2) / (n + selected_mass_ + 5);
  step_damping_ = 1 + 2 * std::max(0.0, std::sqrt((selected_mass_ - 1) / (n + 1)) - 1) + step_path_rate_;
  rank_one_path_rate_ = (4 + selected_mass_ / n) / (n + 4 + 2 * selected_mass_ / n);
  rank_one_rate_ = 2 / ((n + 1.3) * (n + 1.3) + selected_mass_);
  rank_mu_rate_ = std::min(1 - rank_one_rate_,
                           2 * (0.25 + selected_mass_ + 1 / selected_mass_ - 2) / ((n + 2) * (n + 2) + selected_mass_));

  // (50) to (53): negative weights, scaled so that the covariance matrix stays positive definite.
  const double negative = std::min({1 + rank_one_rate_ / rank_mu_rate_, 1 + 2 * rejected_mass / (selected_mass_ + 2),
                                    (1 - rank_one_rate_ - rank_mu_rate_) / (n * rank_mu_rate_)});
  for (double& weight : weights_) weight *= weight < 0 ? negative / sums[1] : 1 / sums[0];

  normal_length_ = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));
  stalled_after_ = 10 + static_cast<std::size_t>(std::ceil(30 * n / static_cast<double>(population_)));
  const auto size = static_cast<Eigen::Index>(dimensions_);
  covariance_ = axes_ = Eigen::MatrixXd::Identity(size, size);
  lengths_ = Eigen::VectorXd::Ones(size);
  step_path_ = rank_one_path_ = Eigen::VectorXd::Zero(size);
}

const std::vector<Eigen::VectorXd>& CmaEs::Ask()
{
  RandomStream random(random_seed_, run_, StreamName("cma_es"), generation_);
  steps_.assign(population_, Eigen::VectorXd(mean_.size()));
  places_.clear();
  for (Eigen::VectorXd& step : steps_)
  {
    for (double& number : step) number = random.Gaussian();
    step = axes_ * lengths_.cwiseProduct(step);
    places_.push_back(mean_ + step_ * step);
  }
  return places_;
}

void CmaEs::Tell(std::span<const double> values)
{
  const auto n = static_cast<double>(dimensions_);
  std::vector<std::size_t> ranked(population_);
  std::iota(ranked.begin(), ranked.end(), 0);
  std::stable_sort(ranked.begin(), ranked.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  best_values_.push_back(values[ranked.front()]);
  last_spread_ = values[ranked.back()] - values[ranked.front()];
  ++generation_;

  // (41), (42): the mean moves to the weighted mean of the better half.
  Eigen::VectorXd move = Eigen::VectorXd::Zero(mean_.size());
  for (std::size_t rank = 0; rank < population_ && weights_[rank] > 0; ++rank)
    move += weights_[rank] * steps_[ranked[rank]];
  mean_ += step_ * move;

  // (43), (44): a path longer than that of random moves makes the step larger. `normal` is C^-1/2 times the move.
  const auto inverse_root = [this](const Eigen::VectorXd& vector)
  { return Eigen::VectorXd(axes_ * (axes_.transpose() * vector).cwiseQuotient(lengths_)); };
  step_path_ = (1 - step_path_rate_) * step_path_ +
               std::sqrt(step_path_rate_ * (2 - step_path_rate_) * selected_mass_) * inverse_root(move);
  const double length = step_path_.norm();

  // (45): the path of the rank-one update pauses while the step grows quickly.
  const double memory = 1 - std::pow(1 - step_path_rate_, 2 * static_cast<double>(generation_));
  const bool is_steady = length / std::sqrt(memory) < (1.4 + 2 / (n + 1)) * normal_length_;
  rank_one_path_ *= 1 - rank_one_path_rate_;
  if (is_steady) rank_one_path_ += std::sqrt(rank_one_path_rate_ * (2 - rank_one_path_rate_) * selected_mass_) * move;

  // (46), (47): the covariance matrix.
  const double lost = is_steady ? 0 : rank_one_path_rate_ * (2 - rank_one_path_rate_);
  const double all_weights = std::accumulate(weights_.begin(), weights_.end(), 0.0);
  covariance_ *= 1 + rank_one_rate_ * lost - rank_one_rate_ - rank_mu_rate_ * all_weights;
  covariance_ += rank_one_rate_ * rank_one_path_ * rank_one_path_.transpose();
  for (std::size_t rank = 0; rank < population_; ++rank)
  {
    const Eigen::VectorXd& step = steps_[ranked[rank]];
    double weight = weights_[rank];
    if (weight < 0) weight *= n / std::max(inverse_root(step).squaredNorm(), 1e-300);
    covariance_ += rank_mu_rate_ * weight * step * step.transpose();
  }
  step_ *= std::exp(std::min(1.0, step_path_rate_ / step_damping_ * (length / normal_length_ - 1)));

  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> decomposition(covariance_);
  axes_ = decomposition.eigenvectors();
  lengths_ = decomposition.eigenvalues().cwiseMax(1e-300).cwiseSqrt();
}

double CmaEs::Deviation() const { return step_ * std::sqrt(covariance_.diagonal().maxCoeff()); }

bool CmaEs::HasStalled() const
{
  if (lengths_.maxCoeff() > kLargestCondition * lengths_.minCoeff()) return true;
  if (best_values_.size() < stalled_after_ || last_spread_ > kLeastSpread) return false;
  const auto [least, most] =
      std::minmax_element(best_values_.end() - static_cast<std::ptrdiff_t>(stalled_after_), best_values_.end());
  return *most - *least <= kLeastSpread;
}

}  // namespace swarmanoid
