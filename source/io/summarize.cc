#include <snug/base/narrow.h>
#include <snug/io/summary.h>
#include <snug/scene/scene.h>

#include <sys/resource.h>

#include <vector>

namespace snug::io {
std::vector<std::pair<std::string, std::string>> summarize_units(const scene::Scene &scene)
{
  const Units units(scene.units);
  if (!units.are_named())
    return {};
  std::vector<std::pair<std::string, std::string>> result = {{"length", units.name("length")},
                                                             {"force", units.name("force")},
                                                             {"stress",
                                                              units.name("force/length^2")}};
  const auto                                       add    = [&](const std::string &response) {
    result.emplace_back(response, trim(scene::unit_after_number(scene, response)));
  };
  add(scene.optimization.objective);
  for (const auto &response : scene.responses)
    add(response.name);
  return result;
}

/// Return the summary of the mesh. The caller adds the rows of B, which are not known here.
template <int dim>
Summary::Mesh summarize(const mesh::BodyMesh<dim> &mesh, const mesh::Tearing &tearing)
{
  Summary::Mesh result;
  // The mesh has a communicator, but no RunContext.
  int n_ranks;
  MPI_Comm_size(mesh.communicator(), &n_ranks);
  result.bodies = mesh.n_bodies();
  result.cells  = mesh.n_global_cells();
  // Count the unknowns before tearing, as other programs count them.
  result.dofs       = dim * mesh.n_global_free_nodes();
  result.subdomains = tearing.n_global;
  result.ranks      = n_ranks;
  return result;
}

namespace {
template <int dim>
std::vector<double> numbers(const dealii::Tensor<1, dim> &v)
{
  return {v.begin_raw(), v.end_raw()};
}

/// Return a JSON object of names and values. Readers iterate over its keys, so it is not null if
/// there are none.
Summary::State object_of(const std::vector<std::pair<std::string, double>> &values)
{
  auto result = Summary::State::object();
  for (const auto &[name, value] : values)
    result[name] = value;
  return result;
}

template <int dim>
Summary::State summary_part(const state::PairState<dim> &pair)
{
  return {{"name", pair.name},
          {"rows", pair.rows},
          {"active_contacts", pair.active_contacts},
          {"force", numbers(pair.force)},
          {"moment", numbers(pair.moment)},
          {"centre", numbers(pair.centre)},
          {"contact_area", pair.contact_area},
          {"max_pressure", pair.max_pressure},
          {"peak", numbers(pair.peak)},
          {"peak_size", pair.peak_size}};
}

template <int dim>
Summary::State summary_part(const state::TieState<dim> &tie)
{
  return {{"name", tie.name},
          {"nodes", tie.nodes},
          {"force", numbers(tie.force)},
          {"moment", numbers(tie.moment)},
          {"centre", numbers(tie.centre)},
          {"area", tie.area},
          {"max_tension", tie.max_tension},
          {"tension_place", numbers(tie.tension_place)},
          {"max_shear", tie.max_shear},
          {"shear_place", numbers(tie.shear_place)}};
}

template <int dim>
Summary::State summary_part(const state::PointState<dim> &point)
{
  return {{"name", point.name},
          {"place", numbers(point.place)},
          {"displacement", numbers(point.displacement)},
          {"rotation", numbers(point.rotation)},
          {"force", numbers(point.force)},
          {"moment", numbers(point.moment)}};
}

template <int dim>
Summary::State summary_part(const state::StressPeak<dim> &peak)
{
  Summary::State yield;
  if (peak.yield.yield_stress > 0.)
    yield = {{"stress", peak.yield.yield_stress},
             {"over_von_mises", 1. / peak.yield.utilization},
             {"volume_above", peak.yield.volume},
             {"depth_above", peak.yield.depth},
             {"pressure_over_shear", peak.yield.pressure_over_shear}};
  return {{"body", peak.body},
          {"value", peak.von_mises},
          {"place", numbers(peak.place)},
          {"yield", yield}};
}

/// Return the maximum of a member of the comparisons with yield stresses; null without any.
template <int dim>
Summary::State largest(const state::ContactState<dim> &state, double state::YieldCheck::*member)
{
  Summary::State result;
  for (const auto &peak : state.stress_peaks)
    if (peak.yield.yield_stress > 0.)
      result = std::max(result.is_null() ? 0. : result.get<double>(), peak.yield.*member);
  return result;
}

template <int dim>
Summary::State summary_part(const state::Reaction<dim> &reaction)
{
  return {{"name", reaction.name},
          {"centre", numbers(reaction.centre)},
          {"force", numbers(reaction.force)},
          {"moment", numbers(reaction.moment)}};
}

Summary::State summary_part(const state::BoltState &bolt)
{
  return {{"name", bolt.name}, {"tension", bolt.tension}, {"shortening", bolt.shortening}};
}

Summary::State summary_part(const state::GeometricEffect &effect)
{
  return {{"name", effect.body},
          {"rigid_rotation", effect.rotation},
          {"large_displacements", effect.of_force()}};
}

template <typename Part>
Summary::State array_of(const std::vector<Part> &parts)
{
  auto result = Summary::State::array();
  for (const auto &part : parts)
    result.push_back(summary_part(part));
  return result;
}

template <int dim>
Summary::State of_certificate(const state::ContactState<dim> &state)
{
  const auto    &certificate = state.certificate;
  Summary::State result      = {{"equilibrium", certificate.equilibrium},
                                {"continuity", certificate.continuity},
                                {"penetration", certificate.penetration},
                                {"negative_pressure", certificate.negative_pressure},
                                {"complementarity", certificate.complementarity}};
  if (state.has_friction())
    result.update({{"cone", certificate.cone},
                   {"creep", certificate.creep},
                   {"dissipation", certificate.dissipation}});
  return result;
}

/// Return the numbers of friction; null without friction.
template <int dim>
Summary::State of_friction(const state::ContactState<dim> &state)
{
  if (!state.has_friction())
    return nullptr;
  return {{"slipping_contacts", state.slipping_contacts},
          {"dissipation", state.dissipation},
          {"distance", state.friction_distance}};
}
} // namespace

/// Other tools read the keys: keys may be added, but are never renamed.
template <int dim>
Summary::State summarize(const state::ContactState<dim>                    &state,
                         const std::vector<std::pair<std::string, double>> &responses,
                         const std::optional<Summary::Accuracy>            &accuracy)
{
  Summary::State linear, errors;
  if (state.linear_f_mults > 0) // 0 means that no linear problem was solved for comparison
    linear = state.linear_f_mults;
  if (accuracy)
    errors = {{"error", accuracy->error},
              {"relative", accuracy->relative},
              {"responses", object_of(accuracy->responses)}};
  return {{"least_scaled_jacobian", state.least_scaled_jacobian},
          {"energy", state.energy},
          {"compliance", state.compliance},
          {"strain_energy", state.strain_energy},
          {"contact_force", numbers(state.contact_force)},
          {"contact_area", state.contact_area},
          {"max_pressure", state.max_pressure},
          {"max_von_mises", state.stress_peak().von_mises},
          {"max_displacement", state.displacement_peak.size},
          {"von_mises", array_of(state.stress_peaks)},
          {"yield_utilization", largest(state, &state::YieldCheck::utilization)},
          {"pressure_over_shear_yield", largest(state, &state::YieldCheck::pressure_over_shear)},
          {"active_contacts", state.active_contacts},
          {"weak_contacts", state.weak_contacts},
          {"contact_change_margin", state.contact_change_margin},
          {"outer_iterations", state.dual.outer_iterations},
          {"f_mults", state.f_mults},
          {"linear_f_mults", linear},
          {"method", state.dual.method},
          {"pairs", array_of(state.pairs)},
          {"ties", array_of(state.ties)},
          {"points", array_of(state.points)},
          {"bolts", array_of(state.bolts)},
          {"reactions", array_of(state.reactions)},
          {"load", numbers(state.load)},
          {"balance", numbers(state.balance)},
          {"responses", object_of(responses)},
          {"friction", of_friction(state)},
          {"certificate", of_certificate(state)},
          {"tolerance", state.tolerance},
          {"assumptions",
           {{"rotation", state.validity.rotation},
            {"strain", state.validity.strain},
            {"slip", state.validity.slip},
            {"drift", state.validity.drift},
            {"bodies", array_of(state.validity.geometric)}}},
          {"accuracy", errors}};
}

Summary::Times collect_times(const RunContext &context)
{
  // The stages are in the order of the members of Times.
  std::vector<double> seconds;
  for (const char *stage : stage_names)
    seconds.push_back(context.seconds(stage));
  seconds.push_back(context.seconds());
  // Take the slowest rank of each stage, because all other ranks wait for it.
  MPI_Allreduce(MPI_IN_PLACE, seconds.data(), seconds.size(), MPI_DOUBLE, MPI_MAX,
                context.communicator());
  return {seconds[0], seconds[1], seconds[2], seconds[3], seconds[4],
          seconds[5], seconds[6], seconds[7], seconds[8]};
}

/// Return the memory. Linux counts it in KiB.
Summary::Memory collect_memory(const RunContext &context)
{
  rusage of_this;
  getrusage(RUSAGE_SELF, &of_this);
  const double    here = double(of_this.ru_maxrss) / 1024.;
  Summary::Memory result;
  MPI_Allreduce(&here, &result.largest, 1, MPI_DOUBLE, MPI_MAX, context.communicator());
  MPI_Allreduce(&here, &result.total, 1, MPI_DOUBLE, MPI_SUM, context.communicator());
  std::vector<double> of_stages(1, context.memory_at_start());
  for (const char *stage : stage_names)
    of_stages.push_back(context.memory(stage));
  MPI_Allreduce(MPI_IN_PLACE, of_stages.data(), narrow<int>(of_stages.size()), MPI_DOUBLE, MPI_MAX,
                context.communicator());
  result.stages.emplace_back("start", of_stages[0]);
  for (unsigned int i = 0; i < stage_names.size(); ++i)
    if (of_stages[i + 1] > 0.)
      result.stages.emplace_back(stage_names[i], of_stages[i + 1]);
  return result;
}

template Summary::Mesh  summarize(const mesh::BodyMesh<2> &, const mesh::Tearing &);
template Summary::Mesh  summarize(const mesh::BodyMesh<3> &, const mesh::Tearing &);
template Summary::State summarize(const state::ContactState<2> &,
                                  const std::vector<std::pair<std::string, double>> &,
                                  const std::optional<Summary::Accuracy> &);
template Summary::State summarize(const state::ContactState<3> &,
                                  const std::vector<std::pair<std::string, double>> &,
                                  const std::optional<Summary::Accuracy> &);
} // namespace snug::io
