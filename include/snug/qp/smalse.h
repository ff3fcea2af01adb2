#ifndef snug_qp_smalse_h
#define snug_qp_smalse_h

#include <snug/qp/solver.h>

namespace snug::qp {
/**
 * SMALSE-M: semimonotonic augmented Lagrangians for separable bounds and equalities. The balancing
 * parameter M is adapted. The penalty is @f$\varrho = 10 \|P F P\|@f$ and is raised only if the
 * infeasibility falls too slowly. Mprgp solves the inner problems. The norm comes from ten power
 * steps, one F-mult each. The method is slower than ActiveSet but has a proof of convergence.
 *
 * Source: Dostál, Kozubek, Sadowská, Vondrák, Scalable Algorithms for Contact Problems, Springer
 * (2017).
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
