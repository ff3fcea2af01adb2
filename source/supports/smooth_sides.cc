#include <snug/base/disjoint_sets.h>
#include <snug/supports/smooth_sides.h>

#include <algorithm>
#include <map>

namespace snug::supports {
namespace {
const double smooth_cosine = 0.766; // 40 degrees

/// Maximum difference between the normals of a flat boundary.
const double flat_angle = 1e-6;

using Boundary = std::pair<unsigned int, unsigned int>;

/// A node of a face with the unit normal of the face at this node.
template <int dim>
struct Corner
{
  unsigned int           face;
  dealii::Tensor<1, dim> normal;
};

} // namespace

template <int dim>
std::vector<std::vector<unsigned int>>
smooth_sides(const mesh::Surface<dim>                 &surface,
             const std::vector<Boundary>              &boundaries,
             const faces::FaceShape<dim>              &shape,
             const typename mesh::Surface<dim>::Field &positions)
{
  std::map<unsigned int, std::vector<Corner<dim>>> corners; // keyed by node
  std::map<Boundary, dealii::Tensor<1, dim>>       first_normal;
  std::map<Boundary, bool>                         is_flat;
  std::vector<Boundary>                            of_face;
  for (unsigned int f = 0; f < surface.faces().size(); ++f)
    {
      const auto &face = surface.faces()[f];
      of_face.emplace_back(face.body, face.boundary);
      if (std::find(boundaries.begin(), boundaries.end(), of_face[f]) == boundaries.end())
        continue;
      for (unsigned int k = 0; k < face.nodes.size(); ++k)
        {
          auto n =
            faces::area_vector(faces::tangents<dim>(shape.at_node(k), face.nodes, positions));
          n /= n.norm();
          corners[face.nodes[k]].push_back({f, n});
          const auto &reference = first_normal.emplace(of_face[f], n).first->second;
          auto       &flat      = is_flat.emplace(of_face[f], true).first->second;
          flat                  = flat && (n - reference).norm() < flat_angle;
        }
    }
  DisjointSets patches(surface.faces().size());
  for (const auto &node : corners)
    for (const auto &a : node.second)
      for (const auto &b : node.second)
        {
          const Boundary &of_a = of_face[a.face], &of_b = of_face[b.face];
          // A shallow edge between two flat faces is an edge nevertheless. Between curved faces, a
          // small angle results from the faceting of one smooth surface.
          const bool edge = of_a != of_b && is_flat.at(of_a) && is_flat.at(of_b);
          if (!edge && a.normal * b.normal > smooth_cosine)
            patches.join(a.face, b.face);
        }
  std::map<unsigned int, std::vector<unsigned int>> by_root;
  for (unsigned int f = 0; f < surface.faces().size(); ++f)
    if (is_flat.count(of_face[f]) == 1)
      // Roots are the minimum faces of their sets, so sides are in the order of faces.
      by_root[patches.find(f)].push_back(f);
  std::vector<std::vector<unsigned int>> sides;
  for (const auto &patch : by_root)
    sides.push_back(patch.second);
  return sides;
}

#define SNUG_INSTANTIATE(dim)                                                                 \
  template std::vector<std::vector<unsigned int>> smooth_sides(const mesh::Surface<dim> &,    \
                                                               const std::vector<Boundary> &, \
                                                               const faces::FaceShape<dim> &, \
                                                               const mesh::Surface<dim>::Field &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::supports
