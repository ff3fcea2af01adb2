#include <snug/base/entries.h>
#include <snug/qp/active_set.h>
#include <snug/qp/smalse.h>

namespace snug::qp {
void SolverParameters::declare(Entries &entries)
{
  entries.add("Method", method, choice(names(solver_table())),
              "The solver of the dual quadratic program.");
  entries.add(
    "Maximum F-mults", max_iterations, at_least(1),
    "The maximum number of applications of the dual operator F in one solve. A solve that "
    "needs more is an error.");
}

const ChoiceTable<std::unique_ptr<Solver>(const SolverParameters &)> &solver_table()
{
  static const ChoiceTable<std::unique_ptr<Solver>(const SolverParameters &)> table = {
    {"active set",
     "inexact primal-dual active set method with conjugate gradients. Its cost is about two linear "
     "solves, or one with a warm start.",
     [](const SolverParameters &parameters) { return std::make_unique<ActiveSet>(parameters); }},
    {"SMALSE-M",
     "augmented Lagrangian method with projected conjugate gradients. Its cost is 2 to 4 times "
     "that of active set; its convergence is proved.",
     [](const SolverParameters &parameters) { return std::make_unique<Smalse>(parameters); }}};
  return table;
}
} // namespace snug::qp
