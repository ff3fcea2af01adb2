#include <snug/app/model_report.h>
#include <snug/contact/pair_geometry.h>
#include <snug/geometry/imported_mesh.h>
#include <snug/io/mesh_summary.h>
#include <snug/state/symmetry_planes.h>
#include <snug/state/validity_checks.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>

namespace snug::app {
namespace {
/// Slave sides of tied pairs of which a smaller part faces the other side cause a warning.
const double least_tied_share = 0.99;

/// Return a line for each face with components that are free in the scene, prescribed by load
/// cases, and held at zero in other load cases.
std::vector<std::string> held_face_notes(const scene::Scene &scene)
{
  using Names = std::vector<std::string>;
  std::map<std::pair<std::string, std::string>, Names> prescribing; // face, component -> load cases
  for (const auto &load_case : scene.load_cases)
    for (const auto &[face, motion] : loads_on_faces(scene, load_case.loads).displacements)
      prescribing[{face, scene::split_displacement(motion).first}].push_back(load_case.name);
  std::map<std::string, std::pair<Names, Names>> faces; // held and prescribing load cases
  for (const auto &[where, cases] : prescribing)
    for (const auto &name : scene::names_of(scene.load_cases))
      {
        auto &[held, by]  = faces[where.first];
        const auto add_to = [&name](Names &list) {
          if (std::find(list.begin(), list.end(), name) == list.end())
            list.push_back(name);
        };
        const bool prescribes = std::find(cases.begin(), cases.end(), name) != cases.end();
        add_to(prescribes ? by : held);
      }
  const auto text = [](const Names &cases) {
    return "load case '" + cases.front() + "'" +
           (cases.size() > 1 ? " and " + counted(cases.size() - 1, "other load case") : "");
  };
  std::vector<std::string> lines;
  for (const auto &[face, cases] : faces)
    if (!cases.first.empty())
      lines.push_back(
        "face '" + face + "' is held in " + text(cases.first) + ", because " + text(cases.second) +
        (cases.second.size() > 1 ? " prescribe" : " prescribes") + " its displacement");
  return lines;
}

/// Print the kinds of the surfaces of a side, and their distance from the mesh.
template <int dim>
void print_side(const ShapeProblem<dim> &problem, const contact::Side &side, std::ostream &out)
{
  const faces::FaceShape<dim> shape(problem.mesh->degree());
  double                      height = contact::face_height(problem.solver->surface(), shape, side);
  std::string                 names;
  for (const auto &[body, boundary] : side.boundaries())
    {
      const auto kind = problem.mesh->geometry(body).boundary_shape(boundary);
      height          = std::max(height, kind.facet_height);
      if (names.find(kind.name) == std::string::npos)
        names += (names.empty() ? "" : ", ") + kind.name;
    }
  out << names;
  if (height > 0.)
    out << ", maximum chordal deviation of facets " << height;
}

/// Return the areas that the rows of each pair cover as parts of the areas of the slave sides.
template <int dim>
std::vector<double> facing_shares(const ShapeProblem<dim>     &problem,
                                  const contact::Contact<dim> &contact)
{
  const auto         &surface = problem.solver->surface();
  const auto          x       = surface.gather(problem.positions(problem.shapes->start()));
  const auto          areas   = contact.areas(x);
  std::vector<double> shares(contact.pairs().size(), 0.);
  for (unsigned int i = 0; i < areas.size(); ++i)
    shares[contact.places()[i].pair] += areas[i];
  for (unsigned int p = 0; p < shares.size(); ++p)
    shares[p] /= io::area_of(problem.mesh->degree(), surface, contact.pairs()[p].slave, x);
  return shares;
}

/// Return the maximum load per area of a boundary: that of pressure and traction at the centres of
/// the faces, plus the mean of the total force. Collective.
template <int dim>
double largest_load(const mesh::BodyMesh<dim>      &mesh,
                    const contact::Boundary        &boundary,
                    const state::BoundaryLoad<dim> &load)
{
  double largest = 0.;
  for (const auto &face : mesh.boundary_faces())
    if (face.body == boundary.first && face.boundary == boundary.second)
      try
        {
          dealii::Point<dim> centre;
          for (const unsigned int node : face.nodes)
            centre += mesh.reference_positions()[node] / double(face.nodes.size());
          if (load.pressure)
            largest = std::max(largest, std::abs(load.pressure(centre)));
          if (load.traction)
            largest = std::max(largest, load.traction(centre).norm());
        }
      catch (const InputError &)
        {
          // The load need not be finite here, because it is integrated at other points.
        }
  largest            = dealii::Utilities::MPI::max(largest, mesh.communicator());
  const double force = load.resultant.force.norm();
  // A boundary on the axis of revolution has no area, and no total force.
  if (force == 0.)
    return largest;
  const mesh::Surface<dim> surface(mesh, {boundary});
  return largest +
         force / io::area_of<dim>(mesh.degree(), surface, boundary, surface.reference_positions());
}

/// Return a warning for each boundary whose loads per area exceed Young's modulus of its body, as
/// in a mix-up of units. Collective.
template <int dim>
std::vector<Warning> load_warnings(const mesh::BodyMesh<dim> &mesh, const state::Model<dim> &model)
{
  std::vector<Warning> result;
  for (const auto &load_case : model.load_cases)
    for (unsigned int b = 0; b < load_case.bodies.size(); ++b)
      for (const auto &[boundary, load] : load_case.bodies[b].boundaries)
        {
          const double largest = largest_load<dim>(mesh, {b, boundary}, load);
          double       modulus = 0.;
          for (const auto &material : model.bodies[b].materials)
            modulus = std::max(modulus, material.youngs_modulus);
          std::ostringstream text;
          text.precision(3);
          text << "the load per area of '" << model.body_names[b] << '.'
               << mesh.geometry(b).boundary_names()[boundary] << "' is up to " << largest
               << ", but 'Young's modulus' is " << modulus
               << ": check the units of 'Pressure', 'Traction', 'Force' and 'Young's modulus'";
          if (largest > modulus)
            result.push_back({"load", text.str(), largest, modulus});
        }
  return result;
}

/// Return the range of the gaps of a pair, with 0 for a minimum that is round-off.
std::string without_round_off(const contact::PairedGaps &gaps)
{
  std::ostringstream text;
  text << (std::abs(gaps.least) <= 1e-12 * gaps.largest ? 0. : gaps.least) << " to "
       << gaps.largest;
  return text.str();
}

/// Print each joined pair and its surfaces. The @p place ends the name of the pair.
template <int dim>
void print_pairs(const ShapeProblem<dim>     &problem,
                 const contact::Contact<dim> &contact,
                 const bool                   tied,
                 const std::string           &place,
                 std::ostream                &out)
{
  const auto               &pairs  = contact.pairs();
  const auto                shares = facing_shares(problem, contact);
  std::vector<unsigned int> rows(pairs.size(), 0);
  for (const auto &of : contact.places())
    ++rows[of.pair];
  for (unsigned int p = 0; p < pairs.size(); ++p)
    {
      out << (tied ? "tied " : "contact ") << pairs[p].name() << place << ", ";
      const auto &matching = contact.matchings()[p];
      if (pairs[p].obstacle)
        out << "obstacle";
      else
        {
          out << to_text(*pairs[p].parameters.method) << ", ";
          if (matching.complete())
            out << "matching meshes";
          else
            out << "non-matching meshes (" << matching.n_matching << " of "
                << counted(matching.n_nodes, "slave node") << " on a master node)";
        }
      out << ", " << counted(rows[p], tied ? "node" : "contact condition") << ", initial gap "
          << without_round_off(contact.paired_gaps()[p]) << ", "
          << std::round(100. * std::min(1., shares[p]))
          << " % of the slave side faces the other side"
          << "\n  " << pairs[p].slave_name << ": ";
      print_side(problem, pairs[p].slave, out);
      out << "; " << pairs[p].master_name << ": ";
      if (pairs[p].obstacle)
        out << pairs[p].obstacle->shape;
      else
        print_side(problem, pairs[p].master, out);
      out << std::endl;
    }
}
} // namespace

void print_notes(const scene::Scene &scene, std::ostream &out)
{
  for (const auto &body : scene.bodies)
    if (body.mesh.imported)
      for (const auto &note : body.mesh.imported->notes)
        out << "body " << body.name << ", " << body.mesh.file << ": " << note << '\n';
  for (const auto &line : held_face_notes(scene))
    out << line << '\n';
}

template <int dim>
void print_pairs(const ShapeProblem<dim> &problem)
{
  const auto &solver    = *problem.solver;
  const auto  positions = solver.positions();
  for (const unsigned int c : positions)
    print_pairs(problem, solver.contact(c), false,
                positions.size() > 1 ? state::place_of(solver.model(), c) : "",
                problem.context.out(c > 0 ? Verbosity::debug : Verbosity::normal));
  if (const auto *ties = solver.ties().paired())
    print_pairs(problem, *ties, true, "", problem.context.out());
}

template <int dim>
io::Json pairs_part(const ShapeProblem<dim> &problem)
{
  io::Json   part = io::Json::array();
  const auto add  = [&](const contact::Contact<dim> &contact, const unsigned int c,
                       const std::string &rows) {
    const auto  shares = facing_shares(problem, contact);
    const auto &places = contact.places();
    for (unsigned int p = 0; p < contact.pairs().size(); ++p)
      {
        const auto &gaps = contact.paired_gaps()[p];
        part.push_back({{"name", contact.pairs()[p].name()},
                        {"load_case", problem.solver->model().load_cases[c].name},
                        {rows, std::count_if(places.begin(), places.end(),
                                              [p](const auto &place) { return place.pair == p; })},
                        {"gap", {gaps.least, gaps.largest}},
                        {"facing", std::min(1., shares[p])}});
      }
  };
  for (const unsigned int c : problem.solver->positions())
    add(problem.solver->contact(c), c, "contact_conditions");
  if (const auto *ties = problem.solver->ties().paired())
    add(*ties, 0, "tied_nodes");
  return part;
}

template <int dim>
void warn_of_model(const ShapeProblem<dim> &problem)
{
  auto       &context = problem.context;
  const auto &solver  = *problem.solver;
  const auto  warn    = [&context](const std::vector<Warning> &warnings) {
    for (const auto &warning : warnings)
      context.warn(warning);
  };
  for (const unsigned int c : solver.positions())
    {
      const auto &contact = solver.contact(c);
      context.warn("symmetry plane",
                   state::symmetry_warnings(*problem.mesh, solver.model().supports,
                                            contact.pairs()));
      warn(state::matching_warnings(contact.pairs(), contact.matchings()));
      warn(state::overlap_warnings(contact.pairs(), contact.paired_gaps(),
                                   state::place_of(solver.model(), c)));
      warn(state::friction_warnings(contact));
    }
  if (const auto *ties = solver.ties().paired())
    {
      const auto shares = facing_shares(problem, *ties);
      for (unsigned int p = 0; p < shares.size(); ++p)
        if (shares[p] < least_tied_share)
          warn({{"ties",
                 "only " + to_text(std::round(1000. * shares[p]) / 10.) +
                   " % of the slave side of the tied pair '" + ties->pairs()[p].name() +
                   "' faces the other side: the rest is free",
                 shares[p], least_tied_share}});
    }
  warn(load_warnings(*problem.mesh, solver.model()));
}

#define SNUG_INSTANTIATE(dim)                               \
  template void     print_pairs(const ShapeProblem<dim> &); \
  template io::Json pairs_part(const ShapeProblem<dim> &);  \
  template void     warn_of_model(const ShapeProblem<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
