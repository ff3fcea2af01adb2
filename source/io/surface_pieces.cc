#include <snug/io/surface_pieces.h>

#include <map>
#include <set>

namespace snug::io {
namespace {
/// Return the nodes of a piece along its polyline. Faces have a direction, and each face begins
/// where the face before it ends. An open piece begins at the node at which no face ends. In a
/// closed piece the first node is repeated at the end.
std::vector<unsigned int> ordered_nodes(const mesh::Surface<2>          &surface,
                                        const std::vector<unsigned int> &faces)
{
  std::map<unsigned int, unsigned int> face_from; // first node -> face
  std::set<unsigned int>               ends;
  for (const unsigned int face : faces)
    {
      face_from[surface.faces()[face].nodes.front()] = face;
      ends.insert(surface.faces()[face].nodes.back());
    }
  unsigned int node = face_from.begin()->first;
  for (const auto &[first, face] : face_from)
    if (ends.count(first) == 0)
      node = first;
  std::vector<unsigned int> nodes = {node};
  for (auto next = face_from.find(node); next != face_from.end();
       next      = face_from.find(nodes.back()))
    {
      const auto &of_face = surface.faces()[next->second].nodes;
      nodes.insert(nodes.end(), of_face.begin() + 1, of_face.end());
      face_from.erase(next);
    }
  return nodes;
}

/// Return the nodes of a piece, ascending.
std::vector<unsigned int> ordered_nodes(const mesh::Surface<3>          &surface,
                                        const std::vector<unsigned int> &faces)
{
  std::set<unsigned int> nodes;
  for (const unsigned int face : faces)
    nodes.insert(surface.faces()[face].nodes.begin(), surface.faces()[face].nodes.end());
  return {nodes.begin(), nodes.end()};
}
} // namespace

template <int dim>
std::vector<SurfacePiece> surface_pieces(const mesh::Surface<dim> &surface)
{
  const auto                                                             &faces = surface.faces();
  std::map<std::pair<unsigned int, unsigned int>, std::set<unsigned int>> left;
  std::vector<std::vector<unsigned int>> faces_of_node(surface.n_nodes());
  for (unsigned int f = 0; f < faces.size(); ++f)
    {
      left[{faces[f].body, faces[f].boundary}].insert(f);
      for (const unsigned int node : faces[f].nodes)
        faces_of_node[node].push_back(f);
    }
  std::vector<SurfacePiece> pieces;
  for (auto &[boundary, of_boundary] : left)
    while (!of_boundary.empty())
      {
        SurfacePiece piece{boundary.first, boundary.second, {*of_boundary.begin()}, {}};
        of_boundary.erase(of_boundary.begin());
        for (unsigned int i = 0; i < piece.faces.size(); ++i)
          for (const unsigned int node : faces[piece.faces[i]].nodes)
            for (const unsigned int neighbour : faces_of_node[node])
              if (of_boundary.erase(neighbour) > 0)
                piece.faces.push_back(neighbour);
        piece.nodes = ordered_nodes(surface, piece.faces);
        pieces.push_back(piece);
      }
  return pieces;
}

template std::vector<SurfacePiece> surface_pieces(const mesh::Surface<2> &);
template std::vector<SurfacePiece> surface_pieces(const mesh::Surface<3> &);
} // namespace snug::io
