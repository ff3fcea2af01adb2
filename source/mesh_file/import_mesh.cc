#include <snug/geometry/cell_numbering.h>
#include <snug/geometry/entry_values.h>
#include <snug/mesh_file/curved_blocks.h>
#include <snug/mesh_file/file_cells.h>
#include <snug/mesh_file/import_mesh.h>
#include <snug/mesh_file/mesh_text.h>

#include <set>

namespace snug::mesh_file {
namespace {
using Element = MeshFile::Element;
using Corners = std::vector<unsigned int>;
using geometry::index_in;
using geometry::sorted;

/// This class makes the blocks of one body from the elements of a file.
template <int dim>
class Importer
{
public:
  Importer(const MeshFile &file, const geometry::BodyMeshParameters &parameters)
    : parameters(parameters), file(file), points(file.points)
  {}

  geometry::BlockMesh<dim> blocks()
  {
    cells = body_cells<dim>(file, parameters.regions, notes);
    for (const auto &cell : cells)
      // If one cell is split, all cells are split, because otherwise the middles of its edges would
      // be hanging nodes of its neighbours.
      if (!is_cell_shape(cell.shape) && !split)
        split = std::make_unique<ElementSplit>(points);
    add_blocks();
    // Parts of split elements agree on the directions of edges, which lead from corners to middles
    // of edges, faces and elements.
    if (!split && !geometry::order_consistently(mesh))
      {
        notes.push_back("edges of the cells have no consistent directions");
        split = std::make_unique<ElementSplit>(points);
        mesh  = geometry::BlockMesh<dim>();
        add_blocks();
      }
    collect_faces();
    name_boundaries();
    curve_boundaries();
    drop_unused_points();
    // Each block is one coarse cell, which Refinements refine.
    mesh.cells.fill(1);
    return mesh;
  }

  std::vector<std::string> notes;

private:
  const geometry::BodyMeshParameters &parameters;
  const MeshFile                     &file;
  std::vector<dealii::Point<3>>       points;
  std::vector<Element>                cells;
  std::unique_ptr<ElementSplit>       split; ///< null: no element is split
  geometry::BlockMesh<dim>            mesh;
  /// faces -> number of cells that share the face
  std::map<Corners, unsigned int> n_cells_of_face;

  std::vector<Corners> parts(const Element &element)
  {
    return SplitCells{cells, split.get()}.parts(element);
  }

  /// Return the group that is the region of a cell: the group that has a material, or the last
  /// group if none has one.
  std::string region_of(const Element &cell) const
  {
    const auto &named = parameters.named_regions;
    std::string found;
    for (const auto &group : cell.groups)
      if (std::find(named.begin(), named.end(), group) != named.end())
        {
          if (!found.empty() && found != group)
            throw element_error(cell, "belongs to the regions '" + found + "' and '" + group +
                                        "', which both have a material");
          found = group;
        }
    if (!found.empty())
      return found;
    return cell.groups.empty() ? "body" : cell.groups.back();
  }

  void add_blocks()
  {
    for (const auto &cell : cells)
      {
        // All groups are regions, so that Materials may contain a group without cells of its own.
        for (const auto &group : cell.groups)
          index_in(mesh.region_names, group);
        const auto region = index_in(mesh.region_names, region_of(cell));
        for (const auto &part : parts(cell))
          {
            mesh.blocks.push_back(part);
            mesh.regions.push_back(region);
          }
      }
    if (split)
      notes.push_back(count_shapes(cells) + " split into " + std::to_string(mesh.blocks.size()) +
                      (dim == 3 ? " hexahedra" : " quadrilaterals"));
  }

  void collect_faces()
  {
    const unsigned int parts_each = mesh.blocks.size() / cells.size(); // for the message only
    for (unsigned int b = 0; b < mesh.blocks.size(); ++b)
      for (const unsigned int f : dealii::GeometryInfo<dim>::face_indices())
        // This check also finds cells that occur twice in the file.
        if (++n_cells_of_face[sorted(geometry::face_of<dim>(mesh.blocks[b], f))] > 2)
          throw element_error(cells[std::min<std::size_t>(b / parts_each, cells.size() - 1)],
                              "or a neighbour of it shares a face with two "
                              "other elements");
  }

  /// Return the name of the boundary that contains an element.
  std::string name_of(const Element &element) const
  {
    // The entry gives names to groups without a name, and may rename other groups.
    const std::string &group = element.groups.back();
    const auto         given = parameters.boundary_numbers.find(group);
    if (given != parameters.boundary_numbers.end())
      return given->second;
    if (file.unnamed.count(group) > 0)
      throw element_error(element, "belongs to group " + group +
                                     ", which has no name in the file; set 'Boundary names = " +
                                     group + ": NAME'");
    // These characters separate items in lists of a parameter file.
    if (group.find_first_of(",:;=#\\") != std::string::npos)
      throw element_error(element, "belongs to the group '" + group +
                                     "'; names must not contain , : ; = # or \\");
    return group;
  }

  void name_boundaries()
  {
    for (const auto &element : file.elements)
      if (dimension(element.shape) == dim - 1 && !element.groups.empty())
        for (const auto &part : parts(element))
          {
            const Corners key   = sorted(part);
            const auto    found = n_cells_of_face.find(key);
            if (found == n_cells_of_face.end())
              {
                if (parameters.regions.empty())
                  throw element_error(element, "is not a face of a cell");
                continue; // a face of another region
              }
            if (found->second == 2)
              continue; // a face between regions
            const unsigned int boundary = index_in(mesh.boundary_names, name_of(element));
            const auto         entry    = mesh.boundaries.emplace(key, boundary);
            if (!entry.second && entry.first->second != boundary)
              throw element_error(element, "belongs to the groups '" +
                                             mesh.boundary_names[entry.first->second] + "' and '" +
                                             mesh.boundary_names[boundary] + "'");
          }
    for (const auto &entry : n_cells_of_face)
      if (entry.second == 1 && mesh.boundaries.count(entry.first) == 0)
        mesh.boundaries[entry.first] = index_in(mesh.boundary_names, "free");
  }

  static dealii::Point<dim> in_space(const dealii::Point<3> &point)
  {
    dealii::Point<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = point[d];
    return result;
  }

  /// Return the faces of the cells at the boundary, before the cells are split.
  std::vector<Facet> facets()
  {
    std::map<Corners, std::pair<unsigned int, Corners>> count;
    for (const auto &cell : cells)
      for (const auto &local : faces_of(cell.shape))
        {
          Corners face;
          for (const unsigned int corner : local)
            face.push_back(cell.corners[corner]);
          auto &entry = count[sorted(face)];
          ++entry.first;
          entry.second = face;
        }
    std::vector<Facet> result;
    for (const auto &entry : count)
      if (entry.second.first == 1)
        {
          const Corners &face  = entry.second.second;
          const auto     shape = face.size() == 2   ? ElementShape::line
                                 : face.size() == 3 ? ElementShape::triangle
                                                    : ElementShape::quadrilateral;
          result.push_back({face, mesh.boundaries.at(sorted(parts({shape, face, {}, 0, 0})[0]))});
        }
    return result;
  }

  /// Return the middle nodes of the cells, without those of other regions of the file.
  typename BodySurface<dim>::Middles middles() const
  {
    typename BodySurface<dim>::Middles result;
    const auto                         add = [&](const Corners &corners) {
      const auto found = file.middles.find(sorted(corners));
      if (found != file.middles.end())
        result.insert(*found);
    };
    for (const auto &cell : cells)
      for (const auto &local : faces_of(cell.shape))
        {
          Corners face;
          for (const unsigned int corner : local)
            face.push_back(cell.corners[corner]);
          add(face);
          for (unsigned int i = 0; i < face.size(); ++i)
            add({face[i], face[(i + 1) % face.size()]});
        }
    return result;
  }

  void curve_boundaries()
  {
    std::set<unsigned int> smooth;
    for (const auto &entry : parameters.surfaces)
      if (entry.second == "smooth")
        smooth.insert(geometry::index_of(mesh.boundary_names, entry.first));
    for (const auto &point : points)
      mesh.vertices.push_back(in_space(point));
    BodySurface<dim> surface({mesh.vertices.begin(), mesh.vertices.begin() + file.points.size()},
                             middles(), facets(), smooth);
    const SurfaceShapes<dim> shapes(surface, parameters, mesh.boundary_names, notes);
    mesh.shapes = shapes.of_boundaries();
    curve_blocks(mesh, {cells, split.get()}, surface, shapes, notes);
  }

  /// Remove points of other regions and middle nodes of quadratic elements, because BlockGeometry
  /// computes the extent of the body from all vertices.
  void drop_unused_points()
  {
    const unsigned int none = static_cast<unsigned int>(-1);
    Corners            number(points.size(), none);
    const auto         all = std::move(mesh.vertices);
    mesh.vertices.clear();
    for (auto &block : mesh.blocks)
      for (unsigned int &corner : block)
        {
          if (number[corner] == none)
            {
              number[corner] = mesh.vertices.size();
              mesh.vertices.push_back(all[corner]);
            }
          corner = number[corner];
        }
    const auto renumbered = [&](const auto &faces) {
      std::decay_t<decltype(faces)> result;
      for (const auto &entry : faces)
        {
          Corners key;
          for (const unsigned int corner : entry.first)
            key.push_back(number[corner]);
          result[sorted(key)] = entry.second;
        }
      return result;
    };
    mesh.boundaries = renumbered(mesh.boundaries);
    mesh.known      = renumbered(mesh.known);
    // Coordinates follow the new order of the vertices.
    for (auto &entry : mesh.pieces)
      {
        std::map<unsigned int, dealii::Point<2>> at;
        for (unsigned int i = 0; i < entry.first.size(); ++i)
          at[number[entry.first[i]]] = entry.second.at[i];
        std::transform(at.begin(), at.end(), entry.second.at.begin(),
                       [](const auto &own) { return own.second; });
      }
    mesh.pieces = renumbered(mesh.pieces);
  }
};

/// Return the hash FNV-1a of 64 bits, which is equal on all machines, unlike std::hash.
std::uint64_t fnv_hash(const std::string &text)
{
  std::uint64_t hash = 14695981039346656037u;
  for (const unsigned char c : text)
    hash = (hash ^ c) * 1099511628211u;
  return hash;
}

template <int dim>
std::shared_ptr<const geometry::BlockMesh<dim>>
make_blocks(const MeshFile                     &file,
            const geometry::BodyMeshParameters &parameters,
            std::vector<std::string>           &notes)
{
  Importer<dim> importer(file, parameters);
  auto          mesh = std::make_shared<const geometry::BlockMesh<dim>>(importer.blocks());
  notes              = importer.notes;
  return mesh;
}
} // namespace

std::shared_ptr<const geometry::ImportedMesh>
import_mesh(const std::string                  &text,
            const geometry::BodyMeshParameters &parameters,
            const unsigned int                  dim)
{
  try
    {
      const MeshFile file   = read_mesh_file(text);
      auto           result = std::make_shared<geometry::ImportedMesh>();
      result->text_hash     = fnv_hash(text);
      if (dim == 2)
        result->flat = make_blocks<2>(file, parameters, result->notes);
      else
        result->solid = make_blocks<3>(file, parameters, result->notes);
      return result;
    }
  catch (const InputError &error)
    {
      // Messages that begin with an entry (Mesh regions, Surface) are complete. All others concern
      // the file.
      const std::string message = printable(error.what());
      if (message.rfind("entry '", 0) == 0)
        throw InputError(message);
      throw bad_entry("File", parameters.file, message);
    }
}
} // namespace snug::mesh_file
