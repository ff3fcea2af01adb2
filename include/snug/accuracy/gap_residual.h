#ifndef snug_accuracy_gap_residual_h
#define snug_accuracy_gap_residual_h

#include <snug/response/pressure_measures.h>
#include <snug/state/state_solver.h>

namespace snug::accuracy {
/**
 * The residual of the contact conditions between the nodes: at Gauss points of the slave faces of
 * this rank
 *   d = g - n . (u_h(x) - u_h(y)) [length],
 * where g is the gap of the true surfaces from x along the normal n of the master to y. The bodies
 * overlap where d < 0.
 */
template <int dim>
class GapResidual
{
public:
  /// References must outlive this object. Collective.
  GapResidual(const state::StateSolver<dim> &solver, const state::ContactState<dim> &state);

  /// Return int q d dA over the slave faces, per cell of this rank. q interpolates the given
  /// values per contact row. Points beyond the end of the master side are left out.
  std::vector<double> integral(const std::vector<double> &of_rows) const;

  /// Return the work of the forces of the rows on a displacement @p v of the local nodes, minus
  /// the work of the pressures between the rows:
  ///   sum_i force_i c_i . v - int p n . [v] dA  [force length],
  /// with the coefficients c_i of row i. Equal on all ranks. Collective.
  double excess_work(const std::vector<state::ContactPoint> &rows, const mesh::Field<dim> &v) const;

  /// Return q dA and dA at all points of all ranks, per named pair. Collective.
  std::vector<response::PressureRows> pressures(const std::vector<double> &of_rows) const;

  /// Return, per surface node, the minimum d over all points of the slave faces of a pair at the
  /// node; infinite at all other nodes. Equal on all ranks. Collective.
  std::vector<double> least(unsigned int pair) const;

private:
  struct Point
  {
    unsigned int pair, named, cell;                     ///< joined pair, named pair, cell
    std::vector<std::pair<unsigned int, double>> shape; ///< surface nodes and shape values
    double                                       area;  ///< of the true surface [length^2]
    double                                       residual;
    contact::PointGap<dim>                       gap;
  };

  const state::StateSolver<dim>     &solver;
  unsigned int                       load_case;
  typename mesh::Surface<dim>::Field positions; ///< positions of the surface nodes
  std::vector<Point>                 points;

  double              jump(const Point &point, const typename mesh::Surface<dim>::Field &v) const;
  std::vector<double> values(const std::vector<double> &of_rows) const;
};
} // namespace snug::accuracy

#endif
