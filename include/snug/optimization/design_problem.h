#ifndef snug_optimization_design_problem_h
#define snug_optimization_design_problem_h

#include <functional>
#include <vector>

namespace snug
{
  namespace optimization
  {
    /// Values and gradients at a design.
    struct Evaluation
    {
      double                           objective = 0.;
      std::vector<double>              gradient;    ///< n
      std::vector<double>              constraints; ///< m equalities c(x) = 0
      std::vector<std::vector<double>> jacobian;    ///< m rows of n
      /// active contacts, F-mults, seconds: carried into history, not used
      std::vector<double> notes;
    };

    /// min f(x), c(x) = 0, lower <= x <= upper. Vectors only.
    struct DesignProblem
    {
      std::vector<double> lower, upper, start;
      /// throws TangledMesh for designs without a value
      std::function<Evaluation(const std::vector<double> &)> evaluate;
      /// |c| is measured relative to these
      std::vector<double> constraint_scales;
    };
  } // namespace optimization
} // namespace snug

#endif
