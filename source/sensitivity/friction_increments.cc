#include <snug/base/errors.h>
#include <snug/qp/row_set.h>
#include <snug/sensitivity/bound_derivatives.h>
#include <snug/sensitivity/friction_increments.h>
#include <snug/sensitivity/tangent_system.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace snug::sensitivity {
namespace {
/// Part of the largest increment that may be rounding errors.
const double negligible = 1e-8;

/// Number of changes of the sets, after which one contact changes at a time.
const unsigned int changes_at_once = 10;

const unsigned int most_changes = 100;

/// A contact whose set depends on the direction in which the data change.
struct WeakContact
{
  enum class Set
  {
    open,
    stick,
    slip
  };

  unsigned int          normal; ///< owned row
  qp::FrictionCone      cone;   ///< no tangents: without friction
  bool                  grazes; ///< has neither force nor gap; otherwise between stick and slip
  std::array<double, 2> slip      = {}; ///< of the state
  std::array<double, 2> direction = {}; ///< n^ of a slip
  Set                   set       = Set::open;
};

using Set = WeakContact::Set;

double along(const WeakContact &contact, const qp::MultiVector &x)
{
  double sum = 0.;
  for (unsigned int t = 0; t < contact.cone.n_tangents; ++t)
    sum += contact.direction[t] * x(contact.cone.tangents[t]);
  return sum;
}

/// Set the direction of @p contact to that of a vector in its tangential rows.
void turn(const std::array<double, 2> &vector, WeakContact &contact)
{
  const double length = std::hypot(vector[0], vector[1]);
  contact.direction   = {{vector[0] / length, vector[1] / length}};
}

/// Return whether the contact slips in the state.
bool slips(const WeakContact &contact)
{
  return std::hypot(contact.slip[0], contact.slip[1]) > 0.;
}

std::array<double, 2> tangential(const WeakContact &contact, const qp::MultiVector &x)
{
  std::array<double, 2> result = {};
  for (unsigned int t = 0; t < contact.cone.n_tangents; ++t)
    result[t] = x(contact.cone.tangents[t]);
  return result;
}

template <int dim>
std::vector<WeakContact> weak_contacts(const state::StateSolver<dim>  &solver,
                                       const state::ContactState<dim> &state,
                                       const qp::MultiVector          &w)
{
  const auto              &feti       = solver.feti(state);
  const auto              &of_contact = solver.gluing(state.load_case).contact_of_row();
  std::vector<WeakContact> result;
  for (unsigned int i = 0; i < feti.n_owned(); ++i)
    if (feti.bounded()[i] && state.contact[of_contact[i]].weak)
      {
        const auto &point = state.contact[of_contact[i]];
        WeakContact contact{i, {}, !point.strong};
        contact.cone.normal = i;
        if (const auto *cone = feti.cones().find(i))
          contact.cone = *cone;
        contact.slip = tangential(contact, w);
        if (!contact.grazes)
          {
            turn(tangential(contact, state.dual.lambda), contact);
            contact.set = point.friction == state::FrictionStatus::slip ? Set::slip : Set::stick;
          }
        result.push_back(contact);
      }
  return result;
}

/// Return @p strong with the sets of the weak contacts.
qp::FreeRows with_sets(const qp::FreeRows             &strong,
                       const std::vector<WeakContact> &contacts,
                       const double                    turning)
{
  auto                   rows = strong.rows();
  std::vector<qp::Slip>  slips;
  std::set<unsigned int> weak;
  for (const WeakContact &contact : contacts)
    weak.insert(contact.normal);
  for (const qp::Slip &slip : strong.slips())
    if (weak.count(slip.cone.normal) == 0)
      slips.push_back(slip);
  for (const WeakContact &contact : contacts)
    {
      rows[contact.normal] = contact.set != Set::open;
      for (unsigned int t = 0; t < contact.cone.n_tangents; ++t)
        rows[contact.cone.tangents[t]] = contact.set == Set::stick;
      // A slip that begins does not turn. The force of a contact that closes follows its slip.
      if (contact.set == Set::slip)
        slips.push_back({contact.cone, contact.direction, contact.grazes ? turning : 0.});
    }
  return {rows, slips};
}

/// Return the set of @p contact for the increments of multipliers and of w, and turn its slip.
Set next_set(const qp::MultiVector &lambda,
             const qp::MultiVector &w,
             const double           least_force,
             const double           least_slip,
             WeakContact           &contact)
{
  const bool   has_friction = contact.cone.n_tangents > 0;
  const double pressing     = lambda(contact.normal);
  if (contact.set == Set::open)
    {
      if (w(contact.normal) <= least_slip)
        return Set::open;
      if (!slips(contact))
        return Set::stick;
      turn(contact.slip, contact);
      return Set::slip;
    }
  if (contact.grazes && pressing < -least_force)
    return Set::open;
  // A slip of the state goes on.
  if (!has_friction || (contact.grazes && slips(contact)))
    return contact.set;
  if (contact.set == Set::slip)
    return along(contact, w) < -least_slip ? Set::stick : Set::slip;
  const auto force = tangential(contact, lambda);
  if (contact.grazes && std::hypot(force[0], force[1]) > 0.)
    turn(force, contact);
  return along(contact, lambda) > contact.cone.coefficient * pressing + least_force ? Set::slip
                                                                                    : Set::stick;
}

double largest(const qp::MultiVector &x, MPI_Comm comm)
{
  double result = 0.;
  for (unsigned int i = 0; i < x.n_rows(); ++i)
    result = std::max(result, std::abs(x(i)));
  MPI_Allreduce(MPI_IN_PLACE, &result, 1, MPI_DOUBLE, MPI_MAX, comm);
  return result;
}

/// Change the sets towards @p next: all of them, or the one with the last row of the last rank.
/// Return whether any changes. Collective.
bool change(const std::vector<Set>   &next,
            const bool                all,
            std::vector<WeakContact> &contacts,
            MPI_Comm                  comm)
{
  int last = -1, rank;
  MPI_Comm_rank(comm, &rank);
  for (unsigned int i = 0; i < contacts.size(); ++i)
    if (next[i] != contacts[i].set)
      last = rank;
  int of_all = last;
  MPI_Allreduce(MPI_IN_PLACE, &of_all, 1, MPI_INT, MPI_MAX, comm);
  bool changes = true;
  for (unsigned int i = contacts.size(); i-- > 0 && changes;)
    if (next[i] != contacts[i].set && (all || of_all == rank))
      {
        contacts[i].set = next[i];
        changes         = all;
      }
  return of_all >= 0;
}
} // namespace

template <int dim>
KktVectors friction_increments(const state::StateSolver<dim>  &solver,
                               const state::ContactState<dim> &state,
                               const KktVectors               &data)
{
  if (has_bounds(solver, state))
    throw SolveError("one-sided derivatives are not known under the Tresca law");
  const auto     &feti = solver.feti(state);
  const MPI_Comm  comm = feti.context().communicator();
  qp::MultiVector w    = feti.linearization().multiply_B(state.u);
  w.add(-1., feti.g());
  const auto strong   = strong_rows(solver, state);
  auto       contacts = weak_contacts(solver, state, w);
  double     softest  = 0.;
  for (const double F_ii : feti.diagonal())
    softest = std::max(softest, F_ii);
  for (unsigned int step = 0; step < most_changes; ++step)
    {
      auto result = TangentSystem(feti, with_sets(strong, contacts, 1e6 * softest),
                                  solver.model().solver, Solves::block, state.dual.directions)
                      .solve(data);
      qp::MultiVector increments = feti.linearization().multiply_B(result.primal);
      increments.add(-1., data.dual);
      const double     force = largest(result.dual, comm), slip = largest(increments, comm);
      std::vector<Set> next;
      for (WeakContact &contact : contacts)
        next.push_back(
          next_set(result.dual, increments, negligible * force, negligible * slip, contact));
      if (!change(next, step < changes_at_once, contacts, comm))
        return result;
    }
  throw SolveError("no one-sided derivative: the sets of weakly active contacts do not settle");
}

#define SNUG_INSTANTIATE(dim)                                              \
  template KktVectors friction_increments(const state::StateSolver<dim> &, \
                                          const state::ContactState<dim> &, const KktVectors &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::sensitivity
