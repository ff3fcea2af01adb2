#include <snug/io/deck_mesh_text.h>
#include <snug/io/mesh_export.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace snug::io {
namespace {
/// Ratio of the contact stiffness [force/length^3] to Young's modulus over the face size. The
/// penetration is then p h / (100 E), where the pressure p compresses a cell of size h by about
/// p h / E.
const double contact_penalty = 100.;

/// Return a number of a formula without variables.
std::optional<double> constant(const std::string &formula)
{
  try
    {
      double value = 0.;
      from_text(formula, value);
      return value;
    }
  catch (const std::invalid_argument &)
    {
      return {};
    }
}

/// This class writes a deck.
template <int dim>
class DeckWriter
{
public:
  using Frames = typename supports::DirichletConstraints<dim>::Frames;

  DeckWriter(const state::StateSolver<dim> &solver,
             const scene::Scene            &scene,
             const WholeMesh<dim>          &whole,
             const Frames                  &frames)
    : solver(solver)
    , mesh(solver.mesh())
    , scene(scene)
    , whole(whole)
    , frames(frames)
    , mesh_text(solver.mesh(), scene, whole)
  {
    const auto &model = solver.model().load_cases.front();
    if (!scene.load_cases.empty())
      of_load_case = loads_on_faces(scene, scene.load_cases.front().loads);
    if (scene.load_cases.size() > 1)
      left_out.push_back("load cases after '" + model.name + "'");
    if (!(model.position == contact::Position<dim>()))
      left_out.push_back("'Position' of load case '" + model.name + "'");
    if (!solver.model().springs.empty())
      left_out.push_back("springs");
    if (!solver.model().points.empty())
      left_out.push_back("reference points and bolts");
    if (is_heated())
      left_out.push_back("temperatures, instead of which it has the forces of the thermal strains");
  }

  DeckExport result()
  {
    out += mesh_text.nodes() + mesh_text.elements() + mesh_text.sets();
    if (mesh.degree() == 2 && !whole.hanging.empty())
      left_out.push_back("masters of hanging nodes in the middles of faces");
    write_materials();
    write_contacts();
    write_ties();
    write_supports();
    out += "*STEP\n*STATIC\n1., 1.\n";
    write_loads();
    out += "*NODE FILE\nU, RF\n*EL FILE\nS\n";
    if (has_contacts)
      out += "*CONTACT FILE\nCDIS, CSTR\n";
    out += "*END STEP\n";
    std::string text = "*HEADING\nModel of Snug at the positions of its nodes without a load\n";
    for (const auto &line : left_out)
      text += "** not in this deck: " + line + '\n';
    return {text + out, left_out};
  }

private:
  const state::StateSolver<dim> &solver;
  const mesh::BodyMesh<dim>     &mesh;
  const scene::Scene            &scene;
  const WholeMesh<dim>          &whole;
  const Frames                  &frames;
  const DeckMeshText<dim>        mesh_text;
  std::string                    out;
  std::vector<std::string>       left_out;
  bool                           has_contacts = false;
  scene::LoadParameters          of_load_case; ///< on faces, in the first load case

  void write_materials()
  {
    for (unsigned int b = 0; b < scene.bodies.size(); ++b)
      for (unsigned int r = 0; r < solver.model().bodies[b].materials.size(); ++r)
        {
          if (whole.regions.at(b).count(r) == 0)
            continue;
          const auto  name     = deck_name(region_name(mesh, scene, whole, b, r));
          const auto &material = solver.model().bodies[b].materials[r];
          out += "*MATERIAL, NAME=" + name + "\n*ELASTIC\n" + deck_real(material.youngs_modulus) +
                 ", " + deck_real(material.poissons_ratio) + '\n';
          if (material.density > 0.)
            out += "*DENSITY\n" + deck_real(material.density) + '\n';
          out += "*SOLID SECTION, ELSET=" + name + ", MATERIAL=" + name + '\n';
          if (dim == 2 && !mesh.idealization().is_axisymmetric())
            out += deck_real(scene.thickness) + '\n';
        }
  }

  /// Return the mean size of the faces of a side: the square root of the area between their
  /// corners, or their length.
  double face_size(const contact::Side &side) const
  {
    const unsigned int n     = mesh.degree() + 1;
    double             sum   = 0.;
    unsigned int       count = 0;
    for (const auto &face : whole.faces)
      if (contact::is_on(face, side))
        {
          const auto &first = whole.positions[face.nodes.front()];
          const auto  along = whole.positions[face.nodes[n - 1]] - first;
          ++count;
          if (dim == 2)
            sum += along.norm();
          else
            sum += std::sqrt(along.norm() *
                             (whole.positions[face.nodes[face.nodes.size() - n]] - first).norm());
        }
    return count == 0 ? 1. : sum / count;
  }

  /// Return the surface of a side, which is written first if the side has several boundaries.
  std::string surface_of(const contact::Side &side, const std::string &name)
  {
    if (side.boundaries().size() == 1)
      return deck_name(
        boundary_name(mesh, scene, side.boundaries()[0].first, side.boundaries()[0].second));
    out += "*SURFACE, NAME=" + name + ", TYPE=ELEMENT\n";
    for (const auto &face : whole.faces)
      if (contact::is_on(face, side))
        out += mesh_text.side(face);
    return name;
  }

  void write_contacts()
  {
    unsigned int n = 0;
    for (const auto &pair : solver.contact(0).named_pairs())
      {
        ++n;
        if (pair.obstacle)
          {
            left_out.push_back("contact " + pair.name() + " with an obstacle");
            continue;
          }
        double modulus = 0.;
        for (const auto &side : {pair.slave, pair.master})
          for (const auto &material : solver.model().bodies[side.body()].materials)
            modulus = std::max(modulus, material.youngs_modulus);
        const auto        id     = std::to_string(n);
        const std::string slave  = surface_of(pair.slave, "slave-" + id),
                          master = surface_of(pair.master, "master-" + id);
        const double stiffness   = contact_penalty * modulus / face_size(pair.slave);
        out += "*SURFACE INTERACTION, NAME=contact-" + id +
               "\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n" + deck_real(stiffness) + '\n';
        write_friction(pair, stiffness);
        out += "*CONTACT PAIR, INTERACTION=contact-" + id + ", TYPE=SURFACE TO SURFACE\n" + slave +
               ", " + master + '\n';
        has_contacts = true;
        if (pair.parameters.gap != "0")
          left_out.push_back("'Gap' of contact " + pair.name());
      }
  }

  /// Write tied pairs. Pairs without a search distance are tied across any gap.
  void write_ties()
  {
    double largest = 0.; // distance of two nodes, or more
    for (const auto &position : whole.positions)
      largest = std::max(largest, 2. * (position - whole.positions.front()).norm());
    unsigned int n = 0;
    for (const auto &pair : solver.ties().named_pairs())
      {
        const std::string id     = "tie-" + std::to_string(++n);
        const std::string slave  = surface_of(pair.slave, id + "-slave");
        const std::string master = surface_of(pair.master, id + "-master");
        const double      reach  = pair.parameters.search_distance;
        out += "*TIE, NAME=" + id +
               ", ADJUST=NO, POSITION TOLERANCE=" + deck_real(reach > 0. ? reach : largest) + '\n' +
               slave + ", " + master + '\n';
      }
  }

  void write_friction(const contact::NamedPair &pair, const double stiffness)
  {
    if (!pair.parameters.has_friction())
      return;
    const auto coefficient = constant(pair.parameters.friction_coefficient);
    if (pair.parameters.friction != contact::Friction::Coulomb || !coefficient)
      return left_out.push_back("friction of contact " + pair.name() +
                                ", which has no constant coefficient");
    if (*coefficient > 0.)
      out += "*FRICTION\n" + deck_real(*coefficient) + ", " + deck_real(stiffness) + '\n';
  }

  /// The loads and prescribed displacements of the bodies and of the first load case, with the
  /// names of the bodies in front of the boundaries.
  std::vector<std::pair<std::string, const scene::LoadParameters *>> load_parameters() const
  {
    std::vector<std::pair<std::string, const scene::LoadParameters *>> result;
    for (const auto &body : scene.bodies)
      result.emplace_back(body.name + ".", &body.loads);
    if (!scene.load_cases.empty())
      result.emplace_back("", &of_load_case);
    return result;
  }

  /// Write supports and prescribed displacements by node sets if all of them are constants along
  /// axes, otherwise node by node.
  void write_supports()
  {
    std::string by_sets;
    bool        is_simple = true;
    for (const auto &body : scene.bodies)
      is_simple = is_simple && body.point_supports.empty();
    for (const auto &body : scene.bodies)
      for (const auto &[boundary, words] : body.supports)
        for (const unsigned int c : scene::component_list(words, dim))
          {
            is_simple = is_simple && c < dim;
            by_sets += deck_name(body.name + '.' + boundary) + ", " + deck_number(c) + ", " +
                       deck_number(c) + '\n';
          }
    for (const auto &[prefix, loads] : load_parameters())
      for (const auto &[boundary, text] : loads->displacements)
        {
          const auto [name, formula] = scene::split_displacement(text);
          const unsigned int c       = scene::component_number(name, dim);
          const auto         value   = constant(formula);
          is_simple                  = is_simple && c < dim && value;
          by_sets += deck_name(prefix + boundary) + ", " + deck_number(c) + ", " + deck_number(c) +
                     ", " + deck_real(value.value_or(0.)) + '\n';
        }
    if (!is_simple)
      write_held_nodes();
    else if (!by_sets.empty())
      out += "*BOUNDARY\n" + by_sets;
  }

  /// Return the components of a direction that are not round-off, the largest one first, because
  /// CalculiX eliminates the first term of an equation.
  static std::vector<unsigned int> components_of(const dealii::Tensor<1, dim> &d)
  {
    const double              round_off = 1e-12;
    std::vector<unsigned int> components;
    for (unsigned int c = 0; c < dim; ++c)
      if (std::abs(d[c]) > round_off)
        components.push_back(c);
    std::sort(components.begin(), components.end(),
              [&](const unsigned int a, const unsigned int b) {
                return std::abs(d[a]) > std::abs(d[b]);
              });
    return components;
  }

  /// Write d.u = value at each held node: *BOUNDARY along axes, otherwise *EQUATION.
  void write_held_nodes()
  {
    const auto                          &held = solver.held();
    std::map<unsigned int, unsigned int> nodes; // node -> held node
    for (unsigned int global = 0; global < whole.number_of.size(); ++global)
      if (held.find(global) < held.n_nodes() && mesh_text.has(whole.number_of[global]))
        nodes[whole.number_of[global]] = held.find(global);
    std::string along_axes, equations;
    for (const auto &[node, index] : nodes)
      for (unsigned int j = 0; j < frames.directions(index).size(); ++j)
        {
          const auto  &d     = frames.directions(index)[j];
          const double value = frames.value(index, j, 0);
          const auto   terms = components_of(d);
          if (terms.size() == 1)
            {
              const auto c = deck_number(terms[0]);
              along_axes += deck_number(node) + ", " + c + ", " + c + ", " +
                            deck_real(value / d[terms[0]]) + '\n';
              continue;
            }
          std::vector<std::string> items;
          for (const unsigned int c : terms)
            items.push_back(deck_number(node) + ", " + deck_number(c) + ", " + deck_real(d[c]));
          equations += deck_equation(items);
          if (value != 0.)
            left_out.push_back("prescribed displacement " + deck_real(value) +
                               " along an oblique direction at node " + deck_number(node));
        }
    out += equations + (along_axes.empty() ? "" : "*BOUNDARY\n" + along_axes);
  }

  bool is_heated() const
  {
    const auto &bodies = solver.model().load_cases.front().bodies;
    return std::any_of(bodies.begin(), bodies.end(),
                       [](const auto &body) { return bool(body.temperature); });
  }

  /// Return constant pressures and gravity as text; nothing if there are other loads.
  std::optional<std::string> simple_loads() const
  {
    std::string text;
    for (const auto &[prefix, loads] : load_parameters())
      {
        if (!loads->traction.empty() || !loads->force.empty() || !loads->moment.empty() ||
            !loads->point_forces.empty() || !loads->line_forces.empty() || is_heated())
          return {};
        for (const auto &[boundary, formula] : loads->pressure)
          {
            const auto value = constant(formula);
            if (!value)
              return {};
            text += "*DSLOAD\n" + deck_name(prefix + boundary) + ", P, " + deck_real(*value) + '\n';
          }
      }
    for (unsigned int b = 0; b < scene.bodies.size(); ++b)
      {
        if (!scene.bodies[b].body_force.empty())
          return {};
        const auto &gravity = solver.model().load_cases.front().bodies[b].gravity;
        if (gravity.norm() == 0.)
          continue;
        text +=
          "*DLOAD\n" + deck_name(scene.bodies[b].name) + ", GRAV, " + deck_real(gravity.norm());
        for (unsigned int c = 0; c < 3; ++c)
          text += ", " + deck_real(c < dim ? gravity[c] / gravity.norm() : 0.);
        text += '\n';
      }
    return text;
  }

  void write_loads()
  {
    if (const auto text = simple_loads())
      {
        out += *text;
        return;
      }
    if (mesh.degree() == 2)
      return left_out.push_back("loads other than constant pressures and gravity, because the "
                                "elements have no nodes in the middles of faces");
    out += "*CLOAD\n";
    for (const unsigned int node : mesh_text.used_nodes())
      for (unsigned int c = 0; c < dim; ++c)
        if (whole.forces[node][c] != 0.)
          out += deck_number(node) + ", " + deck_number(c) + ", " +
                 deck_real(whole.forces[node][c]) + '\n';
  }
};
} // namespace

template <int dim>
DeckExport deck_text(const state::StateSolver<dim>                              &solver,
                     const scene::Scene                                         &scene,
                     const WholeMesh<dim>                                       &whole,
                     const typename supports::DirichletConstraints<dim>::Frames &frames)
{
  return DeckWriter<dim>(solver, scene, whole, frames).result();
}

template DeckExport deck_text(const state::StateSolver<2> &,
                              const scene::Scene &,
                              const WholeMesh<2> &,
                              const supports::DirichletConstraints<2>::Frames &);
template DeckExport deck_text(const state::StateSolver<3> &,
                              const scene::Scene &,
                              const WholeMesh<3> &,
                              const supports::DirichletConstraints<3>::Frames &);
} // namespace snug::io
