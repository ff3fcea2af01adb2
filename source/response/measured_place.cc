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

/// Cells reach this part of their size beyond their faces.
const double tolerance = 1e-6;

/// Whether the cell with nodes @p X may hold @p point: curved ones reach
/// beyond the box of their nodes.
template <int dim>
bool is_near(const Nodes<dim> &X, const dealii::Tensor<1, dim> &point)
{
  // A part of the box of the nodes, in each direction.
  const double margin = 0.25;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const auto [low, high] =
        std::minmax_element(X.begin(), X.end(),
                            [d](const auto &a, const auto &b) { return a[d] < b[d]; });
      // Newton's method in all cells would cost far more than these comparisons.
      const double size = (*high)[d] - (*low)[d];
      if (point[d] < (*low)[d] - margin * size || point[d] > (*high)[d] + margin * size)
        return false;
    }
  return true;
}

/// Shape functions of the cell with nodes @p X at @p point, by Newton's
/// method; none if it lies outside.
template <int dim>
std::optional<std::vector<double>>
shape_values(const unsigned int degree, const Nodes<dim> &X, const dealii::Tensor<1, dim> &point)
{
  dealii::Point<dim> xi;
  for (unsigned int d = 0; d < dim; ++d)
    xi[d] = 0.5;
  // Converges at once in parallelepipeds and within a few steps in cells that are curved a little.
  for (unsigned int step = 0; step < 20; ++step)
    {
      const auto shape = mesh::lagrange_point<dim>(degree, xi);
      const auto J     = elasticity::jacobian(shape, X);
      // NaN included: such an iterate has left the cell.
      if (!(std::abs(determinant(J)) > 0.))
        return {};
      const dealii::Tensor<1, dim> move = invert(J) * (point - elasticity::value(shape, X));
      if (move.norm() < 1e-12)
        {
          for (unsigned int d = 0; d < dim; ++d)
            // A point on a face between cells must not fall between them by round-off.
            if (xi[d] < -tolerance || xi[d] > 1. + tolerance)
              return {};
          return shape.value;
        }
      xi += move;
      // Points far outside send Newton's method away; NaN ends it as well.
      if (!(xi.norm() < 10.))
        return {};
    }
  return {};
}

/// Throw unless exactly one body holds the point: where bodies touch, their displacements differ.
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
std::pair<unsigned int, unsigned int> find_boundary(const state::StateSolver<dim> &solver,
                                                    const ResponseParameters      &parameters)
{
  const auto &bodies = solver.model().body_names;
  for (unsigned int body = 0; body < bodies.size(); ++body)
    {
      const auto names = solver.mesh().geometry(body).boundary_names();
      for (unsigned int boundary = 0; boundary < names.size(); ++boundary)
        // Names are compared as written: face names belong to the geometry of the body.
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
    // In the reference: the same material point in every design.
    const auto X = assembler.cell_field(i, mesh.reference_positions());
    if (!is_near<dim>(X, x))
      return;
    const auto weights = shape_values<dim>(mesh.degree(), X, x);
    if (!weights)
      return;
    // Each body once, though several of its cells may hold the point.
    holds[mesh.cells()[assembler.cells()[i]].body] = 1;
    if (found.empty())
      found.push_back({s, i, *weights});
  };
  state::for_each_cell<dim>(solver, parameters.body, look);
  dealii::Utilities::MPI::max(holds, comm, holds);
  require_one_body(parameters, solver.model().body_names, holds);
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
  const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(comm);
  // Cells of several ranks meet at the point: only the lowest rank counts it.
  if (dealii::Utilities::MPI::min(found.empty() ? n_ranks : rank, comm) != rank)
    found.clear();
  return found;
}

#define SNUG_INSTANTIATE(dim)                                                                   \
  template dealii::Tensor<1, dim>                unit_vector(const ResponseParameters &);       \
  template std::pair<unsigned int, unsigned int> find_boundary(const state::StateSolver<dim> &, \
                                                               const ResponseParameters &);     \
  template std::vector<CellWeights>              find_point(const state::StateSolver<dim> &,    \
                                                            const ResponseParameters &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::response
