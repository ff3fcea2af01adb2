#include <snug/response/measured_faces.h>

#include <algorithm>

namespace snug::response {
template <int dim>
std::vector<MeasuredFace> faces_of(const state::StateSolver<dim> &solver,
                                   const ResponseParameters      &parameters)
{
  const auto &mesh     = solver.mesh();
  const auto  boundary = find_boundary(solver, parameters);
  // Each cell of the mesh has one (subdomain, cell), because it is in one subdomain of this rank.
  std::vector<std::pair<unsigned int, unsigned int>> of_cell(mesh.cells().size());
  for (unsigned int s = 0; s < solver.assemblers().size(); ++s)
    for (unsigned int i = 0; i < solver.assemblers()[s]->cells().size(); ++i)
      of_cell[solver.assemblers()[s]->cells()[i]] = {s, i};
  std::vector<MeasuredFace> faces;
  for (unsigned int f = 0; f < mesh.boundary_faces().size(); ++f)
    {
      const auto &face = mesh.boundary_faces()[f];
      if (std::make_pair(face.body, face.boundary) != boundary)
        continue;
      const auto &nodes = mesh.cells()[face.cell].nodes;
      const auto [s, i] = of_cell[face.cell];
      faces.push_back({f, s, i, {}});
      for (const unsigned int node : face.nodes)
        faces.back().places.push_back(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
    }
  return faces;
}

template std::vector<MeasuredFace> faces_of(const state::StateSolver<2> &,
                                            const ResponseParameters &);
template std::vector<MeasuredFace> faces_of(const state::StateSolver<3> &,
                                            const ResponseParameters &);
} // namespace snug::response
