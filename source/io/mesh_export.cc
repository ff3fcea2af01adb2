#include <snug/io/element_nodes.h>
#include <snug/io/mesh_export.h>
#include <snug/io/text_file.h>

#include <map>

namespace snug::io {
template <int dim>
std::string boundary_name(const mesh::BodyMesh<dim> &mesh,
                          const scene::Scene        &scene,
                          const unsigned int         body,
                          const unsigned int         boundary)
{
  return scene.bodies[body].name + '.' + mesh.geometry(body).boundary_names()[boundary];
}

template <int dim>
std::string region_name(const mesh::BodyMesh<dim> &mesh,
                        const scene::Scene        &scene,
                        const WholeMesh<dim>      &whole,
                        const unsigned int         body,
                        const unsigned int         region)
{
  const auto &name = scene.bodies[body].name;
  return whole.regions.at(body).size() == 1
           ? name
           : name + '.' + mesh.geometry(body).region_names()[region];
}

namespace {
/// Return the line of an element of .msh 2.2: number, type, 2 tags (group and entity), nodes.
std::string element_line(const unsigned int               number,
                         const unsigned int               type,
                         const unsigned int               tag,
                         const std::vector<unsigned int> &nodes)
{
  std::string line = std::to_string(number) + ' ' + std::to_string(type) + " 2 " +
                     std::to_string(tag) + ' ' + std::to_string(tag);
  for (const unsigned int node : nodes)
    line += ' ' + std::to_string(node + 1);
  return line + '\n';
}
} // namespace

template <int dim>
std::string
msh_text(const mesh::BodyMesh<dim> &mesh, const scene::Scene &scene, const WholeMesh<dim> &whole)
{
  // {dimension, name} -> number of the physical group
  std::map<std::pair<unsigned int, std::string>, unsigned int> tags;
  const auto tag = [&](const unsigned int d, const std::string &name) {
    return tags.emplace(std::make_pair(d, name), tags.size() + 1).first->second;
  };
  // Types of Gmsh of lines, quadrilaterals and hexahedra of degrees 1 and 2
  const unsigned int types[3][2] = {{1, 8}, {3, 10}, {5, 12}};
  const unsigned int degree      = mesh.degree();
  const auto         face_order  = element_nodes(dim - 1, degree, Format::gmsh);
  const auto         cell_order  = element_nodes(dim, degree, Format::gmsh);
  std::string        elements;
  unsigned int       n = 0;
  for (const auto &face : whole.faces)
    elements += element_line(++n, types[dim - 2][degree - 1],
                             tag(dim - 1, boundary_name(mesh, scene, face.body, face.boundary)),
                             in_order(face.nodes, face_order));
  for (const auto &cell : whole.cells)
    elements += element_line(++n, types[dim - 1][degree - 1],
                             tag(dim, region_name(mesh, scene, whole, cell.body, cell.region)),
                             in_order(cell.nodes, cell_order));
  std::string text =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" + std::to_string(tags.size()) + '\n';
  for (const auto &[name, number] : tags)
    text +=
      std::to_string(name.first) + ' ' + std::to_string(number) + " \"" + name.second + "\"\n";
  text += "$EndPhysicalNames\n$Nodes\n" + std::to_string(whole.positions.size()) + '\n';
  for (unsigned int node = 0; node < whole.positions.size(); ++node)
    {
      text += std::to_string(node + 1);
      for (unsigned int c = 0; c < 3; ++c)
        text += ' ' + exact(c < dim ? whole.positions[node][c] : 0.);
      text += '\n';
    }
  return text + "$EndNodes\n$Elements\n" + std::to_string(n) + '\n' + elements + "$EndElements\n";
}

#define SNUG_INSTANTIATE(dim)                                                           \
  template std::string boundary_name(const mesh::BodyMesh<dim> &, const scene::Scene &, \
                                     unsigned int, unsigned int);                       \
  template std::string region_name(const mesh::BodyMesh<dim> &, const scene::Scene &,   \
                                   const WholeMesh<dim> &, unsigned int, unsigned int); \
  template std::string msh_text(const mesh::BodyMesh<dim> &, const scene::Scene &,      \
                                const WholeMesh<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::io
