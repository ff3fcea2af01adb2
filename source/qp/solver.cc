#include <snug/base/entries.h>
#include <snug/qp/active_set.h>
#include <snug/qp/smalse.h>

namespace snug::qp {
void SolverParameters::declare(Entries &entries)
{
  entries.add("Method", method, choice(names(solver_table())),
              "Solver of the dual quadratic program.");
  entries.add("Maximum F-mults", max_iterations, at_least(1),
              "Largest number of applications of the dual operator in one solve; a state that "
              "needs more is an error.");
}

const ChoiceTable<std::unique_ptr<Solver>(const SolverParameters &)> &solver_table()
{
  static const ChoiceTable<std::unique_ptr<Solver>(const SolverParameters &)> table = {
    {"active set",
     "inexact primal-dual active set with conjugate gradients; about twice a linear solve, one "
     "when started from a near solution",
     [](const SolverParameters &parameters) { return std::make_unique<ActiveSet>(parameters); }},
    {"SMALSE-M",
     "augmented Lagrangians with projected conjugate gradients; 2 to 4 times as much work, but "
     "with a proof of convergence",
     [](const SolverParameters &parameters) { return std::make_unique<Smalse>(parameters); }}};
  return table;
}
} // namespace snug::qp
