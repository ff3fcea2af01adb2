#include <snug/elasticity/linear_traction.h>
#include <snug/state/reactions.h>

#include <map>

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

/// Compute the places where pairs press, without communication, because contact points are
/// replicated.
template <int dim>
void add_places(const StateSolver<dim>     &solver,
                const RowCoefficients<dim> &rows,
                ContactState<dim>          &state)
{
  const auto                    &contact = solver.contact(state.load_case);
  const auto                    &placed  = contact.placed_surface();
  const auto                     x       = placed.to_space(state.surface_positions);
  const auto                     sizes   = contact::node_face_sizes(solver.surface(), x);
  std::vector<std::vector<bool>> on_slave_side;
  for (const auto &pair : contact.pairs())
    {
      on_slave_side.emplace_back(solver.surface().n_nodes(), false);
      for (const auto &face : solver.surface().faces())
        if (contact::is_on(face, pair.slave))
          for (const unsigned int node : face.nodes)
            on_slave_side.back()[node] = true;
    }
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
} // namespace

template <int dim>
void add_reactions(const StateSolver<dim>     &solver,
                   const RowCoefficients<dim> &rows,
                   ContactState<dim>          &state)
{
  add_supports(solver, rows, state);
  add_loads(solver, state);
  add_places(solver, rows, state);
  state.balance = state.load;
  for (const auto &reaction : state.reactions)
    state.balance += reaction.force;
  for (unsigned int p = 0; p < state.pairs.size(); ++p)
    if (solver.contact(state.load_case).named_pairs()[p].obstacle)
      state.balance += resultant(solver, state.pairs[p].force);
}

template void add_reactions(const StateSolver<2> &, const RowCoefficients<2> &, ContactState<2> &);
template void add_reactions(const StateSolver<3> &, const RowCoefficients<3> &, ContactState<3> &);
} // namespace snug::state
