#include <snug/io/deck_mesh_text.h>
#include <snug/io/element_nodes.h>
#include <snug/io/mesh_export.h>

#include <cctype>
#include <cstdio>
#include <map>

namespace snug::io {
namespace {
/// Return items separated by commas, with @p per_line items on a line.
std::string list_text(const std::vector<std::string> &items, const std::size_t per_line)
{
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i)
    text += items[i] + (i + 1 == items.size() ? "\n" : i % per_line + 1 == per_line ? ",\n" : ", ");
  return text;
}
} // namespace

std::string deck_real(const double x)
{
  const std::size_t longest  = 20;
  std::string       shortest = to_text(x + 0.); // no -0
  if (shortest.size() <= longest)
    return shortest;
  char text[32];
  std::snprintf(text, sizeof text, "%.13e", x);
  return text;
}

std::string deck_name(std::string name)
{
  for (char &c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '_')
      c = '-';
  return name;
}

std::string deck_equation(const std::vector<std::string> &items)
{
  // A line holds up to 4 terms and ends without a comma.
  std::string text = "*EQUATION\n" + std::to_string(items.size()) + '\n';
  for (std::size_t i = 0; i < items.size(); ++i)
    text += items[i] + (i + 1 == items.size() || i % 4 == 3 ? "\n" : ", ");
  return text;
}

template <int dim>
DeckMeshText<dim>::DeckMeshText(const mesh::BodyMesh<dim> &mesh,
                                const scene::Scene        &scene,
                                const WholeMesh<dim>      &whole)
  : mesh(mesh), scene(scene), whole(whole), order(element_nodes(dim, mesh.degree(), Format::abaqus))
{
  for (const auto &cell : whole.cells)
    for (const unsigned int node : in_order(cell.nodes, order))
      used.insert(node);
}

template <int dim>
std::string DeckMeshText<dim>::nodes() const
{
  std::string text = "*NODE, NSET=all\n";
  for (const unsigned int node : used)
    {
      text += deck_number(node);
      for (unsigned int c = 0; c < 3; ++c)
        text += ", " + deck_real(c < dim ? whole.positions[node][c] : 0.);
      text += '\n';
    }
  for (const auto &hanging : whole.hanging)
    for (unsigned int c = 0; c < dim && has(hanging.node); ++c)
      {
        const auto term = [c](const unsigned int node, const double weight) {
          return deck_number(node) + ", " + deck_number(c) + ", " + deck_real(weight);
        };
        std::vector<std::string> items = {term(hanging.node, -1.)};
        for (const auto &[master, weight] : hanging.masters)
          if (has(master))
            items.push_back(term(master, weight));
        text += deck_equation(items);
      }
  return text;
}

template <int dim>
std::string DeckMeshText<dim>::element_type() const
{
  if (dim == 3)
    return mesh.degree() == 1 ? "C3D8" : "C3D20";
  const auto        kind   = mesh.idealization().kind;
  const std::string family = kind == mesh::Idealization::Kind::plane_stress   ? "CPS"
                             : kind == mesh::Idealization::Kind::plane_strain ? "CPE"
                                                                              : "CAX";
  return family + (mesh.degree() == 1 ? "4" : "8");
}

template <int dim>
std::string DeckMeshText<dim>::elements() const
{
  std::string                                     text;
  std::map<std::string, std::vector<std::string>> of_bodies;
  const typename WholeMesh<dim>::Cell            *previous = nullptr;
  for (unsigned int c = 0; c < whole.cells.size(); ++c)
    {
      const auto &cell = whole.cells[c];
      const auto  name = deck_name(region_name(mesh, scene, whole, cell.body, cell.region));
      if (!previous || previous->body != cell.body || previous->region != cell.region)
        text += "*ELEMENT, TYPE=" + element_type() + ", ELSET=" + name + '\n';
      previous                       = &cell;
      std::vector<std::string> items = {deck_number(c)};
      for (const unsigned int node : in_order(cell.nodes, order))
        items.push_back(deck_number(node));
      // At most 16 numbers fit on a line.
      text += list_text(items, 15);
      if (whole.regions.at(cell.body).size() > 1)
        of_bodies[deck_name(scene.bodies[cell.body].name)].push_back(deck_number(c));
    }
  for (const auto &[body, elements] : of_bodies)
    text += "*ELSET, ELSET=" + body + '\n' + list_text(elements, 15);
  return text;
}

template <int dim>
std::string DeckMeshText<dim>::side(const typename WholeMesh<dim>::Face &face) const
{
  // Names of the sides x-, x+, y-, y+, z-, z+
  static const std::string plane[4] = {"S4", "S2", "S1", "S3"},
                           solid[6] = {"S6", "S4", "S3", "S5", "S1", "S2"};
  return deck_number(face.cell) + ", " + (dim == 2 ? plane[face.number] : solid[face.number]) +
         '\n';
}

template <int dim>
std::string DeckMeshText<dim>::sets() const
{
  // CalculiX accepts no node in *BOUNDARY that *EQUATION eliminates.
  std::set<unsigned int> eliminated;
  for (const auto &hanging : whole.hanging)
    eliminated.insert(hanging.node);
  std::map<std::string, std::set<unsigned int>> nodes;
  std::map<std::string, std::string>            faces;
  for (const auto &face : whole.faces)
    {
      const auto name = deck_name(boundary_name(mesh, scene, face.body, face.boundary));
      for (const unsigned int node : face.nodes)
        if (has(node) && eliminated.count(node) == 0)
          nodes[name].insert(node);
      faces[name] += side(face);
    }
  std::string text;
  for (const auto &[name, of_boundary] : nodes)
    {
      std::vector<std::string> items;
      for (const unsigned int node : of_boundary)
        items.push_back(deck_number(node));
      text += "*NSET, NSET=" + name + '\n' + list_text(items, 15) + "*SURFACE, NAME=" + name +
              ", TYPE=ELEMENT\n" + faces[name];
    }
  return text;
}

template class DeckMeshText<2>;
template class DeckMeshText<3>;
} // namespace snug::io
