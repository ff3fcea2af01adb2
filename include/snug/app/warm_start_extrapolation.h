#ifndef snug_app_warm_start_extrapolation_h
#define snug_app_warm_start_extrapolation_h

#include <snug/qp/solver.h>

#include <deque>
#include <string>
#include <vector>

namespace snug::app {
/**
 * Where the solver begins at a new design: contact and gluing forces
 * extrapolated from those of earlier designs,
 * @f[ \lambda(x) \approx \sum_j c_j \lambda(x_j), \quad \sum_j c_j = 1, @f]
 * with the c of least
 * @f$ |x - \sum_j c_j x_j|^2 + \sum_j c_j^2 (|x_j - x|^2 + \tau)^2 @f$,
 * in units of each variable: the first term is what a linear
 * model misses, the second bounds its curvature, so that far designs count
 * little, and what solutions are known to, @f$\tau = 10^{-6}@f$. One design is a warm start from
 * it, two a secant.
 */
class WarmStartExtrapolation
{
public:
  /// @p units of the variables: changes of equal effect, positive.
  explicit WarmStartExtrapolation(std::vector<double> units);

  /// Per load case, of this rank's rows; none without earlier designs, then
  /// the start is cold.
  std::vector<qp::WarmStart> at(const std::vector<double> &design) const;

  /// Add the solution of a design: for each load case its contact @p forces, n_owned x 1. Removes
  /// the oldest design if there are many.
  void add(const std::vector<double> &design, std::vector<qp::MultiVector> forces);

  void clear() { entries.clear(); }

  /// For a restart, bit for bit.
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
