#ifndef snug_app_warm_start_extrapolation_h
#define snug_app_warm_start_extrapolation_h

#include <snug/qp/solver.h>

#include <deque>
#include <string>
#include <vector>

namespace snug::app {
/**
 * This class extrapolates contact and gluing forces, from which the solver begins at a new design,
 * from the forces of earlier designs,
 * @f[ \lambda(x) \approx \sum_j c_j \lambda(x_j), \quad \sum_j c_j = 1, @f]
 * where c minimizes
 * @f$ |x - \sum_j c_j x_j|^2 + \sum_j c_j^2 (|x_j - x|^2 + \tau)^2 @f$,
 * in units of each variable. The first term measures the distance to the designs that the linear
 * model represents. The second term bounds the curvature that the model neglects, so that far
 * designs have small factors, and contains the accuracy @f$\tau = 10^{-6}@f$ of the forces. With
 * one design the result is its forces, with two designs a secant.
 */
class WarmStartExtrapolation
{
public:
  /// Set the @p units of the variables, positive changes that have about equal effects.
  explicit WarmStartExtrapolation(std::vector<double> units);

  /// Return the start of each load case with the rows of this rank. The result is empty, for a cold
  /// start, if there are no earlier designs.
  std::vector<qp::WarmStart> at(const std::vector<double> &design) const;

  /// Add the solution of a design: for each load case its contact @p forces, n_owned x 1. Remove
  /// the oldest design if there are many.
  void add(const std::vector<double> &design, std::vector<qp::MultiVector> forces);

  void clear() { entries.clear(); }

  /// Return the history as bytes, from which read() restores it bit for bit.
  std::string bytes() const;

  /// Restore the history from the result of bytes(), with @p n_owned rows per load case. Return
  /// false, with an empty history, if the sizes do not fit.
  bool read(const std::string &bytes, const std::vector<unsigned int> &n_owned);

private:
  struct Entry
  {
    std::vector<double>          design;
    std::vector<qp::MultiVector> forces; ///< per load case
  };

  std::vector<double> coefficients(const std::vector<double> &design) const;

  std::vector<double> units;
  std::deque<Entry>   entries; ///< the newest last
};
} // namespace snug::app

#endif
