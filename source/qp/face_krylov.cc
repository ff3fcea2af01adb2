#include <snug/qp/face_krylov.h>
#include <snug/qp/row_set.h>

namespace snug::qp {
FaceKrylov::FaceKrylov(const DualProblem    &problem,
                       const FreeSet        &free_set,
                       const DirectionBasis &known,
                       const bool            deflates)
{
  if (free_set.has_slips())
    gcr.emplace(problem, free_set, known, deflates);
  else
    cg.emplace(problem, free_set,
               known.is_conjugate ? known.off(complement(free_set.free_rows().rows()),
                                              problem.context().communicator())
                                  : DirectionBasis(),
               deflates);
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
