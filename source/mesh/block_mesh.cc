#include <snug/mesh/block_mesh.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>

namespace snug
{
  namespace mesh
  {
    template <int dim>
    void
    mirror(BlockMesh<dim> &mesh, unsigned int axis, const std::string &name)
    {
      using Face             = typename BlockMesh<dim>::Face;
      const auto is_on_plane = [&](unsigned int vertex) {
        return mesh.vertices[vertex][axis] == 0.;
      };
      std::vector<unsigned int> image;
      const unsigned int        n_vertices = mesh.vertices.size();
      for (unsigned int v = 0; v < n_vertices; ++v)
        {
          image.push_back(is_on_plane(v) ? v : mesh.vertices.size());
          if (is_on_plane(v))
            continue;
          mesh.vertices.push_back(mesh.vertices[v]);
          mesh.vertices.back()[axis] *= -1.;
        }
      const unsigned int n_blocks = mesh.blocks.size();
      for (unsigned int b = 0; b < n_blocks; ++b)
        {
          // the first axis of a block turns round to keep it right-handed
          std::vector<unsigned int> block(mesh.blocks[b].size());
          for (unsigned int v = 0; v < block.size(); ++v)
            block[v] = image[mesh.blocks[b][v ^ 1]];
          mesh.blocks.push_back(block);
          mesh.regions.push_back(mesh.regions[b]);
        }
      const auto old = mesh.boundaries;
      for (const auto &face : old)
        {
          if (mesh.boundary_names[face.second] == name)
            {
              mesh.boundaries.erase(face.first);
              continue;
            }
          Face key;
          for (const unsigned int v : face.first)
            key.push_back(image[v]);
          std::sort(key.begin(), key.end());
          mesh.boundaries[key] = face.second;
        }
    }

    template <int dim>
    void
    remove_unused_boundaries(BlockMesh<dim> &mesh)
    {
      std::map<unsigned int, unsigned int> number;
      for (const auto &face : mesh.boundaries)
        number[face.second] = 0;
      std::vector<std::string>                                 names;
      std::map<unsigned int, typename BlockMesh<dim>::Surface> surfaces;
      for (auto &entry : number)
        {
          entry.second = names.size();
          names.push_back(mesh.boundary_names[entry.first]);
          if (mesh.surfaces.count(entry.first) > 0)
            surfaces[entry.second] = mesh.surfaces.at(entry.first);
        }
      for (auto &face : mesh.boundaries)
        face.second = number[face.second];
      mesh.boundary_names = names;
      mesh.surfaces       = surfaces;
    }

    void
    order_consistently(BlockMesh<2> &mesh)
    {
      std::vector<dealii::CellData<2>> cells;
      for (const auto &block : mesh.blocks)
        {
          cells.emplace_back(block.size());
          cells.back().vertices = block;
        }
      dealii::GridTools::consistently_order_cells(cells);
      for (unsigned int b = 0; b < cells.size(); ++b)
        mesh.blocks[b] = cells[b].vertices;
    }

    template void
    mirror(BlockMesh<2> &, unsigned int, const std::string &);
    template void
    mirror(BlockMesh<3> &, unsigned int, const std::string &);
    template void
    remove_unused_boundaries(BlockMesh<2> &);
    template void
    remove_unused_boundaries(BlockMesh<3> &);
  } // namespace mesh
} // namespace snug
