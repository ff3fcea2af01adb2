#include <snug/io/shape_export.h>
#include <snug/io/text_file.h>

#include <cmath>
#include <map>
#include <set>

namespace snug::io {
namespace {
/// Return the STL text of a triangle. Corners are counterclockwise seen from outside. A triangle
/// without area has the normal 0.
std::string stl_triangle(const dealii::Tensor<1, 3> &a,
                         const dealii::Tensor<1, 3> &b,
                         const dealii::Tensor<1, 3> &c)
{
  dealii::Tensor<1, 3> normal = cross_product_3d(b - a, c - a);
  if (normal.norm() > 0.)
    normal /= normal.norm();
  const auto numbers = [](const dealii::Tensor<1, 3> &x) {
    return ' ' + exact(x[0]) + ' ' + exact(x[1]) + ' ' + exact(x[2]) + '\n';
  };
  std::string text = "facet normal" + numbers(normal) + "outer loop\n";
  for (const auto &corner : {a, b, c})
    text += "vertex" + numbers(corner);
  return text + "endloop\nendfacet\n";
}

/// Return the STL text. A bilinear face is not flat, so the diagonal from (i, j) to (i + 1, j + 1)
/// cuts it.
std::string stl_text(const mesh::Surface<3>        &surface,
                     const mesh::Surface<3>::Field &positions,
                     const std::string             &name)
{
  std::string text = "solid " + name + "\n";
  for (const auto &face : surface.faces())
    {
      // The number of nodes per edge also cuts quadratic faces at their middle nodes.
      const unsigned int n      = std::lround(std::sqrt(face.nodes.size()));
      const auto         corner = [&](unsigned int i, unsigned int j) {
        return positions[face.nodes[j * n + i]];
      };
      for (unsigned int j = 0; j + 1 < n; ++j)
        for (unsigned int i = 0; i + 1 < n; ++i)
          {
            text += stl_triangle(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1));
            text += stl_triangle(corner(i, j), corner(i + 1, j + 1), corner(i, j + 1));
          }
    }
  return text + "endsolid " + name + "\n";
}

/// Return the nodes of the polylines, piece by piece: first open pieces from their beginning,
/// then closed pieces. @p faces maps the first node of each face to its nodes.
///
/// Faces have a direction, and each face begins where the face before it ends. An open piece begins
/// at the node at which no face ends. In a closed piece the first node is repeated at the end.
std::vector<std::vector<unsigned int>>
polyline_pieces(std::map<unsigned int, std::vector<unsigned int>> faces)
{
  std::set<unsigned int> ends;
  for (const auto &face : faces)
    ends.insert(face.second.back());
  std::vector<std::vector<unsigned int>> pieces;
  while (!faces.empty())
    {
      // If every face has a predecessor, all remaining pieces are closed, and any face may be the
      // first.
      auto next = faces.begin();
      for (auto face = faces.begin(); face != faces.end(); ++face)
        if (ends.count(face->first) == 0)
          {
            next = face;
            break;
          }
      std::vector<unsigned int> piece(1, next->first);
      while (next != faces.end())
        {
          piece.insert(piece.end(), next->second.begin() + 1, next->second.end());
          faces.erase(next);
          next = faces.find(piece.back());
        }
      pieces.push_back(piece);
    }
  return pieces;
}

/// Return the polyline. Nodes are oriented such that (t_y, -t_x) points out of the body, so the
/// body is on the left.
std::string polyline_text(const mesh::Surface<2> &surface, const mesh::Surface<2>::Field &positions)
{
  std::map<unsigned int, std::vector<unsigned int>> faces;
  for (const auto &face : surface.faces())
    // No two faces begin at the same node, because each boundary goes around its body once.
    faces[face.nodes.front()] = face.nodes;
  std::string text  = "x,y\n";
  bool        first = true;
  for (const auto &piece : polyline_pieces(faces))
    {
      // Plotting programs such as gnuplot start a new line after an empty line.
      text += first ? "" : "\n";
      first = false;
      for (const unsigned int node : piece)
        text += exact(positions[node][0]) + ',' + exact(positions[node][1]) + '\n';
    }
  return text;
}
} // namespace

template <>
std::string surface_text(const mesh::Surface<2>        &surface,
                         const mesh::Surface<2>::Field &positions,
                         const std::string &)
{
  return polyline_text(surface, positions);
}

template <>
std::string surface_text(const mesh::Surface<3>        &surface,
                         const mesh::Surface<3>::Field &positions,
                         const std::string             &name)
{
  return stl_text(surface, positions, name);
}

template <int dim>
void write_surface(const std::string                        &stem,
                   const mesh::Surface<dim>                 &surface,
                   const typename mesh::Surface<dim>::Field &positions)
{
  // npos + 1 is 0, so a stem without directory is the name itself.
  const std::string name = stem.substr(stem.rfind('/') + 1);
  write_text_file(stem + (dim == 2 ? ".csv" : ".stl"), surface_text(surface, positions, name));
}

template <int dim>
void write_control_points(const std::string                         &path,
                          const std::vector<shape::MovedPoint<dim>> &points)
{
  // The columns are positions of the current design, displacements from the reference, the
  // variables, and the point of the body.
  std::string text = dim == 3 ? "shape,index,x,y,z,dx,dy,dz,variables,body_x,body_y,body_z\n"
                              : "shape,index,x,y,dx,dy,variables,body_x,body_y\n";
  for (const auto &point : points)
    {
      text += point.shape + ',' + std::to_string(point.index);
      for (unsigned int c = 0; c < dim; ++c)
        text += ',' + exact(point.position[c]);
      for (unsigned int c = 0; c < dim; ++c)
        text += ',' + exact(point.move[c]);
      text += ',';
      for (const auto &[variable, sign] : point.variables)
        text += (text.back() == ',' ? "" : " ") + std::string(sign < 0. ? "-" : "") + "design[" +
                std::to_string(variable) + ']';
      for (unsigned int c = 0; c < dim; ++c)
        text += ',' + exact(point.on_body[c]);
      text += '\n';
    }
  write_text_file(path, text);
}

template void
write_surface(const std::string &, const mesh::Surface<2> &, const mesh::Surface<2>::Field &);
template void
write_surface(const std::string &, const mesh::Surface<3> &, const mesh::Surface<3>::Field &);
template void write_control_points(const std::string &, const std::vector<shape::MovedPoint<2>> &);
template void write_control_points(const std::string &, const std::vector<shape::MovedPoint<3>> &);
} // namespace snug::io
