#include <snug/base/values.h>
#include <snug/elasticity/cell_point.h>
#include <snug/response/measured_place.h>
#include <snug/state/cell_gradients.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace snug::response {
namespace {
template <int dim>
using Nodes = std::vector<dealii::Tensor<1, dim>>;

/// Cells contain points up to this share of their size beyond their faces. The share ensures that
/// rounding does not exclude a point on a face from both of its cells.
const double tolerance = 1e-6;

/// Points up to this share of the size of a cell outside of all bodies are moved onto the cell:
/// they may lie on the true surface of a body, outside of its mesh.
const double largest_move = 0.1;

/// A point of a cell, or close to it.
struct PointOfCell
{
  std::vector<double> values;   ///< shape functions of the cell
  double              distance; ///< beyond the faces of the cell, as a share of its size
};

/// Return whether the cell with nodes @p X may contain @p point. Curved cells extend beyond
/// the box of their nodes.
template <int dim>
bool is_near(const Nodes<dim> &X, const dealii::Tensor<1, dim> &point)
{
  // margin relative to the size of the box, in each direction
  const double margin = 0.25;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const auto [low, high] =
        std::minmax_element(X.begin(), X.end(),
                            [d](const auto &a, const auto &b) { return a[d] < b[d]; });
      // Compare with the box first, because Newton's method in all cells would cost far more.
      const double size = (*high)[d] - (*low)[d];
      if (point[d] < (*low)[d] - margin * size || point[d] > (*high)[d] + margin * size)
        return false;
    }
  return true;
}

/// Return the point of the cell with nodes @p X that is next to @p point in the coordinates of the
/// cell, computed by Newton's method. Return nothing if the point lies outside.
template <int dim>
std::optional<PointOfCell>
point_of_cell(const unsigned int degree, const Nodes<dim> &X, const dealii::Tensor<1, dim> &point)
{
  dealii::Point<dim> xi;
  for (unsigned int d = 0; d < dim; ++d)
    xi[d] = 0.5;
  // Newton's method converges at once in parallelepipeds and within a few steps in slightly
  // curved cells.
  for (unsigned int step = 0; step < 20; ++step)
    {
      const auto shape = mesh::lagrange_point<dim>(degree, xi);
      const auto J     = elasticity::jacobian(shape, X);
      // The negated comparison includes NaN: such an iterate has left the cell.
      if (!(std::abs(determinant(J)) > 0.))
        return {};
      const dealii::Tensor<1, dim> move = invert(J) * (point - elasticity::value(shape, X));
      if (move.norm() < 1e-12)
        {
          auto nearest = xi;
          for (unsigned int d = 0; d < dim; ++d)
            nearest[d] = std::clamp(xi[d], 0., 1.);
          const double distance = nearest.distance(xi);
          if (distance > largest_move)
            return {};
          if (distance <= tolerance)
            return PointOfCell{shape.value, 0.};
          return PointOfCell{mesh::lagrange_point<dim>(degree, nearest).value, distance};
        }
      xi += move;
      // Newton's method diverges for points far outside. The negated comparison includes NaN.
      if (!(xi.norm() < 10.))
        return {};
    }
  return {};
}

/// Throw unless exactly one body contains the point, or none does and one is close, because
/// displacements of touching bodies differ. @p distances are those of the point from the bodies.
void require_one_body(const ResponseParameters       &parameters,
                      const std::vector<std::string> &names,
                      const std::vector<double>      &distances)
{
  std::string  bodies;
  unsigned int n     = 0;
  const double least = *std::min_element(distances.begin(), distances.end());
  for (unsigned int b = 0; b < distances.size(); ++b)
    if (distances[b] <= (least == 0. ? 0. : largest_move))
      {
        bodies += (bodies.empty() ? "" : ", ") + names[b];
        ++n;
      }
  if (n == 0)
    throw bad_entry(parameters.path("Point"), to_text(parameters.point),
                    "lies outside the bodies by more than a tenth of a cell");
  if (n > 1)
    throw bad_entry(parameters.path("Point"), to_text(parameters.point),
                    "lies in the bodies " + bodies + ": name one with 'Body'");
}
} // namespace

template <int dim>
dealii::Tensor<1, dim> unit_vector(const ResponseParameters &parameters)
{
  const auto c = static_cast<unsigned int>(parameters.component) - 1; // of x, y, z
  if (c >= dim)
    throw bad_entry(parameters.path("Component"), to_text(parameters.component),
                    dim == 2 ? "must be x or y" : "must be x, y or z");
  return dealii::Point<dim>::unit_vector(c);
}

template <int dim>
supports::Component<dim> component_of(const state::StateSolver<dim> &solver,
                                      const ResponseParameters      &parameters)
{
  const auto  c    = static_cast<unsigned int>(parameters.component); // of normal, x, y, z, radial
  const auto &body = solver.model().bodies[find_boundary(solver, parameters).first];
  if (c > 3 && solver.mesh().idealization().is_axisymmetric())
    throw bad_entry(parameters.path("Component"), to_text(parameters.component),
                    "must be x, y or normal for Model = axisymmetric");
  return {c == 0 ? dim : c <= 3 ? c - 1 : c - 3 + dim, body.axis};
}

template <int dim>
dealii::Tensor<1, 3> axis_of(const ResponseParameters &parameters)
{
  const auto c = static_cast<unsigned int>(parameters.component) - 1; // of x, y, z
  if (c > 2 || (dim == 2 && c != 2))
    throw bad_entry(parameters.path("Component"), to_text(parameters.component),
                    dim == 2 ? "must be z, the axis" : "must be x, y or z, the axis");
  return dealii::Point<3>::unit_vector(c);
}

template <int dim>
std::pair<unsigned int, unsigned int> find_boundary(const state::StateSolver<dim> &solver,
                                                    const ResponseParameters      &parameters)
{
  const auto &bodies = solver.model().body_names;
  for (unsigned int body = 0; body < bodies.size(); ++body)
    {
      const auto names = solver.mesh().geometry(body).boundary_names();
      for (unsigned int boundary = 0; boundary < names.size(); ++boundary)
        // Names are compared literally, because the geometry of the body defines the names of
        // its faces.
        if (parameters.face == bodies[body] + "." + names[boundary])
          return {body, boundary};
    }
  throw bad_entry(parameters.path("Face"), parameters.face, "there is no such face");
}

template <int dim>
std::vector<CellWeights> find_point(const state::StateSolver<dim> &solver,
                                    const ResponseParameters      &parameters)
{
  const auto            &mesh = solver.mesh();
  const MPI_Comm         comm = solver.context().communicator();
  dealii::Tensor<1, dim> x;
  for (unsigned int c = 0; c < dim; ++c)
    x[c] = parameters.point[c];
  const double             far = std::numeric_limits<double>::max();
  std::vector<CellWeights> found;
  double                   distance = far;
  std::vector<double>      distances(mesh.n_bodies(), far);
  const auto               look = [&](unsigned int s, unsigned int i) {
    const auto &assembler = *solver.assemblers()[s];
    // Use reference positions, so that the point is the same material point in every design.
    const auto X = assembler.cell_field(i, mesh.reference_positions());
    if (!is_near<dim>(X, x))
      return;
    const auto point = point_of_cell<dim>(mesh.degree(), X, x);
    if (!point)
      return;
    double &of_body = distances[mesh.cells()[assembler.cells()[i]].body];
    of_body         = std::min(of_body, point->distance);
    if (point->distance < distance)
      {
        distance = point->distance;
        found    = {{s, i, point->values}};
      }
  };
  state::for_each_cell<dim>(solver, parameters.body, look);
  dealii::Utilities::MPI::min(distances, comm, distances);
  require_one_body(parameters, solver.model().body_names, distances);
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
  const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(comm);
  const double       least   = *std::min_element(distances.begin(), distances.end());
  if (least > 0.)
    solver.context().warn({"point",
                           "'" + parameters.path("Point") + "' = '" + to_text(parameters.point) +
                             "' lies outside of the bodies and is moved onto the nearest cell",
                           least, 0.});
  // Cells of several ranks may be equally close to the point, so only the lowest rank counts it.
  const bool is_closest = distance == least;
  if (dealii::Utilities::MPI::min(is_closest ? rank : n_ranks, comm) != rank)
    found.clear();
  return found;
}

#define SNUG_INSTANTIATE(dim)                                                                   \
  template dealii::Tensor<1, dim>                unit_vector(const ResponseParameters &);       \
  template dealii::Tensor<1, 3>                  axis_of<dim>(const ResponseParameters &);      \
  template supports::Component<dim>              component_of(const state::StateSolver<dim> &,  \
                                                              const ResponseParameters &);      \
  template std::pair<unsigned int, unsigned int> find_boundary(const state::StateSolver<dim> &, \
                                                               const ResponseParameters &);     \
  template std::vector<CellWeights>              find_point(const state::StateSolver<dim> &,    \
                                                            const ResponseParameters &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::response
