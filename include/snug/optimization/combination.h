#ifndef snug_optimization_combination_h
#define snug_optimization_combination_h

#include <string>
#include <vector>

namespace snug::optimization {
/**
 * This struct describes a function J of the values J_c of a response in several load cases, with
 * their weights w_c:
 *
 * | kind      | J                                                    |
 * |-----------|------------------------------------------------------|
 * | sum       | sum_c w_c J_c                                        |
 * | mean      | m = sum_c w_c J_c / sum_c w_c                        |
 * | worst     | max_c w_c J_c                                        |
 * | range     | max_c w_c J_c - min_c w_c J_c                        |
 * | deviation | m' + k (sum_c w_c (J_c - m)^2 / sum_c w_c)^(1/2)     |
 *
 * where m' is m if `with_mean`, else 0. The weights of mean and deviation are probabilities. worst
 * and range are exact: DesignProblem::maxima leaves their maxima to the optimizer.
 */
struct Combination
{
  enum class Kind
  {
    sum,
    mean,
    worst,
    range,
    deviation
  };

  Kind   kind       = Kind::sum;
  bool   with_mean  = false;
  double deviations = 1.; ///< k

  /// Return the number of maxima of which J consists: 1 of worst, 2 of range, else 0.
  unsigned int n_maxima() const { return kind == Kind::worst ? 1 : kind == Kind::range ? 2 : 0; }

  /// Return "sum", "mean", "worst", "range", "deviation", "2 deviation" or "mean + 2 deviation".
  std::string text() const;

  /// Return the combination of such a text. @throws std::invalid_argument
  static Combination read(const std::string &text);

  /// @name For entries of the parameter file
  /// @{
  friend std::string to_text(const Combination &combination) { return combination.text(); }
  friend void        from_text(const std::string &text, Combination &combination)
  {
    combination = read(text);
  }
  /// @}
};

/// This struct holds the value J and the derivatives dJ / dJ_c. Where a maximum is reached in
/// several load cases, the derivative is that of the first of them.
struct Combined
{
  double              value = 0.;
  std::vector<double> factors;
};

/// Return the combination of @p values with @p weights, one per load case.
Combined combined(const Combination         &combination,
                  const std::vector<double> &values,
                  const std::vector<double> &weights);
} // namespace snug::optimization

#endif
