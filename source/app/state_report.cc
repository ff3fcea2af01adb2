#include <snug/app/state_report.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::app {
namespace {
/// Components of vectors below this fraction of the largest vector of their kind are round-off.
const double round_off = 1e-6;

} // namespace

template <int n>
std::string vector_text(const dealii::Tensor<1, n> &vector, const double scale)
{
  std::ostringstream text;
  for (unsigned int d = 0; d < n; ++d)
    text << (d == 0 ? "(" : " ") << (std::abs(vector[d]) <= round_off * scale ? 0. : vector[d]);
  return text.str() + ")";
}

namespace {
/// Return a moment, in the plane its last component alone.
template <int dim>
std::string moment_text(const dealii::Tensor<1, 3> &moment, const double scale)
{
  if (dim == 3)
    return vector_text(moment, scale);
  return vector_text(dealii::Tensor<1, 1>({moment[2]}), scale);
}

/// Return the largest force, and the largest moment, of a state.
template <int dim>
std::pair<double, double> largest_forces(const state::ContactState<dim> &state)
{
  std::pair<double, double> result = {state.load.norm(), 0.};
  for (const auto &pair : state.pairs)
    // Pressures around a shaft balance each other.
    result = {std::max({result.first, pair.force.norm(), pair.contact_area * pair.max_pressure}),
              std::max(result.second, pair.moment.norm())};
  for (const auto &tie : state.ties)
    result = {std::max(result.first, tie.force.norm()), std::max(result.second, tie.moment.norm())};
  for (const auto &reaction : state.reactions)
    result = {std::max(result.first, reaction.force.norm()),
              std::max(result.second, reaction.moment.norm())};
  return result;
}

/// Print the result of the check of the solution.
template <int dim>
void print_certificate(RunContext &context, const state::ContactState<dim> &state)
{
  const auto &errors = state.certificate;
  context.out() << "solution check (not the error of the mesh): largest relative error "
                << errors.worst();
  if (state.tolerance > qp::SolverParameters().relative_tolerance)
    context.out() << ", tolerance " << state.tolerance << " of the target";
  context.out() << std::endl;
  auto &out = context.out(Verbosity::debug);
  out << "  equilibrium " << errors.equilibrium << ", continuity " << errors.continuity
      << ", penetration " << errors.penetration << ", negative pressure "
      << errors.negative_pressure << ", complementarity " << errors.complementarity;
  if (state.has_friction())
    out << ", cone " << errors.cone << ", creep " << errors.creep << ", dissipation "
        << errors.dissipation;
  out << std::endl;
}

/// Print the comparison of the stresses of a body with its yield stress. The limits of Johnson
/// (1985), sections 4.2 and 9.2, are those of line contact.
void print_yield(std::ostream            &out,
                 const Units             &units,
                 const std::string       &body,
                 const state::YieldCheck &yield,
                 const bool               is_line_contact)
{
  out << "  body " << body << ": yield stress / largest von Mises stress "
      << 1. / yield.utilization;
  if (yield.volume > 0.)
    {
      out << ", volume above the yield stress " << yield.volume << units.after_number("length^3");
      if (std::isfinite(yield.depth))
        out << " to a depth of " << yield.depth << units.after_number("length");
    }
  if (yield.pressure_over_shear > 0.)
    out << ", largest nodal pressure / yield stress in shear " << yield.pressure_over_shear
        << (is_line_contact ? " (Johnson: first yield 3.1 and shakedown 4.0 for line contact "
                              "without friction)"
                            : "");
  out << '\n';
}

/// Print the maximum von Mises stress and its comparison with yield stresses.
template <int dim>
void print_stress(const ShapeProblem<dim> &problem, const state::ContactState<dim> &state)
{
  auto       &out = problem.context.out(Verbosity::quiet);
  const Units units(problem.scene.units);
  const auto  peak = state.stress_peak();
  const bool  is_line_contact =
    problem.mesh->idealization().kind == mesh::Idealization::Kind::plane_strain &&
    !state.has_friction();
  out << "largest von Mises stress " << peak.von_mises << units.after_number("force/length^2")
      << " at " << vector_text(peak.place, state.displacement_peak.extent)
      << units.after_number("length") << " in body " << peak.body << '\n';
  for (const auto &of_body : state.stress_peaks)
    if (of_body.yield.utilization > 0.)
      print_yield(out, units, of_body.body, of_body.yield, is_line_contact);
}

} // namespace

template <int dim>
std::string edge_remark(const std::vector<accuracy::SharpEdge> &edges,
                        const state::ContactState<dim>         &state,
                        const state::PairState<dim>            &pair)
{
  for (const auto &edge : edges)
    for (const unsigned int row : edge.rows)
      if (pair.max_pressure > 0. && state.contact[row].pressure == pair.max_pressure)
        return ", at a sharp edge, where the exact pressure has no limit";
  return "";
}

template <int dim>
void print_forces(const ShapeProblem<dim> &problem, const state::ContactState<dim> &state)
{
  auto             &context = problem.context;
  const Units       units(problem.scene.units);
  const double      extent = state.displacement_peak.extent;
  const auto        edges  = accuracy::sharp_edges(*problem.solver, state);
  const std::string length = units.after_number("length"), force = units.after_number("force"),
                    moment = units.after_number("force length"),
                    stress = units.after_number("force/length^2");
  const auto   largest     = largest_forces(state);
  const double forces      = largest.first;
  // Moments of forces at a distance cancel up to their round-off.
  const double moments = std::max(largest.second, forces * extent);
  auto        &out = context.out(), &details = context.out(Verbosity::debug);
  for (const auto &pair : state.pairs)
    {
      out << "  contact " << pair.name << ": force on " << pair.name.substr(0, pair.name.find(": "))
          << ' ' << vector_text(pair.force, forces) << force << ", area " << pair.contact_area
          << units.after_number("length^2") << ", largest nodal pressure " << pair.max_pressure
          << units.after_number("force/length^2") << " at " << vector_text(pair.peak, extent)
          << length << edge_remark(edges, state, pair) << ", " << pair.active_contacts << " of "
          << pair.rows << " nodes in contact\n";
      details << "    moment " << moment_text<dim>(pair.moment, moments) << moment << " about "
              << vector_text(pair.centre, extent) << length << ", face size at the peak "
              << pair.peak_size << length << '\n';
    }
  for (const auto &tie : state.ties)
    out << "  tied " << tie.name << ": force on " << tie.name.substr(0, tie.name.find(": ")) << ' '
        << vector_text(tie.force, forces) << force << ", moment "
        << moment_text<dim>(tie.moment, moments) << moment << " about "
        << vector_text(tie.centre, extent) << length << ", largest tension " << tie.max_tension
        << stress << " at " << vector_text(tie.tension_place, extent) << length
        << ", largest shear traction " << tie.max_shear << stress << " at "
        << vector_text(tie.shear_place, extent) << length << '\n';
  for (const auto &bolt : state.bolts)
    out << "  bolt " << bolt.name << ": tension " << bolt.tension << force << ", shortening "
        << bolt.shortening << length << '\n';
  for (const auto &point : state.points)
    out << "  reference point " << point.name << ": displacement "
        << vector_text(point.displacement, state.displacement_peak.size) << length << ", rotation "
        << moment_text<dim>(point.rotation, state.displacement_peak.size / extent) << " rad\n";
  for (const auto &reaction : state.reactions)
    out << "  support " << reaction.name << ": force " << vector_text(reaction.force, forces)
        << force << ", moment " << moment_text<dim>(reaction.moment, moments) << moment << " about "
        << vector_text(reaction.centre, extent) << length << '\n';
  details << "sum of loads, reactions and obstacle forces " << vector_text(state.balance, forces)
          << force << '\n';
}
template <int dim>
void print_state(const ShapeProblem<dim> &problem, const state::ContactState<dim> &state)
{
  auto             &context = problem.context;
  const Units       units(problem.scene.units);
  const std::string energy = units.after_number("force length"),
                    length = units.after_number("length");
  const auto &moved        = state.displacement_peak;
  auto       &out          = context.out(Verbosity::quiet);
  if (problem.n_load_cases() > 1)
    out << "load case " << problem.scene.load_cases[state.load_case].name << ":\n";
  if (state.load.norm() > 0.)
    out << "sum of loads " << vector_text(state.load, largest_forces(state).first)
        << units.after_number("force") << '\n';
  if (!state.pairs.empty())
    out << "contact force " << vector_text(state.contact_force, largest_forces(state).first)
        << units.after_number("force") << ", contact area " << state.contact_area
        << units.after_number("length^2") << ", largest nodal pressure " << state.max_pressure
        << units.after_number("force/length^2") << '\n';
  if (state.has_friction())
    out << "friction: " << state.slipping_contacts << " of "
        << counted(state.active_contacts, "node") << " in contact slip, dissipation "
        << (state.dissipation <= round_off * state.strain_energy ? 0. : state.dissipation) << energy
        << '\n';
  out << "largest displacement " << moved.size << length << ": "
      << vector_text(moved.displacement, moved.size) << " at "
      << vector_text(moved.position, moved.extent) << length << '\n';
  print_stress(problem, state);
  out << "work of loads " << state.compliance << energy << ", strain energy " << state.strain_energy
      << energy << ", potential energy " << state.energy << energy << std::endl;
  print_forces(problem, state);
  print_certificate(context, state);
  context.out(Verbosity::debug) << "nodes in contact: " << state.active_contacts << " of "
                                << state.contact.size() << ", " << state.weak_contacts
                                << " weakly active, strict complementarity margin "
                                << state.contact_change_margin
                                << "\nminimum scaled Jacobian: " << state.least_scaled_jacobian
                                << '\n'
                                << state.dual.method << ": "
                                << counted(state.dual.outer_iterations, "outer iteration") << ", "
                                << counted(state.f_mults, "F-mult") << std::endl;
}

#define SNUG_INSTANTIATE(dim)                                                                     \
  template void        print_state(const ShapeProblem<dim> &, const state::ContactState<dim> &);  \
  template void        print_forces(const ShapeProblem<dim> &, const state::ContactState<dim> &); \
  template std::string edge_remark(const std::vector<accuracy::SharpEdge> &,                      \
                                   const state::ContactState<dim> &,                              \
                                   const state::PairState<dim> &);                                \
  template std::string vector_text(const dealii::Tensor<1, dim> &, double);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
