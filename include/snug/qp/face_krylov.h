#ifndef snug_qp_face_krylov_h
#define snug_qp_face_krylov_h

#include <snug/qp/pcpg.h>
#include <snug/qp/projected_gcr.h>

#include <optional>

namespace snug::qp {
/// The Krylov method of a face: Pcpg, or ProjectedGcr where contacts slip on any rank, because the
/// operator is then not symmetric.
class FaceKrylov
{
public:
  /// Store the references; problem and face must outlive this object. Pcpg begins with the part of
  /// conjugate directions @p known that lies in the face, and ProjectedGcr recalls all of @p known.
  /// For @p deflates see both methods. Collective.
  FaceKrylov(const DualProblem    &problem,
             const FreeSet        &free_set,
             const DirectionBasis &known    = DirectionBasis(),
             bool                  deflates = true);

  /// Solve on the face, see Pcpg::solve() and ProjectedGcr::solve(). Collective.
  KrylovResult solve(MultiVector               &lambda,
                     MultiVector               &residual,
                     const std::vector<double> &tolerances,
                     unsigned int               max_iterations);

  /// Return the directions so far. No more can be solved afterwards.
  DirectionBasis release_directions()
  {
    return cg ? cg->release_directions() : gcr->release_directions();
  }

private:
  std::optional<Pcpg>         cg;
  std::optional<ProjectedGcr> gcr;
};
} // namespace snug::qp

#endif
