#include <snug/base/errors.h>
#include <snug/state/contact_patches.h>
#include <snug/state/geometric_effects.h>
#include <snug/state/validity_checks.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::state {
namespace {
/// Return the matrix G that fits u = u_mean + G (x - x_mean) best at the nodes. The least squares
/// fit is G = (sum_a du_a dx_a') (sum_a dx_a dx_a')^-1 with the differences du, dx from the means
/// over the nodes. It is the exact gradient of displacements that are linear in x.
template <int dim>
dealii::Tensor<2, dim> fitted_gradient(const std::vector<unsigned int>           &nodes,
                                       const std::vector<dealii::Tensor<1, dim>> &x,
                                       const std::vector<dealii::Tensor<1, dim>> &u)
{
  dealii::Tensor<1, dim> x_mean;
  for (const unsigned int node : nodes)
    x_mean += x[node];
  x_mean /= double(nodes.size());
  dealii::Tensor<2, dim> xx, ux;
  for (const unsigned int node : nodes)
    {
      xx += outer_product(x[node] - x_mean, x[node] - x_mean);
      ux += outer_product(u[node], x[node] - x_mean);
    }
  return ux * invert(xx);
}

std::string
line(const std::string &what, double value, const std::string &unit, const std::string &advice)
{
  std::ostringstream text;
  text.precision(2);
  text << what << " up to " << value << unit << advice;
  return text.str();
}

/// Return the height of the facets that gaps and normals of pair @p p contain. Gaps and normals of
/// nodes that meet have no facets between the nodes.
template <int dim>
double seen_facets(const StateSolver<dim>      &solver,
                   const contact::Contact<dim> &contact,
                   const unsigned int           p)
{
  const contact::Pair &pair = contact.pairs()[p];
  if (pair.obstacle ||
      (pair.parameters.method == contact::Method::nodal && contact.matchings()[p].complete()))
    return 0.;
  double height = 0.;
  for (const auto *side : {&pair.slave, &pair.master})
    for (const auto &[body, boundary] : side->boundaries())
      height = std::max(height, solver.mesh().geometry(body).boundary_shape(boundary).facet_height);
  return height;
}

template <int dim>
void assess_facets(const StateSolver<dim>               &solver,
                   const std::vector<contact::Row<dim>> &contact_rows,
                   const ContactState<dim>              &state,
                   ValidityChecks                       &result)
{
  const auto         &contact = solver.contact(state.load_case);
  std::vector<double> closed(contact.pairs().size(), 0.);
  for (unsigned int i = 0; i < contact_rows.size(); ++i)
    if (state.contact[i].strong)
      {
        double &largest = closed[contact.places()[i].pair];
        largest         = std::max(largest, std::abs(contact_rows[i].gap));
      }
  for (unsigned int p = 0; p < closed.size(); ++p)
    {
      const double height = seen_facets(solver, contact, p);
      if (closed[p] > 0. && height * result.closed_gap >= result.facet_height * closed[p])
        {
          result.facet_height = height;
          result.closed_gap   = closed[p];
        }
    }
}

/// Count the nodes without a row that penetrate the master although it was beyond the search
/// distance. All ranks count all nodes.
template <int dim>
void assess_missed_nodes(const StateSolver<dim>               &solver,
                         const std::vector<contact::Row<dim>> &contact_rows,
                         const ContactState<dim>              &state,
                         ValidityChecks                       &result)
{
  const auto       &surface = solver.surface();
  const auto       &contact = solver.contact(state.load_case);
  const auto       &placed  = contact.placed_surface();
  const auto        x       = placed.to_space(state.surface_positions);
  const auto        u       = placed.turned(state.surface_displacement);
  const auto        held    = placed.turned(solver.held().directions(surface, state.positions));
  std::vector<bool> has_row(surface.n_nodes(), false);
  for (unsigned int i = 0; i < contact_rows.size(); ++i)
    has_row[contact.places()[i].slave] = true;
  for (const auto &dependent : contact.dependent_multipliers())
    has_row[dependent.node] = true;
  for (unsigned int p = 0; p < contact.pairs().size(); ++p)
    {
      const auto  &pair     = contact.pairs()[p];
      const double distance = pair.parameters.search_distance;
      if (distance == 0.)
        continue;
      const auto gaps    = contact.point_gaps(p, x, held);
      auto       visited = has_row;
      for (const auto &face : surface.faces())
        for (const unsigned int node : face.nodes)
          {
            if (!contact::is_on(face, pair.slave) || visited[node] ||
                !surface.masters(node).empty())
              continue;
            visited[node]  = true;
            const auto gap = gaps->at(x[node], {{node, 1.}}, {face.body, face.boundary});
            if (!gap || !(gap->gap > distance))
              continue;
            auto motion = u[node];
            for (const auto &[master, weight] : gap->masters)
              motion -= weight * u[master];
            if (gap->normal * motion > gap->gap)
              {
                ++result.missed;
                result.missed_pair = pair.name();
              }
          }
    }
}
} // namespace

template <int dim>
ValidityChecks check_validity(const StateSolver<dim>               &solver,
                              const std::vector<contact::Row<dim>> &contact_rows,
                              const ContactState<dim>              &state)
{
  ValidityChecks result;
  for (const auto &subdomain : solver.tearing().subdomains)
    for (const unsigned int cell : subdomain.cells)
      {
        const auto G = fitted_gradient<dim>(solver.mesh().cells()[cell].nodes, state.positions,
                                            state.displacement);
        // Compute the symmetric and the antisymmetric part. The antisymmetric part of a rotation by
        // the small angle w has the norm sqrt(2) w.
        const auto part = [&](double sign) { return (0.5 * (G + sign * transpose(G))).norm(); };
        result.strain   = std::max(result.strain, part(1.));
        result.rotation = std::max(result.rotation, part(-1.) / std::sqrt(2.));
      }
  double farthest = 0.;
  for (unsigned int node = 0; node < state.displacement.size(); ++node)
    {
      result.displacement = std::max(result.displacement, state.displacement[node].norm());
      farthest            = std::max(farthest, state.positions[node].norm());
    }
  const MPI_Comm comm = solver.context().communicator();
  for (double *of_rank : {&result.strain, &result.rotation, &result.displacement, &farthest})
    *of_rank = dealii::Utilities::MPI::max(*of_rank, comm);
  result.displacement /= farthest;

  const auto &contact = solver.contact(state.load_case);
  const auto &x       = state.surface_positions;
  const auto  slips   = contact.tangential_slips(x, contact_rows, state.surface_displacement);
  const auto  drifts  = contact.pairing_drifts(x, contact_rows);
  for (unsigned int i = 0; i < contact_rows.size(); ++i)
    {
      // Open contacts count as well, because they would close at the wrong point.
      result.drift = std::max(result.drift, drifts[i]);
      // Rows without force may slide, because there is no force whose place would matter.
      if (state.contact[i].strong)
        result.slip = std::max(result.slip, slips[i]);
    }
  for (const auto &patch : contact_patches(solver, state))
    if (!patch.is_light)
      result.width = std::min(result.width, patch.width);
  assess_facets(solver, contact_rows, state, result);
  assess_missed_nodes(solver, contact_rows, state, result);
  result.geometric = geometric_effects(solver, state);
  return result;
}

std::optional<Warning> facet_warning(const ValidityChecks &validity)
{
  if (validity.facet_height <= large_facets * validity.closed_gap)
    return {};
  std::ostringstream text;
  text.precision(2);
  text << "the facet height " << validity.facet_height << " of a contact surface is "
       << 100. * validity.facet_height / validity.closed_gap
       << " % of the largest gap or overlap that closes: pressures follow the facets; set "
          "'Surface', or use a finer mesh file";
  return Warning{"facets", text.str(), validity.facet_height / validity.closed_gap, large_facets};
}

namespace {
/// Return the body with the maximum effect of large displacements.
GeometricEffect largest_effect(const ValidityChecks &validity)
{
  GeometricEffect result;
  for (const auto &effect : validity.geometric)
    if (std::abs(effect.of_force()) > std::abs(result.of_force()))
      result = effect;
  return result;
}

std::string line(const GeometricEffect &effect)
{
  std::ostringstream text;
  text.precision(2);
  text << "large displacements would change the stiffness of body " << effect.body << " by about "
       << 100. * effect.of_force() << " %";
  return text.str();
}
} // namespace

std::string why_not_valid(const ValidityChecks &validity)
{
  const auto effect = largest_effect(validity);
  if (std::abs(effect.of_force()) > wrong_effect)
    return line(effect);
  return validity.rotation > wrong_rotation ? line("cells rotate by", validity.rotation, " rad", "")
                                            : "";
}

std::vector<Warning> warnings(const ValidityChecks &validity)
{
  std::vector<Warning> result;
  const auto           check = [&](const std::string &code, const double value, const double bound,
                         const std::string &text) {
    if (value > bound)
      result.push_back({code, text, value, bound});
  };
  check("rotation", validity.rotation, large_rotation,
        line("cells rotate by", validity.rotation, " rad", ": small rotations are assumed"));
  const auto effect = largest_effect(validity);
  check("large displacements", std::abs(effect.of_force()), large_effect,
        line(effect) + ": small displacements are assumed");
  check("strain", validity.strain, large_strain,
        line("strains are", validity.strain, "", ": small strains are assumed"));
  check("slip", validity.slip, large_slip,
        line("nodes in contact slip by", validity.slip, " of a face", ": small slip is assumed"));
  check("pairing drift", validity.drift, large_drift,
        line("the design moved slave nodes away from their paired points by", validity.drift,
             " of a face", ": see 'Contact/Update pairing'"));
  if (validity.width < least_width)
    {
      std::ostringstream text;
      text.precision(2);
      text << "minimum number of faces across a contact: " << validity.width
           << ", at least 8 are recommended for accurate pressures";
      result.push_back({"contact faces", text.str(), validity.width, least_width});
    }
  if (const auto facets = facet_warning(validity))
    result.push_back(*facets);
  check("missed nodes", validity.missed, 0.,
        counted(validity.missed, "slave node") + " beyond the search distance of '" +
          validity.missed_pair +
          "' penetrate the master without a force: increase 'Search distance'");
  return result;
}

namespace {
/// Return a text like " (0.3 times the face size)".
std::string of_a_face(const contact::PairedGaps &gaps)
{
  std::ostringstream text;
  text.precision(2);
  text << " (" << gaps.overlap << " times the face size)";
  return text.str();
}
} // namespace

void check_overlaps(const std::vector<contact::Pair>       &pairs,
                    const std::vector<contact::PairedGaps> &gaps,
                    const std::string                      &place)
{
  for (unsigned int p = 0; p < pairs.size(); ++p)
    // Gaps are replicated like all contact data, so all ranks throw, or none.
    if (gaps[p].overlap > absurd_overlap)
      throw bad_entry("Contact/Pairs", pairs[p].name(),
                      line("the initial penetration" + place + " is", -gaps[p].least,
                           of_a_face(gaps[p]),
                           ": pair faces that look at each other, or, if the overlap is intended, "
                           "set 'Interference' of the pair"));
}

std::vector<Warning> overlap_warnings(const std::vector<contact::Pair>       &pairs,
                                      const std::vector<contact::PairedGaps> &gaps,
                                      const std::string                      &place)
{
  std::vector<Warning> result;
  for (unsigned int p = 0; p < pairs.size(); ++p)
    if (gaps[p].overlap > large_overlap)
      result.push_back({"overlap",
                        line("the initial penetration of '" + pairs[p].name() + "'" + place + " is",
                             -gaps[p].least, of_a_face(gaps[p]),
                             ": if the overlap is intended, set 'Interference' of the pair"),
                        gaps[p].overlap, large_overlap});
  return result;
}

template <int dim>
std::vector<Warning> friction_warnings(const contact::Contact<dim> &contact)
{
  std::vector<Warning> result;
  for (const auto &pair : contact.named_pairs())
    {
      double largest = 0.;
      for (const auto &[row, share] : pair.rows)
        largest = std::max(largest, contact.friction(row).coefficient);
      if (largest > large_friction)
        result.push_back({"friction",
                          line("'Friction coefficient' of '" + pair.name() + "' is", largest, "",
                               ": coefficients above 1.5 are rare"),
                          largest, large_friction});
    }
  return result;
}

std::vector<Warning> matching_warnings(const std::vector<contact::Pair>     &pairs,
                                       const std::vector<contact::Matching> &matchings)
{
  std::vector<Warning> result;
  for (unsigned int p = 0; p < pairs.size(); ++p)
    if (!pairs[p].obstacle && pairs[p].parameters.method == contact::Method::nodal &&
        !matchings[p].complete())
      result.push_back(
        {"nodal rows", "'" + pairs[p].name() + "' is nodal, but " +
                         std::to_string(matchings[p].n_nodes - matchings[p].n_matching) + " of " +
                         std::to_string(matchings[p].n_nodes) +
                         " slave nodes match no master node: pressures oscillate by "
                         "some percent from node to node; 'Method' = mortar avoids "
                         "this"});
    else if (!pairs[p].obstacle && pairs[p].parameters.method == contact::Method::mortar &&
             matchings[p].finer > finer_slave)
      {
        std::ostringstream text;
        text.precision(2);
        text << "the slave faces of '" << pairs[p].name() << "' are " << matchings[p].finer
             << " times finer than the master faces: pressures oscillate; the default of 'Slave' "
                "selects the other side";
        result.push_back({"fine slave", text.str(), matchings[p].finer, finer_slave});
      }
  return result;
}

template std::vector<Warning> friction_warnings(const contact::Contact<2> &);
template std::vector<Warning> friction_warnings(const contact::Contact<3> &);
template ValidityChecks       check_validity(const StateSolver<2> &,
                                             const std::vector<contact::Row<2>> &,
                                             const ContactState<2> &);
template ValidityChecks       check_validity(const StateSolver<3> &,
                                             const std::vector<contact::Row<3>> &,
                                             const ContactState<3> &);
} // namespace snug::state
