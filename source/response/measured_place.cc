#include <snug/base/values.h>
#include <snug/elasticity/cell_point.h>
#include <snug/response/measured_place.h>
#include <snug/state/cell_gradients.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace snug::response {
namespace {
template <int dim>
using Nodes = std::vector<dealii::Tensor<1, dim>>;

/// Cells contain points up to this share of their size beyond their faces.
const double tolerance = 1e-6;

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

/// Return the shape functions of the cell with nodes @p X at @p point, computed by Newton's
/// method. Return nothing if the point lies outside.
template <int dim>
std::optional<std::vector<double>>
shape_values(const unsigned int degree, const Nodes<dim> &X, const dealii::Tensor<1, dim> &point)
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
          for (unsigned int d = 0; d < dim; ++d)
            // The tolerance ensures that rounding does not exclude a point on a face from
            // both of its cells.
            if (xi[d] < -tolerance || xi[d] > 1. + tolerance)
              return {};
          return shape.value;
        }
      xi += move;
      // Newton's method diverges for points far outside. The negated comparison includes NaN.
      if (!(xi.norm() < 10.))
        return {};
    }
  return {};
}

/// Throw unless exactly one body contains the point, because displacements of touching bodies
/// differ.
void require_one_body(const ResponseParameters        &parameters,
                      const std::vector<std::string>  &names,
                      const std::vector<unsigned int> &holds)
{
  std::string bodies;
  for (unsigned int b = 0; b < holds.size(); ++b)
    if (holds[b] != 0)
      bodies += (bodies.empty() ? "" : ", ") + names[b];
  const auto n = holds.size() - std::count(holds.begin(), holds.end(), 0);
  if (n == 0)
    throw bad_entry(parameters.path("Point"), to_text(parameters.point), "lies outside the bodies");
  if (n > 1)
    throw bad_entry(parameters.path("Point"), to_text(parameters.point),
                    "lies in the bodies " + bodies + ": name one with 'Body'");
}
} // namespace

template <int dim>
dealii::Tensor<1, dim> unit_vector(const ResponseParameters &parameters)
{
  const Component component = parameters.component;
  if (component == Component::normal || (dim == 2 && component == Component::z))
    throw bad_entry(parameters.path("Component"), to_text(component),
                    dim == 2 ? "must be x or y" : "must be x, y or z");
  dealii::Tensor<1, dim> result;
  result[static_cast<unsigned int>(component) - static_cast<unsigned int>(Component::x)] = 1.;
  return result;
}

template <int dim>
dealii::Tensor<1, 3> moment_axis(const ResponseParameters &parameters)
{
  const Component component = parameters.component;
  if (component == Component::normal || (dim == 2 && component != Component::z))
    throw bad_entry(parameters.path("Component"), to_text(component),
                    dim == 2 ? "must be z, the axis of the moment"
                             : "must be x, y or z, the axis of the moment");
  dealii::Tensor<1, 3> axis;
  axis[static_cast<unsigned int>(component) - static_cast<unsigned int>(Component::x)] = 1.;
  return axis;
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
  std::vector<CellWeights>  found;
  std::vector<unsigned int> holds(mesh.n_bodies(), 0);
  const auto                look = [&](unsigned int s, unsigned int i) {
    const auto &assembler = *solver.assemblers()[s];
    // Use reference positions, so that the point is the same material point in every design.
    const auto X = assembler.cell_field(i, mesh.reference_positions());
    if (!is_near<dim>(X, x))
      return;
    const auto weights = shape_values<dim>(mesh.degree(), X, x);
    if (!weights)
      return;
    // Count each body once, even if several of its cells contain the point.
    holds[mesh.cells()[assembler.cells()[i]].body] = 1;
    if (found.empty())
      found.push_back({s, i, *weights});
  };
  state::for_each_cell<dim>(solver, parameters.body, look);
  dealii::Utilities::MPI::max(holds, comm, holds);
  require_one_body(parameters, solver.model().body_names, holds);
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
  const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(comm);
  // Cells of several ranks may contain the point, so only the lowest rank counts it.
  if (dealii::Utilities::MPI::min(found.empty() ? n_ranks : rank, comm) != rank)
    found.clear();
  return found;
}

#define SNUG_INSTANTIATE(dim)                                                                   \
  template dealii::Tensor<1, dim>                unit_vector(const ResponseParameters &);       \
  template dealii::Tensor<1, 3>                  moment_axis<dim>(const ResponseParameters &);  \
  template std::pair<unsigned int, unsigned int> find_boundary(const state::StateSolver<dim> &, \
                                                               const ResponseParameters &);     \
  template std::vector<CellWeights>              find_point(const state::StateSolver<dim> &,    \
                                                            const ResponseParameters &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::response
