#include <snug/base/gather.h>
#include <snug/contact/nearest_face.h>
#include <snug/elasticity/stress.h>
#include <snug/state/peaks.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace snug::state {
namespace {
/// Relative difference of stresses, or of displacements, below which their difference may be the
/// error of the solver.
const double tie = 1e-6;

/// Return the place of @p x along a direction that no symmetry of a model is likely to reverse.
template <int dim>
double order(const dealii::Tensor<1, dim> &x)
{
  return x[0] + 0.71 * x[1] + (dim == 3 ? 0.43 * x[dim - 1] : 0.);
}

/// A Gauss point with its volume, its stress and its yield stress; 0: none.
template <int dim>
struct StressPoint
{
  double                 von_mises, yield_stress, dV;
  dealii::Tensor<1, dim> place;
};

/// Return the Gauss points of this rank, per body, whose stresses may be the largest or that have a
/// yield stress.
template <int dim>
std::vector<std::vector<StressPoint<dim>>> stress_points(const StateSolver<dim>  &solver,
                                                         const ContactState<dim> &state)
{
  std::vector<std::vector<StressPoint<dim>>> result(solver.model().bodies.size());
  std::vector<double>                        largest(result.size(), 0.);
  for (unsigned int s = 0; s < solver.assemblers().size(); ++s)
    {
      const auto &assembler = *solver.assemblers()[s];
      if (assembler.is_point())
        continue;
      const unsigned int body = solver.tearing().subdomains[s].body;
      for (unsigned int i = 0; i < assembler.n_pieces(); ++i)
        {
          const auto  X        = assembler.piece_field(i, state.positions);
          const auto &shapes   = assembler.piece_points(i);
          const auto &material = assembler.material(assembler.cell_of_piece(i));
          const auto  stresses =
            assembler.element().stresses(X, material,
                                         assembler.piece_values(i, state.u[s].column(0)), shapes,
                                         assembler.piece_strain(i, state.load_case));
          for (unsigned int q = 0; q < shapes.size(); ++q)
            {
              const double von_mises = elasticity::von_mises(stresses[q]);
              largest[body]          = std::max(largest[body], von_mises);
              // All points of a fine mesh would be a large part of its memory.
              if (material.yield_stress == 0. && von_mises < (1. - tie) * largest[body])
                continue;
              result[body].push_back(
                {von_mises, material.yield_stress,
                 elasticity::CellPoint<dim>(shapes[q], X, solver.mesh().idealization()).dV,
                 elasticity::value<dim>(shapes[q], X)});
            }
        }
    }
  return result;
}

/// Compare the stresses at the @p points of a body with the yield stresses. Collective.
template <int dim>
YieldCheck yield_check(const StateSolver<dim>              &solver,
                       const ContactState<dim>             &state,
                       const unsigned int                   body,
                       const std::vector<StressPoint<dim>> &points)
{
  YieldCheck result;
  for (const auto &material : solver.model().bodies[body].materials)
    if (material.yield_stress > 0. &&
        (result.yield_stress == 0. || material.yield_stress < result.yield_stress))
      result.yield_stress = material.yield_stress;
  if (result.yield_stress == 0.)
    return result;
  const faces::FaceShape<dim> shape(solver.mesh().degree());
  std::vector<unsigned int>   of_body;
  for (unsigned int face = 0; face < solver.surface().faces().size(); ++face)
    if (solver.surface().faces()[face].body == body)
      of_body.push_back(face);
  std::optional<contact::NearestFace<dim>> faces;
  if (!of_body.empty())
    faces.emplace(solver.surface(), of_body, shape, state.surface_positions);
  for (const auto &point : points)
    if (point.yield_stress > 0.)
      {
        const double utilization = point.von_mises / point.yield_stress;
        result.utilization       = std::max(result.utilization, utilization);
        if (utilization <= 1.)
          continue;
        result.volume += point.dV;
        if (faces)
          result.depth =
            std::max(result.depth, std::sqrt(faces->closest(point.place).point.squared_distance));
      }
  const MPI_Comm communicator = solver.context().communicator();
  result.utilization          = dealii::Utilities::MPI::max(result.utilization, communicator);
  result.volume               = dealii::Utilities::MPI::sum(result.volume, communicator);
  result.depth                = faces ? dealii::Utilities::MPI::max(result.depth, communicator)
                                      : std::numeric_limits<double>::quiet_NaN();
  const auto &pairs           = solver.contact(state.load_case).named_pairs();
  for (unsigned int p = 0; p < pairs.size(); ++p)
    if (pairs[p].slave.body() == body || (!pairs[p].obstacle && pairs[p].master.body() == body))
      result.pressure_over_shear =
        std::max(result.pressure_over_shear,
                 std::sqrt(3.) * state.pairs[p].max_pressure / result.yield_stress);
  return result;
}
} // namespace

template <int dim>
std::vector<StressPeak<dim>> stress_peaks(const StateSolver<dim>  &solver,
                                          const ContactState<dim> &state)
{
  const MPI_Comm               communicator = solver.context().communicator();
  const auto                   points       = stress_points(solver, state);
  std::vector<double>          largest(points.size(), 0.);
  std::vector<StressPeak<dim>> result(points.size());
  for (unsigned int body = 0; body < points.size(); ++body)
    for (const auto &point : points[body])
      largest[body] = std::max(largest[body], point.von_mises);
  dealii::Utilities::MPI::max(largest, communicator, largest);
  // A peak without a body stands for a rank without such a point.
  const auto take = [](StressPeak<dim> &peak, const StressPeak<dim> &other) {
    if (peak.body.empty() ||
        (!other.body.empty() && order<dim>(other.place) < order<dim>(peak.place)))
      peak = other;
  };
  for (unsigned int body = 0; body < points.size(); ++body)
    for (const auto &point : points[body])
      if (point.von_mises >= (1. - tie) * largest[body])
        take(result[body], {solver.model().body_names[body], largest[body], point.place});
  for (const auto &of_rank : all_gather(communicator, result))
    for (unsigned int body = 0; body < points.size(); ++body)
      take(result[body], of_rank[body]);
  for (unsigned int body = 0; body < points.size(); ++body)
    result[body].yield = yield_check(solver, state, body, points[body]);
  return result;
}

template <int dim>
DisplacementPeak<dim> displacement_peak(const ContactState<dim> &state, MPI_Comm communicator)
{
  double extent = 0., largest = 0.;
  for (unsigned int node = 0; node < state.displacement.size(); ++node)
    {
      extent  = std::max(extent, state.positions[node].norm());
      largest = std::max(largest, state.displacement[node].norm());
    }
  extent  = dealii::Utilities::MPI::max(extent, communicator);
  largest = dealii::Utilities::MPI::max(largest, communicator);
  DisplacementPeak<dim> result;
  result.size     = -1.; // of a rank without such a node
  const auto take = [&](const DisplacementPeak<dim> &other) {
    if (other.size > result.size ||
        (other.size == result.size && order<dim>(other.position) < order<dim>(result.position)))
      result = other;
  };
  for (unsigned int node = 0; node < state.displacement.size(); ++node)
    if (state.displacement[node].norm() >= (1. - tie) * largest)
      take({largest, extent, state.displacement[node], state.positions[node]});
  for (const auto &other : all_gather(communicator, result))
    take(other);
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                    \
  template std::vector<StressPeak<dim>> stress_peaks(const StateSolver<dim> &,   \
                                                     const ContactState<dim> &); \
  template DisplacementPeak<dim>        displacement_peak(const ContactState<dim> &, MPI_Comm);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::state
