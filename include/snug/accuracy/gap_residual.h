#ifndef snug_accuracy_gap_residual_h
#define snug_accuracy_gap_residual_h

#include <snug/response/pressure_measures.h>
#include <snug/state/state_solver.h>

namespace snug::accuracy {
/**
 * What contact rows miss between their nodes: at Gauss points of the slave faces of this rank
 *   d = g - n . (u_h(x) - u_h(y)) [length],
 * g the gap of the true surfaces from x along the normal n of the master to y. Below 0 bodies
 * overlap there.
 */
template <int dim>
class GapResidual
{
public:
  /// References must outlive this. Collective.
  GapResidual(const state::StateSolver<dim> &solver, const state::ContactState<dim> &state);

  /// int q d dA of the cells of this rank, q of the given values per contact row, over all
  /// slave faces. Points beyond the end of the master side do not count.
  std::vector<double> integral(const std::vector<double> &of_rows) const;

  /// What the forces of the rows do on a displacement @p v of the local nodes, less what
  /// their pressures do between the rows, too:
  ///   sum_i force_i c_i . v - int p n . [v] dA  [force length],
  /// c_i the coefficients of row i. Equal on all ranks. Collective.
  double excess_work(const std::vector<state::ContactPoint>    &rows,
                     const typename mesh::BodyMesh<dim>::Field &v) const;

  /// q dA and dA at all points, by named pairs, on all ranks. Collective.
  std::vector<response::PressureRows> pressures(const std::vector<double> &of_rows) const;

  /// Of the slave faces of a pair, at their nodes, the least d of any of their points; infinite at
  /// other nodes of the surface. Equal on all ranks. Collective.
  std::vector<double> least(unsigned int pair) const;

private:
  struct Point
  {
    unsigned int                                 pair, named, cell; ///< joined and named pair
    std::vector<std::pair<unsigned int, double>> shape;             ///< surface nodes, values
    double                                       area; ///< of the true surface [length^2]
    double                                       residual;
    contact::PointGap<dim>                       gap;
  };

  const state::StateSolver<dim>     &solver;
  typename mesh::Surface<dim>::Field positions; ///< of the surface
  std::vector<Point>                 points;

  double              jump(const Point &point, const typename mesh::Surface<dim>::Field &v) const;
  std::vector<double> values(const std::vector<double> &of_rows) const;
};
} // namespace snug::accuracy

#endif
