#include <snug/base/gather.h>
#include <snug/geometry/cell_numbering.h>
#include <snug/geometry/entry_values.h>
#include <snug/mesh_file/curved_blocks.h>
#include <snug/mesh_file/face_names.h>
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
  Importer(const MeshFile                     &file,
           const geometry::BodyMeshParameters &parameters,
           const ExactFaces<dim>              *exact)
    : parameters(parameters), file(file), exact(exact), points(file.points)
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
    if (exact != nullptr)
      mesh.projections = exact->projections;
    collect_faces();
    name_boundaries();
    curve_boundaries();
    drop_unused_points();
    // Each block is one coarse cell, which Refinements refine.
    mesh.cells.fill(1);
    return mesh;
  }

  std::vector<std::string> notes, warnings;

private:
  const geometry::BodyMeshParameters &parameters;
  const MeshFile                     &file;
  const ExactFaces<dim>              *exact; ///< null: none
  std::vector<dealii::Point<3>>       points;
  std::vector<Element>                cells;
  std::unique_ptr<ElementSplit>       split; ///< null: no element is split
  geometry::BlockMesh<dim>            mesh;
  /// faces -> number of cells that share the face
  geometry::NumberByVertices      n_cells_of_face;
  std::map<Corners, unsigned int> exact_face; ///< corners of an element -> index of its face

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

  geometry::ElementPart<dim> part_at(const unsigned int corner, const Element &cell) const
  {
    geometry::ElementPart<dim> result;
    result.element   = &cell - cells.data();
    result.n_corners = cell.corners.size();
    result.corner    = corner;
    const auto &ends = corner_neighbours(cell.shape)[corner];
    std::copy(ends.begin(), ends.end(), result.towards.begin());
    return result;
  }

  void add_blocks()
  {
    for (const auto &cell : cells)
      {
        // All groups are regions, so that Materials may contain a group without cells of its own.
        for (const auto &group : cell.groups)
          index_in(mesh.region_names, group);
        const auto region = index_in(mesh.region_names, region_of(cell));
        const auto blocks = parts(cell);
        for (unsigned int corner = 0; corner < blocks.size(); ++corner)
          {
            mesh.blocks.push_back(blocks[corner]);
            mesh.regions.push_back(region);
            if (split)
              mesh.parts.push_back(part_at(corner, cell));
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

  void name_boundaries()
  {
    const FaceNames names(file, parameters, cells, n_cells_of_face,
                          [this](const Element &element) { return parts(element); });
    notes.insert(notes.end(), names.notes.begin(), names.notes.end());
    for (const auto &[face, name] : names.named())
      mesh.boundaries[face] = index_in(mesh.boundary_names, name);
    if (exact != nullptr)
      for (const auto &element : file.elements)
        if (dimension(element.shape) == dim - 1 && !element.groups.empty())
          exact_face[sorted(element.corners)] = exact->face_of_group.at(element.groups.back());
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
    std::vector<Facet> result;
    for (const auto &face : outer_faces(cells))
      {
        const auto own = exact_face.find(sorted(face));
        result.push_back({face,
                          mesh.boundaries.at(sorted(parts({face_shape(face), face, {}, 0, 0})[0])),
                          own == exact_face.end() ? Facet::no_face : own->second});
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
    const SurfaceShapes<dim> shapes(surface, parameters, mesh.boundary_names, notes, exact);
    mesh.shapes = shapes.of_boundaries();
    curve_blocks(mesh, {cells, split.get()}, surface, shapes, warnings);
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

/// Run @p work, and complete the message of an error of the file by the entry of the file.
template <typename Work>
auto with_entry(const geometry::BodyMeshParameters &parameters, const Work &work)
{
  try
    {
      return work();
    }
  catch (const InputError &error)
    {
      // Errors of entries (Mesh regions, Surface) are complete. All others concern the file.
      if (!error.wrong().entry.empty())
        throw;
      throw bad_entry("File", parameters.file, printable(error.what()));
    }
}
} // namespace

std::uint64_t text_hash(const std::string &text)
{
  std::uint64_t hash = 14695981039346656037u;
  for (const unsigned char c : text)
    hash = (hash ^ c) * 1099511628211u;
  return hash;
}

template <int dim>
std::shared_ptr<geometry::ImportedMesh> import_mesh(const MeshFile                     &file,
                                                    const geometry::BodyMeshParameters &parameters,
                                                    const ExactFaces<dim>              *exact)
{
  return with_entry(parameters, [&]() {
    auto          result = std::make_shared<geometry::ImportedMesh>();
    Importer<dim> importer(file, parameters, exact);
    auto          mesh    = importer.blocks();
    result->has_triangles = std::any_of(mesh.parts.begin(), mesh.parts.end(),
                                        [](const auto &part) { return part.has_triangles(); });
    result->blocks<dim>() = std::make_shared<const geometry::BlockMesh<dim>>(std::move(mesh));
    result->notes         = importer.notes;
    result->warnings      = importer.warnings;
    return result;
  });
}

std::shared_ptr<const geometry::ImportedMesh>
import_mesh(const std::string                  &text,
            const geometry::BodyMeshParameters &parameters,
            const unsigned int                  dim)
{
  const MeshFile file = with_entry(parameters, [&]() { return read_mesh_file(text); });
  const auto     result =
    dim == 2 ? import_mesh<2>(file, parameters) : import_mesh<3>(file, parameters);
  result->text_hash = text_hash(text);
  return result;
}

std::shared_ptr<const geometry::ImportedMesh>
import_mesh(const MPI_Comm                      communicator,
            const std::function<std::string()> &text,
            const geometry::BodyMeshParameters &parameters,
            const unsigned int                  dim)
{
  std::shared_ptr<const geometry::ImportedMesh> whole;
  const auto                                    empty = made_on_first_rank(communicator, [&]() {
    whole = import_mesh(text(), parameters, dim);
    return *whole->without_cells();
  });
  return whole ? whole : std::make_shared<const geometry::ImportedMesh>(empty);
}

template std::shared_ptr<geometry::ImportedMesh>
import_mesh(const MeshFile &, const geometry::BodyMeshParameters &, const ExactFaces<2> *);
template std::shared_ptr<geometry::ImportedMesh>
import_mesh(const MeshFile &, const geometry::BodyMeshParameters &, const ExactFaces<3> *);
} // namespace snug::mesh_file
