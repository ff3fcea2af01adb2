#ifndef snug_tests_unit_mesh_file_grid_text_h
#define snug_tests_unit_mesh_file_grid_text_h

#include "files.h"

#include <snug/geometry/cell_numbering.h>

#include <deal.II/base/numbers.h>

#include <functional>

namespace snug::test {
/// Gmsh file of a body made of a grid of n cells; group 1 is the face where the last coordinate of
/// the grid, in [0,1], is 1.
struct GridText
{
  std::vector<unsigned int>                                 n;
  std::function<dealii::Point<3>(const dealii::Point<3> &)> map;
  bool                                                      closed    = false; ///< first axis
  bool                                                      simplices = false;
  int                                                       digits    = 17;

  std::string text() const
  {
    constexpr int      line = 1, tri = 2, quad = 3, tet = 4, hex = 5; // types of Gmsh
    const bool         flat = n.size() == 2;
    const unsigned int nx = n[0], ny = flat ? 1 : n[1], nz = n.back();
    const unsigned int px = closed ? nx : nx + 1, py = flat ? 1 : ny + 1;
    std::ostringstream nodes, elements;
    nodes.precision(digits);
    for (unsigned int k = 0; k <= nz; ++k)
      for (unsigned int j = 0; j < py; ++j)
        for (unsigned int i = 0; i < px; ++i)
          {
            const auto x = map({double(i) / nx, flat ? 0. : double(j) / ny, double(k) / nz});
            nodes << 1 + i + px * (j + py * k) << ' ' << x << '\n';
          }
    unsigned int number = 0;
    const auto   add    = [&](int group, int type, const std::vector<unsigned int> &v) {
      elements << ++number << ' ' << type << " 2 " << group << " 1";
      for (const unsigned int node : v)
        elements << ' ' << node;
      elements << '\n';
    };
    for (unsigned int k = 0; k < nz; ++k)
      for (unsigned int j = 0; j < ny; ++j)
        for (unsigned int i = 0; i < nx; ++i)
          {
            const auto at = [&](unsigned int a, unsigned int b, unsigned int c) {
              return 1 + (i + a) % px + px * (j + b + py * (k + c));
            };
            const bool top = k + 1 == nz;
            if (flat && !simplices)
              add(5, quad, {at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)});
            else if (flat)
              {
                add(5, tri, {at(0, 0, 0), at(1, 0, 0), at(1, 0, 1)});
                add(5, tri, {at(0, 0, 0), at(1, 0, 1), at(0, 0, 1)});
              }
            else if (!simplices)
              add(5, hex,
                  {at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 0, 1), at(1, 0, 1),
                   at(1, 1, 1), at(0, 1, 1)});
            else
              // the six orders of the axes on the way from (0,0,0) to (1,1,1)
              for (const auto &o : {std::array<int, 3>{{0, 1, 2}},
                                    {{1, 2, 0}},
                                    {{2, 0, 1}},
                                    {{1, 0, 2}},
                                    {{0, 2, 1}},
                                    {{2, 1, 0}}})
                {
                  std::array<unsigned int, 3> a{{0, 0, 0}};
                  std::vector<unsigned int>   corners = {at(0, 0, 0)};
                  for (const int d : o)
                    {
                      a[d] = 1;
                      corners.push_back(at(a[0], a[1], a[2]));
                    }
                  const bool odd = o == std::array<int, 3>{{1, 0, 2}} ||
                                   o == std::array<int, 3>{{0, 2, 1}} ||
                                   o == std::array<int, 3>{{2, 1, 0}};
                  if (odd)
                    std::swap(corners[2], corners[1]);
                  add(5, tet, corners);
                }
            if (top && flat)
              add(1, line, {at(0, 0, 1), at(1, 0, 1)});
            else if (top && simplices)
              {
                add(1, tri, {at(0, 0, 1), at(1, 0, 1), at(1, 1, 1)});
                add(1, tri, {at(0, 0, 1), at(1, 1, 1), at(0, 1, 1)});
              }
            else if (top)
              add(1, quad, {at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)});
          }
    return gmsh_text(nodes.str(), elements.str());
  }

  geometry::BodyMeshParameters body() const
  {
    auto result             = file_body();
    result.boundary_numbers = {{"1", "top"}};
    return result;
  }
};

template <int dim>
std::unique_ptr<geometry::BodyGeometry<dim>> make(const GridText              &grid,
                                                  geometry::BodyMeshParameters body)
{
  body.imported = mesh_file::import_mesh(grid.text(), body, dim);
  return geometry::make_geometry<dim>(body);
}

template <int dim>
std::vector<std::string> notes(const GridText &grid, const geometry::BodyMeshParameters &body)
{
  return mesh_file::import_mesh(grid.text(), body, dim)->notes;
}

inline bool says(const std::vector<std::string> &notes, const std::string &words)
{
  for (const auto &note : notes)
    if (note.find(words) != std::string::npos)
      return true;
  return false;
}

/// Calls @p visit(point of the face, cell, face) on the faces of a boundary at a 5 x 5 lattice.
template <int dim, typename Visit>
void on_boundary(const geometry::BodyGeometry<dim> &body,
                 const std::string                 &name,
                 const Visit                       &visit)
{
  const auto                       mesh  = body.coarse_mesh();
  const auto                       index = geometry::boundary_index(body, name);
  std::set<std::set<unsigned int>> wanted;
  for (const auto &face : mesh.boundary_faces)
    if (face.second == index)
      wanted.emplace(face.first.begin(), face.first.end());
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    for (unsigned int f = 0; f < 2 * dim; ++f)
      {
        const auto face = geometry::face_of<dim>(mesh.cells[c], f);
        if (wanted.count({face.begin(), face.end()}) == 0)
          continue;
        for (unsigned int i = 0; i < (dim == 3 ? 25 : 5); ++i)
          {
            dealii::Point<dim> unit;
            unit[f / 2]             = f % 2;
            unit[(f / 2 + 1) % dim] = (i % 5) / 4.;
            if (dim == 3)
              unit[(f / 2 + 2) % dim] = (i / 5) / 4.;
            visit(body.position({c, unit}), c, f);
          }
      }
}

const double pi = dealii::numbers::PI;

/// In [0,1], equal ends, steps of very different size.
inline double uneven(double s, unsigned int n)
{
  const double i = s * n;
  return s + 0.3 / n * std::sin(2.3 * i * i) * (i > 0.5 && i < n - 0.5 ? 1. : 0.);
}

/// Layers from 60 % of an ellipse to the ellipse, all around or a part.
inline GridText ellipse(unsigned int n, double a, double b, bool closed, bool simplices = false)
{
  GridText grid;
  grid.n         = {n, 2};
  grid.closed    = closed;
  grid.simplices = simplices;
  grid.map       = [=](const dealii::Point<3> &u) {
    const double phi = -(closed ? 2. * pi : 2.) * uneven(u[0], n), r = 0.6 + 0.4 * u[2];
    return dealii::Point<3>(1. + r * a * std::cos(phi), 2. + r * b * std::sin(phi), 0.);
  };
  return grid;
}

/// Largest distance of the boundary "top" from a true shape.
template <int dim>
double error(const geometry::BodyGeometry<dim>                       &body,
             const std::function<double(const dealii::Point<dim> &)> &distance)
{
  double largest = 0.;
  on_boundary<dim>(body, "top", [&](const dealii::Point<dim> &x, unsigned int, unsigned int) {
    largest = std::max(largest, std::abs(distance(x)));
  });
  return largest;
}

/// Where cells share a face or an edge they have the same points.
inline void expect_continuous(const geometry::BodyGeometry<3> &body)
{
  const auto                                            mesh = body.coarse_mesh();
  std::map<std::vector<unsigned int>, dealii::Point<3>> seen;
  using Info         = dealii::GeometryInfo<3>;
  unsigned int twice = 0;
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    {
      const auto compare = [&](std::vector<unsigned int> local) {
        // coordinates by vertices in ascending order of their numbers
        std::sort(local.begin(), local.end(), [&](unsigned int a, unsigned int b) {
          return mesh.cells[c][a] < mesh.cells[c][b];
        });
        const dealii::Point<3>    origin = Info::unit_cell_vertex(local[0]);
        std::vector<unsigned int> key    = {mesh.cells[c][local[0]]};
        dealii::Point<3>          unit   = origin;
        double                    part   = 0.3;
        for (const unsigned int v : local)
          if (origin.distance(Info::unit_cell_vertex(v)) == 1.)
            {
              unit += part * (Info::unit_cell_vertex(v) - origin);
              part += 0.4;
              key.push_back(mesh.cells[c][v]);
            }
        const auto x     = body.position({c, unit});
        const auto entry = seen.emplace(key, x);
        twice += !entry.second;
        EXPECT_NEAR(x.distance(entry.first->second), 0., 1e-13) << x;
      };
      for (unsigned int e = 0; e < Info::lines_per_cell; ++e)
        compare({Info::line_to_cell_vertices(e, 0), Info::line_to_cell_vertices(e, 1)});
      for (unsigned int f = 0; f < 6; ++f)
        compare({Info::face_to_cell_vertices(f, 0), Info::face_to_cell_vertices(f, 1),
                 Info::face_to_cell_vertices(f, 2), Info::face_to_cell_vertices(f, 3)});
      for (unsigned int v = 0; v < 8; ++v)
        EXPECT_NEAR(
          body.position({c, Info::unit_cell_vertex(v)}).distance(mesh.vertices[mesh.cells[c][v]]),
          0., 1e-13);
    }
  EXPECT_GT(twice, mesh.cells.size());
}
} // namespace snug::test

#endif
