#include <snug/qp/active_set.h>
#include <snug/qp/smalse.h>

namespace snug::qp {
const ChoiceTable<std::unique_ptr<Solver>(const SolverParameters &)> &solver_table()
{
  static const ChoiceTable<std::unique_ptr<Solver>(const SolverParameters &)> table = {
    {"active set",
     "inexact primal-dual active set with conjugate gradients; about "
     "twice a linear solve, one when started from a near solution",
     [](const SolverParameters &parameters) { return std::make_unique<ActiveSet>(parameters); }},
    {"SMALSE-M",
     "augmented Lagrangians with projected conjugate gradients; 2 to 4 "
     "times as much work, but with a proof of convergence",
     [](const SolverParameters &parameters) { return std::make_unique<Smalse>(parameters); }}};
  return table;
}
} // namespace snug::qp
