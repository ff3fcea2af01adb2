#include <snug/faces/nodal_normals.h>
#include <snug/io/profile.h>
#include <snug/io/surface_pieces.h>
#include <snug/io/text_file.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::io {
namespace {
/// The mean normal of a piece has at least this length, as the part of the mean of the lengths of
/// the area vectors. The mean normal of a closed piece vanishes up to the errors of the mesh, and
/// that of a half circle is 2/pi.
const double shortest_mean_normal = 0.1;

/// A node is on a plane of symmetry if its distance is below this part of the size of its piece.
const double on_plane = 1e-6;

/// Return whether a node of a piece lies on a plane.
template <int dim>
bool meets(const mesh::Surface<dim>        &surface,
           const SurfacePiece              &piece,
           const state::SymmetryPlane<dim> &plane)
{
  const auto &x        = surface.reference_positions();
  double      distance = std::numeric_limits<double>::infinity(), size = 0.;
  for (const unsigned int node : piece.nodes)
    {
      distance = std::min(distance, std::abs((x[node] - plane.point) * plane.normal));
      size     = std::max(size, (x[node] - x[piece.nodes.front()]).norm());
    }
  return plane.body == piece.body && distance <= on_plane * size;
}

/// Return the unit mean normal of a piece and of its mirror images, or zero if the normals cancel.
template <int dim>
dealii::Tensor<1, dim> mean_normal(const mesh::Surface<dim>                     &surface,
                                   const SurfacePiece                           &piece,
                                   const faces::FaceShape<dim>                  &shape,
                                   const std::vector<state::SymmetryPlane<dim>> &planes)
{
  dealii::Tensor<1, dim> sum;
  double                 lengths = 0.;
  for (const unsigned int face : piece.faces)
    for (unsigned int k = 0; k < shape.n_nodes(); ++k)
      {
        const auto area =
          faces::area_vector(faces::tangents<dim>(shape.at_node(k), surface.faces()[face].nodes,
                                                  surface.reference_positions()));
        sum += area;
        lengths += area.norm();
      }
  for (const auto &plane : planes)
    if (meets(surface, piece, plane))
      sum -= (sum * plane.normal) * plane.normal;
  return sum.norm() < shortest_mean_normal * lengths ? dealii::Tensor<1, dim>() : sum / sum.norm();
}

/// Return the columns of the components of a vector.
template <int dim>
std::string columns(const dealii::Tensor<1, dim> &x)
{
  std::string text;
  for (unsigned int c = 0; c < dim; ++c)
    text += ',' + exact(x[c]);
  return text;
}

template <int dim>
std::string columns(const std::string &prefix)
{
  std::string text;
  for (unsigned int c = 0; c < dim; ++c)
    text += ',' + prefix + "xyz"[c];
  return text;
}

/// Return, for each node, the maximum distance of the samples of the true surface from the faces of
/// the mesh at the node; zero where the faces are the true surface.
template <int dim>
std::vector<double> deviations(const mesh::Surface<dim>                 &surface,
                               const typename mesh::Surface<dim>::Field &positions,
                               const faces::FaceShape<dim>              &shape)
{
  std::vector<double> result(surface.n_nodes(), 0.);
  for (const auto &face : surface.faces())
    {
      double of_face = 0.;
      for (unsigned int k = 0; k < face.samples.size(); ++k)
        {
          auto offset = positions[face.samples[k]];
          for (unsigned int a = 0; a < face.nodes.size(); ++a)
            offset -= shape.at_sample(k).value[a] * positions[face.nodes[a]];
          of_face = std::max(of_face, offset.norm());
        }
      for (const unsigned int node : face.nodes)
        result[node] = std::max(result[node], of_face);
    }
  return result;
}

/// Return the maximum of m.x over the nodes of a piece.
template <int dim, typename Field>
double highest(const SurfacePiece &piece, const dealii::Tensor<1, dim> &m, const Field &positions)
{
  double highest = -std::numeric_limits<double>::infinity();
  for (const unsigned int node : piece.nodes)
    highest = std::max(highest, m * positions[node]);
  return highest;
}
} // namespace

template <int dim>
std::string profile_text(const mesh::Surface<dim>                 &surface,
                         const typename mesh::Surface<dim>::Field &positions,
                         const unsigned int                        degree,
                         const ProfileModel<dim>                  &model)
{
  const auto                 &reference = surface.reference_positions();
  const faces::FaceShape<dim> shape(degree);
  std::string text = std::string("face,piece,node") + (dim == 2 ? ",arc_length" : "") +
                     columns<dim>("reference_") + columns<dim>("") + columns<dim>("normal_") +
                     ",move,reference_drop,drop,deviation\n";
  const auto distances = deviations(surface, positions, shape);
  const auto pieces    = surface_pieces(surface);
  for (unsigned int p = 0; p < pieces.size(); ++p)
    {
      const auto &piece = pieces[p];
      const auto  normals =
        faces::NodalNormals<dim>(surface, piece.faces, shape, reference).normals();
      const auto   m             = mean_normal(surface, piece, shape, model.planes);
      const double reference_top = highest(piece, m, reference), top = highest(piece, m, positions);
      double       arc_length = 0.;
      unsigned int previous   = piece.nodes.front();
      for (const unsigned int node : piece.nodes)
        {
          const auto move = positions[node] - reference[node];
          arc_length += (reference[node] - reference[previous]).norm();
          previous = node;
          text += model.name(piece.body, piece.boundary) + ',' + std::to_string(p) + ',' +
                  std::to_string(model.node_number(node)) +
                  (dim == 2 ? ',' + exact(arc_length) : "") +
                  columns<dim>(dealii::Tensor<1, dim>(reference[node])) +
                  columns<dim>(dealii::Tensor<1, dim>(positions[node])) +
                  columns<dim>(normals[node]) + ',' + exact(move * normals[node]) + ',';
          text += m.norm() == 0. ? ","
                                 : exact(reference_top - m * reference[node]) + ',' +
                                     exact(top - m * positions[node]);
          text += ',' + exact(distances[node]) + '\n';
        }
    }
  return text;
}

template std::string profile_text(const mesh::Surface<2> &,
                                  const mesh::Surface<2>::Field &,
                                  unsigned int,
                                  const ProfileModel<2> &);
template std::string profile_text(const mesh::Surface<3> &,
                                  const mesh::Surface<3>::Field &,
                                  unsigned int,
                                  const ProfileModel<3> &);
} // namespace snug::io
