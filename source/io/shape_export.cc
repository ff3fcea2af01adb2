#include <snug/io/shape_export.h>
#include <snug/io/text_file.h>

#include <cmath>

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
} // namespace

void write_surface(const std::string             &path,
                   const mesh::Surface<3>        &surface,
                   const mesh::Surface<3>::Field &positions)
{
  const std::string file = path.substr(path.rfind('/') + 1); // npos + 1 is 0
  write_text_file(path, stl_text(surface, positions, file.substr(0, file.rfind('.'))));
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
        text += ',' + rounded(point.position[c]);
      for (unsigned int c = 0; c < dim; ++c)
        text += ',' + rounded(point.move[c]);
      text += ',';
      for (const auto &[variable, sign] : point.variables)
        text += (text.back() == ',' ? "" : " ") + std::string(sign < 0. ? "-" : "") + "design[" +
                std::to_string(variable) + ']';
      for (unsigned int c = 0; c < dim; ++c)
        text += ',' + rounded(point.on_body[c]);
      text += '\n';
    }
  write_text_file(path, text);
}

template <int dim>
void write_gradients(const std::string                         &path,
                     const std::vector<shape::MovedPoint<dim>> &points,
                     const std::vector<std::string>            &names,
                     const std::vector<std::vector<double>>    &gradients)
{
  std::string text =
    dim == 3 ? "variable,shape,control_points,x,y,z" : "variable,shape,control_points,x,y";
  for (const auto &name : names)
    text += ",d(" + name + ")";
  text += '\n';
  for (unsigned int i = 0; i < gradients.front().size(); ++i)
    {
      std::string                   indices;
      const shape::MovedPoint<dim> *first = nullptr;
      for (const auto &point : points)
        for (const auto &moved : point.variables)
          if (moved.first == i)
            {
              first = first == nullptr ? &point : first;
              indices += (indices.empty() ? "" : " ") + std::to_string(point.index);
            }
      text += std::to_string(i) + ',' + (first != nullptr ? first->shape : "") + ',' + indices;
      for (unsigned int c = 0; c < dim; ++c)
        text += ',' + (first != nullptr ? rounded(first->on_body[c]) : "");
      for (const auto &gradient : gradients)
        text += ',' + rounded(gradient[i]);
      text += '\n';
    }
  write_text_file(path, text);
}

#define SNUG_INSTANTIATE(dim)                                                                     \
  template void write_control_points(const std::string &,                                         \
                                     const std::vector<shape::MovedPoint<dim>> &);                \
  template void write_gradients(const std::string &, const std::vector<shape::MovedPoint<dim>> &, \
                                const std::vector<std::string> &,                                 \
                                const std::vector<std::vector<double>> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::io
