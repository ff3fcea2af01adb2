#include <snug/base/errors.h>
#include <snug/state/contact_results.h>
#include <snug/state/continuity.h>
#include <snug/state/nodal_pressures.h>
#include <snug/state/peaks.h>
#include <snug/state/point_results.h>
#include <snug/state/reactions.h>
#include <snug/state/thermal.h>
#include <snug/state/validity_checks.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::state {
template <int dim>
typename mesh::BodyMesh<dim>::Field nodal_values(const StateSolver<dim>    &solver,
                                                 const feti::PrimalVectors &u,
                                                 const unsigned int         column)
{
  const auto                         &mesh = solver.mesh();
  std::vector<bool>                   set(mesh.n_local_nodes(), false);
  typename mesh::BodyMesh<dim>::Field values(mesh.n_local_nodes());
  for (unsigned int s = 0; s < u.size(); ++s)
    {
      const auto &nodes = solver.tearing().subdomains[s].nodes;
      for (unsigned int a = 0; a < nodes.size(); ++a)
        // Take the first copy, because copies agree up to the continuity error of the certificate.
        if (!set[nodes[a]])
          {
            set[nodes[a]] = true;
            for (unsigned int c = 0; c < dim; ++c)
              values[nodes[a]][c] = u[s](dim * a + c, column);
          }
    }
  mesh.interpolate_hanging(values);
  return values;
}

template <int dim>
std::vector<double> contact_row_forces(const StateSolver<dim>  &solver,
                                       const ContactState<dim> &state)
{
  return solver.gluing(state.load_case).contact_forces(state.dual.lambda).front();
}

namespace {
/// A contact force above this fraction of the maximum is strong. Below it, and with a gap below the
/// same fraction of the maximum F_ii lambda_i, the contact is weak.
const double strong_part = 1e-6;

/// Compute the energies of bodies and springs. The energy is the dual value -(1/2 lambda'F lambda -
/// lambda'd) - 1/2 f'K^+f. With the residual d - F lambda this value is 1/2 lambda'(d + residual) -
/// 1/2 f'K^+f and needs no F-mult.
template <int dim>
void describe_energies(const StateSolver<dim> &solver, ContactState<dim> &state)
{
  const auto &feti = solver.feti(state);
  const auto  f    = feti.loads();
  const auto  Kf   = feti.linearization().apply_inverse(f);
  // u'Ku, f'u, f'K^+f and lambda'(d + residual)
  double sums[4] = {0., 0., 0., 0.};
  for (unsigned int s = 0; s < state.u.size(); ++s)
    {
      qp::MultiVector Ku(state.u[s].n_rows());
      feti.linearization().subdomains()[s].K.multiply_add(1., state.u[s], Ku);
      for (unsigned int i = 0; i < Ku.n_rows(); ++i)
        {
          sums[0] += Ku(i) * state.u[s](i);
          sums[1] += f[s](i) * state.u[s](i);
          sums[2] += f[s](i) * Kf[s](i);
        }
    }
  for (unsigned int i = 0; i < feti.n_owned(); ++i)
    {
      const double lambda  = state.dual.lambda(i);
      const double stretch = feti.linearization().compliance(i) * lambda;
      // Only springs have an energy. The stretch of a held tangential row is part of its slip.
      sums[feti.linearization().contact_rows()[i] ? 3 : 0] += lambda * stretch;
      sums[3] += lambda * (feti.d()(i) + state.dual.residual(i));
    }
  MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, solver.context().communicator());
  state.strain_energy = sums[0] / 2;
  state.compliance    = sums[1];
  // The error of this dual value is the square of the error of the residual.
  state.energy = sums[3] / 2 - sums[2] / 2;
  if (!has_temperature(solver, state))
    return;
  // The elastic energy is that of the strain without the thermal strain.
  double     work = 0.;
  const auto f_T  = thermal_loads(solver, state);
  for (unsigned int s = 0; s < f_T.size(); ++s)
    for (unsigned int i = 0; i < f_T[s].n_rows(); ++i)
      work += f_T[s](i) * state.u[s](i);
  work                  = dealii::Utilities::MPI::sum(work, solver.context().communicator());
  const double constant = thermal_energy(solver, state);
  state.strain_energy += constant - work;
  state.compliance -= work;
  state.energy += constant;
}

/// Values of all contact rows on all ranks, in the units of the dual rows.
struct RowValues
{
  std::vector<double> lambda, gaps; ///< lambda and g - B u
  std::vector<double> diagonal;     ///< F_ii
  std::vector<double> active, slip; ///< 1 if the row is in the active set, or the contact slips
  std::vector<double> stretch;      ///< D lambda of held tangents
};

template <int dim>
RowValues row_values(const StateSolver<dim> &solver, const ContactState<dim> &state)
{
  const auto     &feti = solver.feti(state);
  const auto      Bu   = feti.linearization().multiply_B(state.u);
  qp::MultiVector stretch(feti.n_owned()), owned(feti.n_owned(), 6);
  feti.linearization().add_compliance(1., state.dual.lambda, stretch);
  for (unsigned int i = 0; i < feti.n_owned(); ++i)
    {
      owned(i, 0) = state.dual.lambda(i);
      owned(i, 1) = feti.g()(i) - Bu(i);
      owned(i, 2) = feti.diagonal()[i];
      owned(i, 3) = state.dual.active[i];
      owned(i, 5) = stretch(i);
    }
  for (const qp::Slip &slip : state.dual.slips)
    owned(slip.cone.normal, 4) = 1.;
  const auto all = solver.gluing(state.load_case).gather_contact(owned);
  return {all[0], all[1], all[2], all[3], all[4], all[5]};
}

/// Set shear, slip and status of the contact points. @p length is max F_ii lambda_i.
template <int dim>
void describe_friction(const StateSolver<dim>     &solver,
                       const RowCoefficients<dim> &rows,
                       const RowValues            &of_rows,
                       const double                length,
                       ContactState<dim>          &state)
{
  const auto        &contact    = solver.contact(state.load_case);
  const auto        &scales     = solver.gluing(state.load_case).contact_scales();
  const auto         directions = contact.tangent_directions(rows.contact);
  const unsigned int n          = contact.n_rows();
  state.slips                   = state.slips_before;
  state.slips.resize(directions.size(), 0.);
  for (unsigned int j = 0; j < directions.size(); ++j)
    {
      state.slips[j] -= (of_rows.gaps[n + j] + of_rows.stretch[n + j]) * scales[n + j];
      auto &point = state.contact[contact.tangents()[j].row];
      if (scales[n + j] == 0.)
        continue;
      const auto &law = contact.friction(contact.tangents()[j].row);
      point.limit = point.force > 0. ? law.coefficient * point.force + law.bound * point.area : 0.;
      point.friction = point.active ? FrictionStatus::stick : FrictionStatus::open;
      for (int d = 0; d < dim; ++d)
        {
          point.shear[d] += of_rows.lambda[n + j] / scales[n + j] * directions[j][d];
          point.slip[d] -= of_rows.gaps[n + j] * scales[n + j] * directions[j][d];
        }
    }
  for (unsigned int i = 0; i < n; ++i)
    if (of_rows.slip[i] != 0.)
      state.contact[i].friction = FrictionStatus::slip;
  for (ContactPoint &point : state.contact)
    {
      if (point.friction == FrictionStatus::none)
        continue;
      // The area may be round-off, like that of the pressure.
      if (point.force != 0.)
        point.traction = -point.pressure / point.force * point.shear;
      state.dissipation += point.shear * point.slip;
      state.slipping_contacts += point.friction == FrictionStatus::slip;
      if (!point.strong)
        continue;
      const double distance =
        std::max(1. - point.shear.norm() / point.limit, point.slip.norm() / length);
      state.friction_distance = std::min(state.friction_distance, distance);
      point.weak              = distance <= strong_part;
    }
  // The dual value of describe_energies() contains the work of all forces of contact.
  state.energy -= state.dissipation;
}

template <int dim>
void set_nodal_pressures(const StateSolver<dim> &solver, ContactState<dim> &state)
{
  std::vector<double> means;
  for (const ContactPoint &point : state.contact)
    means.push_back(point.mean);
  const auto pressures = nodal_pressures(solver.surface(), solver.contact(state.load_case), means);
  for (unsigned int row = 0; row < means.size(); ++row)
    state.contact[row].pressure = pressures[row];
}

template <int dim>
void describe_contact(const StateSolver<dim>     &solver,
                      const RowCoefficients<dim> &rows,
                      ContactState<dim>          &state)
{
  const auto &gluing  = solver.gluing(state.load_case);
  const auto  of_rows = row_values(solver, state);
  const auto &lambda = of_rows.lambda, &gaps = of_rows.gaps, &F_ii = of_rows.diagonal;
  const auto  areas = solver.contact(state.load_case).areas(state.surface_positions);
  // Maximum lambda_i, maximum F_ii lambda_i, with which gaps are compared, and maximum area.
  double     largest = 0., largest_gap = 0., largest_area = 0.;
  const auto n_contacts = gluing.n_contact_rows();
  for (unsigned int i = 0; i < n_contacts; ++i)
    {
      largest_area = std::max(largest_area, areas[i]);
      largest      = std::max(largest, lambda[i]);
      largest_gap  = std::max(largest_gap, F_ii[i] * lambda[i]);
    }
  state.contact.resize(n_contacts);
  for (unsigned int i = 0; i < n_contacts; ++i)
    {
      ContactPoint &point = state.contact[i];
      const double  scale = gluing.contact_scales()[i];
      point.area          = areas[i];
      // A row divided by nr has its gap divided and its force multiplied by nr, so undo both here.
      // A row that supports hold entirely has no multiplier, and its gap is fixed.
      point.gap = scale == 0. ? gluing.gap(i, rows, state.load_case) : gaps[i] * scale;
      if (scale == 0.)
        continue;
      point.force = lambda[i] / scale;
      // The area may be round-off, as on the axis with degree 2.
      if (areas[i] > 1e-10 * largest_area)
        point.pressure = point.mean = point.force / areas[i];
      point.active = of_rows.active[i] != 0.;
      // Decide by size, not by the active set, because a contact in the set may carry no force.
      point.strong = lambda[i] > strong_part * largest;
      // A weak contact opens along one direction of the design and presses along the opposite one.
      point.weak = !point.strong && std::abs(gaps[i]) <= strong_part * largest_gap;
      if (largest > 0.)
        state.contact_change_margin =
          std::min(state.contact_change_margin,
                   std::max(lambda[i] / largest, std::abs(gaps[i]) / largest_gap));
    }
  if (solver.mesh().degree() == 2)
    set_nodal_pressures(solver, state);
  describe_friction(solver, rows, of_rows, largest_gap, state);
}

template <int dim>
std::vector<std::string> free_bodies(const StateSolver<dim> &solver, const ContactState<dim> &state)
{
  const auto &feti       = solver.feti(state);
  const auto &of_contact = solver.gluing(state.load_case).contact_of_row();
  // Contacts that stick hold the bodies along the surface as well.
  qp::RowSet rows = state.dual.determined_rows();
  for (unsigned int i = 0; i < rows.size(); ++i)
    if (feti.bounded()[i])
      rows[i] = state.contact[of_contact[i]].strong;
  return feti::free_bodies(feti.linearization(), rows);
}

/// @throws SolveError if supports hold both sides of a tied pair with different displacements.
template <int dim>
void require_ties(const StateSolver<dim> &solver, const ContactState<dim> &state)
{
  // Part of the largest displacement. Mortar rows that are left out have small means, because they
  // reach beyond the held nodes.
  const double small = 0.02;
  const auto   moved =
    solver.points().without_bolts(state.surface_positions, state.surface_displacement,
                                  point_motions(solver, state.u, 0));
  const auto parting = solver.ties().parting(state.surface_positions, moved);
  double     largest = 0.;
  for (const auto &u : state.surface_displacement)
    largest = std::max(largest, u.norm());
  if (parting.distance <= small * largest)
    return;
  std::ostringstream text;
  text << "no equilibrium: supports part the tied pair '" << parting.pair << "' by up to "
       << parting.distance;
  throw SolveError(text.str());
}

/// Sum up the contact points, which are replicated, so all ranks get the same sums without
/// communication.
template <int dim>
void sum_up_contact(const contact::Contact<dim> &contact,
                    const RowCoefficients<dim>  &rows,
                    ContactState<dim>           &state)
{
  std::vector<double> pressures; // of shared nodes, by their first row
  pressures.assign(state.contact.size(), 0.);
  for (const auto &node : contact.dependent_multipliers())
    {
      double pressure = 0.;
      for (const auto &row : node.rows)
        pressure += row.second * state.contact[row.first].pressure;
      double &largest = pressures[node.rows[0].first];
      largest         = std::max(largest, pressure);
    }
  for (const auto &named : contact.named_pairs())
    {
      PairState<dim> pair;
      pair.name = named.name();
      for (const auto &[i, share] : named.rows)
        {
          const ContactPoint &point = state.contact[i];
          ++pair.rows;
          // The normal points into the master and -force * normal acts on the slave side.
          pair.force -= share * point.force * rows.contact[i].normal;
          for (int d = 0; d < dim; ++d)
            pair.force[d] -= share * point.shear[d];
          pair.contact_area += point.strong ? share * point.area : 0.;
          pair.max_pressure = std::max({pair.max_pressure, point.pressure, pressures[i]});
          pair.active_contacts += point.strong;
        }
      state.contact_force += (named.master_is_first ? -1. : 1.) * pair.force;
      state.contact_area += pair.contact_area;
      state.max_pressure = std::max(state.max_pressure, pair.max_pressure);
      state.pairs.push_back(pair);
    }
  for (const ContactPoint &point : state.contact)
    {
      // A row of several pairs counts once.
      state.active_contacts += point.strong;
      state.weak_contacts += point.weak;
    }
}
} // namespace

template <int dim>
void recover_contact_results(const StateSolver<dim>     &solver,
                             const RowCoefficients<dim> &rows,
                             ContactState<dim>          &state)
{
  const auto &feti = solver.feti(state);
  auto        u    = state.u;
  make_continuous(feti, &feti.g(), u);
  state.displacement         = nodal_values(solver, u, 0);
  state.surface_displacement = solver.surface().gather(state.displacement);
  require_ties(solver, state);
  describe_energies(solver, state);
  describe_contact(solver, rows, state);
  sum_up_contact(solver.contact(state.load_case), rows, state);
  add_reactions(solver, rows, state);
  state.stress_peaks      = stress_peaks(solver, state);
  state.displacement_peak = displacement_peak(state, solver.context().communicator());
  state.validity          = check_validity(solver, rows.contact, state);
  state.free_bodies       = free_bodies(solver, state);
}

#define SNUG_INSTANTIATE(dim)                                                                   \
  template mesh::BodyMesh<dim>::Field nodal_values(const StateSolver<dim> &,                    \
                                                   const feti::PrimalVectors &, unsigned int);  \
  template std::vector<double>        contact_row_forces(const StateSolver<dim> &,              \
                                                         const ContactState<dim> &);            \
  template void recover_contact_results(const StateSolver<dim> &, const RowCoefficients<dim> &, \
                                        ContactState<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::state
