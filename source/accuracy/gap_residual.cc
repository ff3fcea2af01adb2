#include <snug/accuracy/contact_pressure.h>
#include <snug/accuracy/gap_residual.h>
#include <snug/base/gather.h>
#include <snug/faces/face_shape.h>
#include <snug/mesh/shared_nodes.h>
#include <snug/state/point_results.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <limits>

namespace snug::accuracy {
namespace {
/// Gauss points per direction. Pressures and gaps have kinks within faces that no quadrature
/// resolves.
const unsigned int n_gauss = 4;

/// Return sum_k w_k field_k.
template <int dim>
dealii::Tensor<1, dim> sum(const std::vector<std::pair<unsigned int, double>> &weights,
                           const std::vector<dealii::Tensor<1, dim>>          &field)
{
  dealii::Tensor<1, dim> result;
  for (const auto &[k, weight] : weights)
    result += weight * field[k];
  return result;
}
} // namespace

template <int dim>
GapResidual<dim>::GapResidual(const state::StateSolver<dim>  &solver,
                              const state::ContactState<dim> &state)
  : solver(solver), load_case(state.load_case), positions(state.surface_positions)
{
  const auto &mesh        = solver.mesh();
  const auto &surface     = solver.surface();
  const auto &contact     = solver.contact(load_case);
  const auto &placed      = contact.placed_surface();
  const auto  x           = placed.to_space(positions);
  const auto  held        = placed.turned(solver.held().directions(surface, state.positions));
  const auto  u           = placed.turned(state.surface_displacement);
  const auto  here        = mesh::owners_values(mesh, state.positions);
  const auto  q_of_points = state::point_motions(solver, state.u, 0);

  const faces::FaceShape<dim>   shape(mesh.degree());
  const dealii::QGauss<dim - 1> gauss(n_gauss);
  for (unsigned int p = 0; p < contact.pairs().size(); ++p)
    {
      const auto gaps = contact.point_gaps(p, x, held);
      for (const auto &face : mesh.boundary_faces())
        if (contact::is_on(face, contact.pairs()[p].slave))
          for (unsigned int q = 0; q < gauss.size(); ++q)
            {
              const auto             values     = shape.at(gauss.point(q));
              const auto             on_surface = shape.samples_at(gauss.point(q));
              Point                  point{p, 0, face.cell, {}, 0., 0., {}};
              dealii::Tensor<1, dim> place, area_vector;
              for (unsigned int k = 0; k < face.nodes.size(); ++k)
                {
                  point.shape.emplace_back(surface.find(mesh.global_node(face.nodes[k])),
                                           values.value[k]);
                  place += values.value[k] * here[face.nodes[k]];
                }
              area_vector = faces::area_vector(faces::tangents<dim>(values, face.nodes, here));
              if (!face.samples.empty())
                {
                  place = {};
                  for (unsigned int k = 0; k < face.samples.size(); ++k)
                    place += on_surface.value[k] * state.positions[face.samples[k]];
                  area_vector = faces::area_vector(
                    faces::tangents<dim>(on_surface, face.samples, state.positions));
                }
              place          = solver.motion(load_case, face.body).point(place);
              const auto gap = gaps->at(place, point.shape, {face.body, face.boundary});
              if (!gap)
                continue;
              point.area = gauss.weight(q) * mesh.idealization().weight(place) * area_vector.norm();
              point.gap  = *gap;
              point.named = gap->pair;
              point.residual =
                gap->gap - jump(point, u) +
                gap->normal *
                  solver.points().motion_of(contact.named_pairs()[gap->pair], place, q_of_points);
              points.push_back(point);
            }
    }
}

/// Return n . [v] of a field in space.
template <int dim>
double GapResidual<dim>::jump(const Point &point, const typename mesh::Surface<dim>::Field &v) const
{
  return point.gap.normal * (sum<dim>(point.shape, v) - sum<dim>(point.gap.masters, v));
}

template <int dim>
double GapResidual<dim>::excess_work(const std::vector<state::ContactPoint> &rows,
                                     const mesh::Field<dim>                 &v) const
{
  const auto         &contact    = solver.contact(load_case);
  const auto          on_surface = solver.surface().gather(v);
  const auto          in_space   = contact.placed_surface().turned(on_surface);
  std::vector<double> pressures;
  for (const auto &row : rows)
    pressures.push_back(row.mean);
  const auto p    = values(pressures);
  double     work = 0.;
  for (unsigned int i = 0; i < points.size(); ++i)
    work += p[i] * jump(points[i], in_space) * points[i].area;
  work                    = -dealii::Utilities::MPI::sum(work, solver.mesh().communicator());
  const auto coefficients = contact.rows(positions);
  for (unsigned int i = 0; i < rows.size(); ++i)
    for (const auto &[node, c] : coefficients[i].coefficients)
      work += rows[i].force * (c * on_surface[node]);
  return work;
}

/// Return the values of the pair at each point.
template <int dim>
std::vector<double> GapResidual<dim>::values(const std::vector<double> &of_rows) const
{
  std::vector<std::vector<double>> nodal;
  for (unsigned int p = 0; p < solver.contact(load_case).pairs().size(); ++p)
    nodal.push_back(nodal_values(solver, solver.contact(load_case), p, of_rows));
  std::vector<double> result;
  for (const auto &point : points)
    {
      result.push_back(0.);
      for (const auto &[node, value] : point.shape)
        result.back() += value * nodal[point.pair][node];
    }
  return result;
}

template <int dim>
std::vector<double> GapResidual<dim>::integral(const std::vector<double> &of_rows) const
{
  const auto          q = values(of_rows);
  std::vector<double> result(solver.mesh().cells().size(), 0.);
  for (unsigned int i = 0; i < points.size(); ++i)
    result[points[i].cell] += q[i] * points[i].residual * points[i].area;
  return result;
}

template <int dim>
std::vector<response::PressureRows>
GapResidual<dim>::pressures(const std::vector<double> &of_rows) const
{
  const auto                          q = values(of_rows);
  std::vector<response::PressureRows> of_pairs(solver.contact(load_case).named_pairs().size());
  for (unsigned int i = 0; i < points.size(); ++i)
    {
      of_pairs[points[i].named].force.push_back(q[i] * points[i].area);
      of_pairs[points[i].named].area.push_back(points[i].area);
    }
  const auto everywhere = [&](const std::vector<double> &values) {
    std::vector<double> all;
    for (const auto &of_rank : all_gather(solver.mesh().communicator(), values))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    return all;
  };
  for (auto &rows : of_pairs)
    rows = {everywhere(rows.force), everywhere(rows.area)};
  return of_pairs;
}

template <int dim>
std::vector<double> GapResidual<dim>::least(const unsigned int pair) const
{
  std::vector<double> result(solver.surface().n_nodes(), std::numeric_limits<double>::infinity());
  for (const auto &point : points)
    if (point.pair == pair)
      for (const auto &[node, value] : point.shape)
        result[node] = std::min(result[node], point.residual);
  MPI_Allreduce(MPI_IN_PLACE, result.data(), result.size(), MPI_DOUBLE, MPI_MIN,
                solver.mesh().communicator());
  return result;
}

template class GapResidual<2>;
template class GapResidual<3>;
} // namespace snug::accuracy
