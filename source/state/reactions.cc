#include <snug/elasticity/linear_traction.h>
#include <snug/state/nodal_pressures.h>
#include <snug/state/point_results.h>
#include <snug/state/reactions.h>

#include <limits>
#include <map>
#include <numeric>

namespace snug::state {
namespace {
/// A place and the force that acts there.
template <int dim>
using Force = std::pair<dealii::Tensor<1, dim>, dealii::Tensor<1, dim>>;

template <int dim>
dealii::Tensor<1, 3> moment_about(const dealii::Tensor<1, dim>  &centre,
                                  const std::vector<Force<dim>> &forces)
{
  dealii::Tensor<1, 3> sum;
  for (const auto &[place, force] : forces)
    sum += elasticity::moment_of(place - centre, force);
  return sum;
}

/// Return the resultant, where radial forces on a section of revolution cancel over the
/// circumference.
template <int dim>
dealii::Tensor<1, dim> resultant(const StateSolver<dim> &solver, dealii::Tensor<1, dim> force)
{
  if (solver.mesh().idealization().is_axisymmetric())
    force[0] = 0.;
  return force;
}

template <int dim>
void add_supports(const StateSolver<dim>     &solver,
                  const RowCoefficients<dim> &rows,
                  ContactState<dim>          &state)
{
  std::map<std::string, std::vector<Force<dim>>> forces;
  std::vector<std::string>                       names; // in the order of the nodes
  for (const auto &force :
       solver.held().forces(state.positions,
                            solver.gluing(state.load_case).reactions(state.dual.lambda, rows)))
    {
      if (force.face.empty())
        continue;
      if (forces.count(force.face) == 0)
        names.push_back(force.face);
      const auto motion = solver.motion(state.load_case, force.body);
      forces[force.face].emplace_back(motion.point(force.position),
                                      resultant(solver, motion.vector(force.value)));
    }
  for (const auto &force : solver.springs().forces(
         state.positions,
         solver.gluing(state.load_case).spring_forces(state.dual.lambda.column(0))))
    {
      if (forces.count(force.face) == 0)
        names.push_back(force.face);
      const auto motion = solver.motion(state.load_case, force.body);
      forces[force.face].emplace_back(motion.point(force.position),
                                      resultant(solver, motion.vector(force.value)));
    }
  state.reactions.clear();
  for (const auto &name : names)
    {
      Reaction<dim> reaction{name, {}, {}, {}};
      const auto   &of_face = forces[name];
      for (const auto &[place, force] : of_face)
        {
          reaction.centre += place / double(of_face.size());
          reaction.force += force;
        }
      reaction.centre = resultant(solver, reaction.centre);
      reaction.moment = moment_about<dim>(reaction.centre, of_face);
      state.reactions.push_back(reaction);
    }
}

template <int dim>
void add_loads(const StateSolver<dim> &solver, ContactState<dim> &state)
{
  double      sums[dim] = {};
  const auto &feti      = solver.feti(state);
  for (unsigned int s = 0; s < feti.loads().size(); ++s)
    {
      const auto            &f = feti.loads()[s];
      dealii::Tensor<1, dim> of_subdomain;
      if (solver.assemblers()[s]->is_point())
        {
          if (solver.model()
                .points[solver.tearing().subdomains[s].body - solver.mesh().n_bodies()]
                .is_bolt())
            continue;                                         // its tension acts on both sides
          const unsigned int first = f.n_rows() == 1 ? 1 : 0; // the force along the axis
          for (unsigned int c = first; c < dim; ++c)
            of_subdomain[c] = f(c - first);
        }
      else
        for (unsigned int i = 0; i < f.n_rows(); ++i)
          of_subdomain[i % dim] += f(i);
      of_subdomain =
        solver.motion(state.load_case, solver.tearing().subdomains[s].body).vector(of_subdomain);
      for (unsigned int c = 0; c < dim; ++c)
        sums[c] += of_subdomain[c];
    }
  MPI_Allreduce(MPI_IN_PLACE, sums, dim, MPI_DOUBLE, MPI_SUM, solver.context().communicator());
  for (unsigned int c = 0; c < dim; ++c)
    state.load[c] = sums[c];
  state.load = resultant(solver, state.load);
}

/// Return the place where the force of a row acts on the slave side. This place is the slave node,
/// unless other nodes of the side take part, as in mortar rows at the end of the master side.
template <int dim>
dealii::Tensor<1, dim> place(const contact::Row<dim>                  &row,
                             const unsigned int                        slave,
                             const std::vector<bool>                  &on_slave_side,
                             const contact::PlacedSurface<dim>        &placed,
                             const typename mesh::Surface<dim>::Field &x)
{
  dealii::Tensor<1, dim> sum;
  double                 weights = 0.;
  unsigned int           n       = 0;
  for (const auto &[node, c] : row.coefficients)
    if (on_slave_side[node])
      {
        ++n;
        const double share = placed.turned(node, c) * row.normal;
        weights += share;
        sum += share * x[node];
      }
  return n == 1 ? x[slave] : sum / weights;
}

/// Return which surface nodes are on the slave side of each joined pair.
template <int dim>
std::vector<std::vector<bool>> slave_side_nodes(const mesh::Surface<dim>    &surface,
                                                const contact::Contact<dim> &contact)
{
  std::vector<std::vector<bool>> result;
  for (const auto &pair : contact.pairs())
    {
      result.emplace_back(surface.n_nodes(), false);
      for (const auto &face : surface.faces())
        if (contact::is_on(face, pair.slave))
          for (const unsigned int node : face.nodes)
            result.back()[node] = true;
    }
  return result;
}

/// Compute the places where pairs press, without communication, because contact points are
/// replicated.
template <int dim>
void add_places(const StateSolver<dim>     &solver,
                const RowCoefficients<dim> &rows,
                ContactState<dim>          &state)
{
  const auto &contact       = solver.contact(state.load_case);
  const auto &placed        = contact.placed_surface();
  const auto  x             = placed.to_space(state.surface_positions);
  const auto  sizes         = contact::node_face_sizes(solver.surface(), x);
  const auto  on_slave_side = slave_side_nodes(solver.surface(), contact);
  for (unsigned int p = 0; p < state.pairs.size(); ++p)
    {
      auto                   &of_pair = state.pairs[p];
      const auto             &named   = contact.named_pairs()[p];
      std::vector<Force<dim>> forces;
      double                  sum = 0., largest = 0.;
      for (const auto &[i, share] : named.rows)
        {
          const auto &[pair, slave, of]   = contact.places()[i];
          const auto            &point    = state.contact[i];
          const auto            &row      = rows.contact[i];
          const auto             at       = place<dim>(row, slave, on_slave_side[pair], placed, x);
          const auto             force    = share * point.force;
          dealii::Tensor<1, dim> on_slave = -force * row.normal;
          for (int d = 0; d < dim; ++d)
            on_slave[d] -= share * point.shear[d];
          forces.emplace_back(at, resultant(solver, on_slave));
          of_pair.centre += force * at;
          sum += force;
          if (point.pressure > largest)
            {
              largest           = point.pressure;
              of_pair.peak      = x[slave];
              of_pair.peak_size = sizes[slave];
            }
        }
      if (named.obstacle)
        of_pair.centre = solver.model()
                           .load_cases[state.load_case]
                           .position.of_obstacle(named.obstacle->name)
                           .point(contact::to_point<dim>(named.obstacle->point));
      else if (sum > 0.)
        of_pair.centre /= sum;
      of_pair.moment = moment_about<dim>(of_pair.centre, forces);
    }
}
/// Set the tractions at tied nodes from the forces of their rows.
template <int dim>
void set_tractions(const StateSolver<dim> &solver, std::vector<ContactPoint> &points)
{
  double largest_area = 0.;
  for (const auto &point : points)
    largest_area = std::max(largest_area, point.area);
  // The area may be round-off, as on the axis with degree 2.
  const auto has_area = [&](const auto &point) { return point.area > 1e-10 * largest_area; };
  for (unsigned int d = 0; d <= dim; ++d) // components of the shear traction, then the pressure
    {
      std::vector<double> means, shifted;
      for (const auto &point : points)
        means.push_back(has_area(point) ? (d < dim ? -point.shear[d] : point.force) / point.area
                                        : 0.);
      // Corrections are linear and vanish for equal values, so a shift makes all values positive.
      double shift = 0.;
      for (const double mean : means)
        shift = std::max(shift, 2. * std::abs(mean));
      for (unsigned int i = 0; i < points.size(); ++i)
        shifted.push_back(means[i] + (has_area(points[i]) ? shift : 0.));
      const auto nodal = solver.mesh().degree() == 1
                           ? shifted
                           : nodal_pressures(solver.surface(), *solver.ties().paired(), shifted);
      for (unsigned int i = 0; i < points.size(); ++i)
        (d < dim ? points[i].traction[d] : points[i].pressure) = means[i] + nodal[i] - shifted[i];
    }
}

/// Return the sums and maxima of a tied pair. @p forces are those on the slave side, by rows, and
/// @p x are the surface nodes.
template <int dim>
TieState<dim> sum_of(const StateSolver<dim>                     &solver,
                     const contact::NamedPair                   &named,
                     const std::vector<std::vector<Force<dim>>> &forces,
                     const std::vector<ContactPoint>            &points,
                     const typename mesh::Surface<dim>::Field   &x)
{
  TieState<dim> tie;
  tie.name        = named.name();
  tie.max_tension = -std::numeric_limits<double>::infinity();
  std::vector<Force<dim>> of_pair;
  for (const auto &[i, share] : named.rows)
    {
      const auto  &at      = x[solver.ties().paired()->places()[i].slave];
      const double tension = -points[i].pressure, shear = points[i].traction.norm();
      ++tie.nodes;
      tie.area += share * points[i].area;
      tie.centre += share * points[i].area * at;
      for (const auto &[place, force] : forces[i])
        {
          of_pair.emplace_back(place, share * resultant(solver, force));
          tie.force += of_pair.back().second;
        }
      if (tension > tie.max_tension)
        tie.tension_place = at;
      if (shear >= tie.max_shear)
        tie.shear_place = at;
      tie.max_tension = std::max(tie.max_tension, tension);
      tie.max_shear   = std::max(tie.max_shear, shear);
    }
  tie.centre = resultant(solver, tie.centre / tie.area);
  if (!solver.mesh().idealization().is_axisymmetric()) // moments cancel over the circumference
    tie.moment = moment_about<dim>(tie.centre, of_pair);
  return tie;
}

template <int dim>
void add_ties(const StateSolver<dim>     &solver,
              const RowCoefficients<dim> &rows,
              ContactState<dim>          &state)
{
  if (solver.ties().paired() == nullptr)
    return;
  const auto        &ties   = *solver.ties().paired();
  const unsigned int n      = ties.n_rows();
  const auto         lambda = solver.gluing(state.load_case).row_forces(state.dual.lambda)[0].ties;
  const auto        &placed = solver.contact(state.load_case).placed_surface();
  const auto         x      = placed.to_space(state.surface_positions);
  const auto         areas  = ties.areas(state.surface_positions);
  const auto         on_slave_side = slave_side_nodes(solver.surface(), ties);
  std::vector<unsigned int> normal_row(n); // of each row
  std::iota(normal_row.begin(), normal_row.end(), 0);
  for (const auto &tangent : ties.tangents())
    if (!tangent.is_held)
      normal_row.push_back(tangent.row);
  std::vector<std::vector<Force<dim>>> forces(n); // on the slave side
  state.tied.resize(n);
  for (unsigned int i = 0; i < lambda.size(); ++i)
    for (const auto &[node, c] : rows.ties[i].coefficients)
      if (const unsigned int row = normal_row[i]; on_slave_side[ties.places()[row].pair][node])
        {
          const auto force = -lambda[i] * placed.turned(node, c);
          forces[row].emplace_back(x[node], force);
          for (int d = 0; i >= n && d < dim; ++d)
            state.tied[row].shear[d] -= force[d];
        }
  for (unsigned int i = 0; i < n; ++i)
    {
      state.tied[i].area  = areas[i];
      state.tied[i].force = lambda[i];
    }
  set_tractions(solver, state.tied);
  for (const auto &named : ties.named_pairs())
    state.ties.push_back(sum_of(solver, named, forces, state.tied, x));
}
} // namespace

template <int dim>
void add_reactions(const StateSolver<dim>     &solver,
                   const RowCoefficients<dim> &rows,
                   ContactState<dim>          &state)
{
  add_supports(solver, rows, state);
  add_points(solver, state);
  add_loads(solver, state);
  add_places(solver, rows, state);
  add_ties(solver, rows, state);
  state.balance = state.load;
  for (const auto &reaction : state.reactions)
    state.balance += reaction.force;
  for (unsigned int p = 0; p < state.pairs.size(); ++p)
    if (const auto &obstacle = solver.contact(state.load_case).named_pairs()[p].obstacle;
        obstacle && !solver.points().point_of(obstacle->name))
      state.balance += resultant(solver, state.pairs[p].force);
}

template void add_reactions(const StateSolver<2> &, const RowCoefficients<2> &, ContactState<2> &);
template void add_reactions(const StateSolver<3> &, const RowCoefficients<3> &, ContactState<3> &);
} // namespace snug::state
