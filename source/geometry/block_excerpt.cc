#include <snug/base/assertions.h>
#include <snug/geometry/block_geometry.h>

#include <algorithm>

namespace snug::geometry {
namespace {
/// This class gives new numbers to some vertices of a mesh, in the order of the mesh.
class NewNumbers
{
public:
  explicit NewNumbers(const std::vector<Vertices> &blocks)
  {
    for (const auto &block : blocks)
      vertices.insert(vertices.end(), block.begin(), block.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  }

  const Vertices &old() const { return vertices; }

  /// Replace vertices by their new numbers. Return whether all of them have one.
  bool replace(Vertices &in) const
  {
    for (unsigned int &vertex : in)
      {
        const auto found = std::lower_bound(vertices.begin(), vertices.end(), vertex);
        if (found == vertices.end() || *found != vertex)
          return false;
        vertex = found - vertices.begin();
      }
    return true;
  }

  /// Return the entries of @p faces whose vertices all have a new number.
  template <typename Faces>
  Faces of(const Faces &faces) const
  {
    Faces result;
    for (const unsigned int first : vertices)
      for (auto face = faces.lower_bound({first}); face != faces.end() && face->first[0] == first;
           ++face)
        if (auto key = face->first; replace(key))
          result.emplace_hint(result.end(), key, face->second);
    return result;
  }

private:
  Vertices vertices; ///< ascending
};
} // namespace

/// Vertices keep their order, because pieces and edges take their directions from it.
template <int dim>
BlockMesh<dim> excerpt(const BlockMesh<dim> &mesh, const std::vector<unsigned int> &blocks)
{
  SNUG_ASSERT(blocks.empty() || !mesh.is_excerpt(), "the mesh lacks blocks");
  BlockMesh<dim> result;
  result.boundary_names = mesh.boundary_names;
  result.region_names   = mesh.region_names;
  result.projections    = mesh.projections;
  result.known_surfaces = mesh.known_surfaces;
  result.shapes         = mesh.shapes;
  result.cells          = mesh.cells;
  result.place          = mesh.is_excerpt()
                            ? mesh.place
                            : typename BlockMesh<dim>::Excerpt{{},
                                                      static_cast<unsigned int>(mesh.blocks.size()),
                                                      bounds_of(mesh)};
  result.place.numbers  = blocks;
  for (const unsigned int block : blocks)
    {
      result.blocks.push_back(mesh.blocks[block]);
      result.regions.push_back(mesh.regions[block]);
      if (!mesh.parts.empty())
        result.parts.push_back(mesh.parts[block]);
    }
  const NewNumbers numbers(result.blocks);
  for (const unsigned int vertex : numbers.old())
    result.vertices.push_back(mesh.vertices[vertex]);
  for (auto &block : result.blocks)
    numbers.replace(block);
  result.pieces = numbers.of(mesh.pieces);
  result.known  = numbers.of(mesh.known);
  return result;
}

template <int dim>
std::array<dealii::Point<dim>, 2> bounds_of(const BlockMesh<dim> &mesh)
{
  if (mesh.is_excerpt())
    return mesh.place.bounds;
  dealii::Point<dim> lower = mesh.vertices.front(), upper = lower;
  for (const auto &vertex : mesh.vertices)
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(lower[d], vertex[d]);
        upper[d] = std::max(upper[d], vertex[d]);
      }
  return {{lower, upper}};
}

template BlockMesh<2>                    excerpt(const BlockMesh<2> &, const Vertices &);
template BlockMesh<3>                    excerpt(const BlockMesh<3> &, const Vertices &);
template std::array<dealii::Point<2>, 2> bounds_of(const BlockMesh<2> &);
template std::array<dealii::Point<3>, 2> bounds_of(const BlockMesh<3> &);
} // namespace snug::geometry
