#ifndef snug_qp_smalse_h
#define snug_qp_smalse_h

#include <snug/qp/solver.h>

namespace snug::qp {
/**
 * SMALSE-M: semimonotonic augmented Lagrangians for separable bounds and
 * equalities, with the balancing parameter M adapted and the penalty
 * @f$\varrho = 10 \|P F P\|@f$ fixed; the inner problems by Mprgp. The
 * norm comes from ten power steps, one F-mult each. Slower than ActiveSet
 * but with a proof of convergence.
 *
 * Source: Dostál, Kozubek, Sadowská, Vondrák, Scalable Algorithms for
 * Contact Problems, Springer (2017).
 */
class Smalse : public Solver
{
public:
  explicit Smalse(const SolverParameters &parameters);

  DualSolution solve(const DualProblem &problem, const WarmStart &start) const override;

private:
  SolverParameters parameters;
};
} // namespace snug::qp

#endif
