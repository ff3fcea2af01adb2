#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/state/point_results.h>

#include <algorithm>
#include <sstream>

namespace snug::state {
namespace {
/// Return the part of a motion or a wrench from @p first on as a vector in space; about z in 2D.
template <int n>
dealii::Tensor<1, n>
part(const std::vector<double> &of, const unsigned int first, const unsigned int place = 0)
{
  dealii::Tensor<1, n> result;
  for (unsigned int k = first; k < of.size() && place + k - first < n; ++k)
    result[place + k - first] = of[k];
  return result;
}

/// Call @p use(subdomain, first place of its motion) for the reference points of this rank.
template <int dim, typename Use>
void for_each_point(const StateSolver<dim> &solver, const Use &use)
{
  const unsigned int m = solver.mesh().idealization().n_rigid_motions();
  for (unsigned int s = 0; s < solver.assemblers().size(); ++s)
    if (solver.assemblers()[s]->is_point())
      use(s, m * (solver.tearing().subdomains[s].body - solver.mesh().n_bodies()));
}

/// @throws SolveError if supports hold nodes of a face otherwise than its reference point moves.
template <int dim>
void require_followers(const StateSolver<dim>                 &solver,
                       const std::vector<std::vector<double>> &q,
                       const ContactState<dim>                &state)
{
  std::string  name;
  const double distance =
    solver.points().parting(state.surface_positions, state.surface_displacement, q, solver.held(),
                            name);
  double largest = 0.;
  for (const auto &u : state.surface_displacement)
    largest = std::max(largest, u.norm());
  // The continuity of the state has an error of the tolerance.
  if (distance <= std::max(1e-6, 100. * state.tolerance) * largest)
    return;
  std::ostringstream text;
  text << "no equilibrium: supports hold nodes of the faces that follow the reference point '"
       << name << "' up to " << distance << " away from its motion";
  throw SolveError(text.str());
}
} // namespace

template <int dim>
qp::MultiVector own_point_motions(const StateSolver<dim> &solver, const feti::PrimalVectors &u)
{
  const unsigned int m = solver.mesh().idealization().n_rigid_motions();
  qp::MultiVector    result(m * solver.tearing().n_points, u.n_columns());
  for_each_point(solver, [&](const unsigned int s, const unsigned int first) {
    for (unsigned int j = 0; j < u.n_columns(); ++j)
      std::copy_n(u[s].column(j), m, result.column(j) + first);
  });
  return result;
}

template <int dim>
void add_point_motions(const StateSolver<dim> &solver,
                       const qp::MultiVector  &motions,
                       feti::PrimalVectors    &u)
{
  for_each_point(solver, [&](const unsigned int s, const unsigned int first) {
    for (unsigned int j = 0; j < u.n_columns(); ++j)
      for (unsigned int k = 0; k < u[s].n_rows(); ++k)
        u[s](k, j) += motions(first + k, j);
  });
}

template <int dim>
std::vector<std::vector<double>> point_motions(const StateSolver<dim>    &solver,
                                               const feti::PrimalVectors &u,
                                               const unsigned int         column)
{
  const unsigned int  m = solver.mesh().idealization().n_rigid_motions();
  std::vector<double> all(std::size_t(m) * solver.tearing().n_points, 0.);
  for_each_point(solver, [&](const unsigned int s, const unsigned int first) {
    std::copy_n(u[s].column(column), m, all.begin() + first);
  });
  MPI_Allreduce(MPI_IN_PLACE, all.data(), narrow<int>(all.size()), MPI_DOUBLE, MPI_SUM,
                solver.context().communicator());
  std::vector<std::vector<double>> result;
  for (auto q = all.begin(); q != all.end(); q += m)
    result.emplace_back(q, q + m);
  return result;
}

template <int dim>
void add_points(const StateSolver<dim> &solver, ContactState<dim> &state)
{
  const auto &points = solver.model().points;
  if (points.empty())
    return;
  const auto q = point_motions(solver, state.u, 0);
  require_followers(solver, q, state);
  const auto  forces = solver.gluing(state.load_case).point_reactions(state.dual.lambda.column(0));
  const auto &loads  = solver.model().load_cases[state.load_case].points;
  const bool  is_section         = solver.mesh().idealization().is_axisymmetric();
  const unsigned int n_rotations = dim == 2 ? 2 : 0; // component of the first rotation
  for (const auto &motion : q)
    state.slips.insert(state.slips.end(), motion.begin(), motion.end());
  for (unsigned int p = 0; p < points.size(); ++p)
    {
      if (points[p].is_bolt())
        {
          state.bolts.push_back({points[p].name, loads[p].wrench[0] + forces[p][0], q[p][0]});
          continue;
        }
      PointState<dim> point;
      point.name  = points[p].name;
      point.place = points[p].place;
      if (is_section)
        {
          point.displacement[1] = q[p][0];
          point.force[1]        = forces[p][0];
        }
      else
        {
          point.displacement = part<dim>(q[p], 0);
          point.rotation     = part<3>(q[p], dim, n_rotations) / points[p].length;
          point.force        = part<dim>(forces[p], 0);
          point.moment       = part<3>(forces[p], dim, n_rotations);
        }
      const auto &held = loads.empty() ? std::vector<std::optional<double>>() : loads[p].held;
      if (std::any_of(held.begin(), held.end(), [](const auto &value) { return !!value; }))
        state.reactions.push_back({point.name, point.place, point.force, point.moment});
      state.points.push_back(point);
    }
}

#define SNUG_INSTANTIATE(dim)                                                               \
  template std::vector<std::vector<double>> point_motions(const StateSolver<dim> &,         \
                                                          const feti::PrimalVectors &,      \
                                                          unsigned int);                    \
  template qp::MultiVector                  own_point_motions(const StateSolver<dim> &,     \
                                                              const feti::PrimalVectors &); \
  template void add_point_motions(const StateSolver<dim> &, const qp::MultiVector &,        \
                                  feti::PrimalVectors &);                                   \
  template void add_points(const StateSolver<dim> &, ContactState<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::state
