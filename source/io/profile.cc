#include <snug/faces/nodal_normals.h>
#include <snug/io/profile.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace snug::io {
namespace {
/// The mean normal of a piece has at least this length, as the part of the mean of the lengths of
/// the area vectors. The mean normal of a closed piece vanishes up to the errors of the mesh, and
/// that of a half circle is 2/pi.
const double shortest_mean_normal = 0.1;

/// Numbers below this part of the size of a piece are round-off.
const double round_off = 1e-12;

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

/// The points whose polynomials are the true surface of a face: its samples, or its nodes.
template <int dim>
struct TrueFace
{
  const std::vector<unsigned int> &points;
  const unsigned int               degree;

  TrueFace(const mesh::Surface<dim> &surface, const unsigned int face, const unsigned int degree)
    : points(surface.faces()[face].samples.empty() ? surface.faces()[face].nodes
                                                   : surface.faces()[face].samples)
    , degree(surface.faces()[face].samples.empty() ? degree : mesh::surface_degree)
  {}
};

/// Return a column with 9 digits, with 0 for round-off of numbers of the size @p size.
std::string column(const double x, const double size)
{
  return ',' + rounded(std::abs(x) <= round_off * size ? 0. : x);
}

/// Return the columns of the components of a vector.
template <int dim>
std::string columns(const dealii::Tensor<1, dim> &x, const double size)
{
  std::string text;
  for (unsigned int c = 0; c < dim; ++c)
    text += column(x[c], size);
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

/// Return the maximum of a polynomial with the values @p heights at the points of a face, on grids
/// about the highest point so far whose size is halved.
template <int dim>
double maximum(const std::vector<double> &heights, const unsigned int degree)
{
  const auto             top  = std::max_element(heights.begin(), heights.end());
  double                 best = *top;
  dealii::Point<dim - 1> xi   = mesh::lagrange_nodes<dim - 1>(degree)[top - heights.begin()].point;
  for (double size = 1. / degree; size > 1e-8; size *= 0.5)
    for (const auto &part : mesh::lagrange_nodes<dim - 1>(4))
      {
        auto at = xi;
        for (unsigned int a = 0; a < dim - 1; ++a)
          at[a] = std::clamp(xi[a] + size * (2. * part.point[a] - 1.), 0., 1.);
        const auto   values = mesh::lagrange_point<dim - 1>(degree, at).value;
        const double height = std::inner_product(values.begin(), values.end(), heights.begin(), 0.);
        if (height > best)
          {
            best = height;
            xi   = at;
          }
      }
  return best;
}

/// Return the maximum of m.x over the true surface of a piece of the size @p size.
template <int dim>
double highest(const mesh::Surface<dim>                 &surface,
               const SurfacePiece                       &piece,
               const unsigned int                        degree,
               const double                              size,
               const dealii::Tensor<1, dim>             &m,
               const typename mesh::Surface<dim>::Field &positions)
{
  std::vector<std::vector<double>> heights;
  double                           best = -std::numeric_limits<double>::infinity();
  for (const unsigned int f : piece.faces)
    {
      heights.emplace_back();
      for (const unsigned int point : TrueFace<dim>(surface, f, degree).points)
        heights.back().push_back(m * positions[point]);
      best = std::max(best, *std::max_element(heights.back().begin(), heights.back().end()));
    }
  const double of_points = best;
  for (unsigned int f = 0; f < piece.faces.size(); ++f)
    {
      const auto [low, top] = std::minmax_element(heights[f].begin(), heights[f].end());
      // A parabola exceeds the maximum of its points by less than half of their range.
      if (*top - *low > round_off * size && *top + (*top - *low) / 2. > of_points)
        best = std::max(best, maximum<dim>(heights[f],
                                           TrueFace<dim>(surface, piece.faces[f], degree).degree));
    }
  return best;
}
} // namespace

template <int dim>
dealii::Tensor<1, dim> mean_normal(const mesh::Surface<dim>                     &surface,
                                   const SurfacePiece                           &piece,
                                   const unsigned int                            degree,
                                   const std::vector<state::SymmetryPlane<dim>> &planes)
{
  dealii::Tensor<1, dim> sum;
  double                 lengths = 0.;
  for (const unsigned int f : piece.faces)
    {
      const TrueFace<dim> face(surface, f, degree);
      for (const auto &point : mesh::lagrange_gauss_points<dim - 1>(face.degree))
        {
          const auto area = faces::area_vector(
            faces::tangents<dim>(point, face.points, surface.reference_positions()));
          sum += point.weight * area;
          lengths += point.weight * area.norm();
        }
    }
  for (const auto &plane : planes)
    if (meets(surface, piece, plane))
      sum -= (sum * plane.normal) * plane.normal;
  return sum.norm() < shortest_mean_normal * lengths ? dealii::Tensor<1, dim>() : sum / sum.norm();
}

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
  auto       pieces    = surface_pieces(surface);
  for (unsigned int p = 0; p < pieces.size(); ++p)
    {
      auto &piece = pieces[p];
      if (dim == 3 && model.place)
        std::sort(piece.nodes.begin(), piece.nodes.end(), [&](const auto a, const auto b) {
          return model.place(piece, a) < model.place(piece, b);
        });
      const auto normals =
        faces::NodalNormals<dim>(surface, piece.faces, shape, reference).normals();
      const auto m    = mean_normal(surface, piece, degree, model.planes);
      double     size = 0.;
      for (const unsigned int node : piece.nodes)
        size = std::max(size, (reference[node] - reference[piece.nodes.front()]).norm());
      const double reference_top = highest(surface, piece, degree, size, m, reference),
                   top           = highest(surface, piece, degree, size, m, positions);
      double       arc_length    = 0.;
      unsigned int previous      = piece.nodes.front();
      for (const unsigned int node : piece.nodes)
        {
          const auto move = positions[node] - reference[node];
          arc_length += (reference[node] - reference[previous]).norm();
          previous = node;
          text += model.name(piece.body, piece.boundary) + ',' + std::to_string(p) + ',' +
                  std::to_string(model.node_number(node)) +
                  (dim == 2 ? column(arc_length, size) : "") +
                  columns<dim>(dealii::Tensor<1, dim>(reference[node]), size) +
                  columns<dim>(dealii::Tensor<1, dim>(positions[node]), size) +
                  columns<dim>(normals[node], 1.) + column(move * normals[node], size);
          text += m.norm() == 0. ? ",,"
                                 : column(reference_top - m * reference[node], size) +
                                     column(top - m * positions[node], size);
          text += column(distances[node], size) + '\n';
        }
    }
  return text;
}

#define SNUG_INSTANTIATE(dim)                                                                      \
  template dealii::Tensor<1, dim> mean_normal(const mesh::Surface<dim> &, const SurfacePiece &,    \
                                              unsigned int,                                        \
                                              const std::vector<state::SymmetryPlane<dim>> &);     \
  template std::string profile_text(const mesh::Surface<dim> &, const mesh::Surface<dim>::Field &, \
                                    unsigned int, const ProfileModel<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::io
