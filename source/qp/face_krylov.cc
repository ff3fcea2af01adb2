#include <snug/qp/face_krylov.h>
#include <snug/qp/row_set.h>

namespace snug::qp {
FaceKrylov::FaceKrylov(const DualProblem    &problem,
                       const FreeSet        &free_set,
                       const DirectionBasis &known,
                       const bool            deflates)
{
  const MPI_Comm  comm = problem.context().communicator();
  const FreeRows &free = free_set.free_rows();
  if (any(!free.slips().empty(), comm))
    gcr.emplace(problem, free_set, deflates);
  else
    cg.emplace(problem, free_set, known.off(complement(free.rows()), comm), deflates);
}

KrylovResult FaceKrylov::solve(MultiVector               &lambda,
                               MultiVector               &residual,
                               const std::vector<double> &tolerances,
                               const unsigned int         max_iterations)
{
  return cg ? cg->solve(lambda, residual, tolerances, max_iterations)
            : gcr->solve(lambda, residual, tolerances, max_iterations);
}
} // namespace snug::qp
