#include <snug/advice/conditions.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace snug::advice {
namespace {
using Point  = dealii::Point<3>;
using Vector = dealii::Tensor<1, 3>;

/// Return points on face @p number of a cell, in the coordinates of the cell.
std::vector<Point> face_points(const unsigned int number)
{
  std::vector<Point> result;
  for (const double u : {0.15, 0.5, 0.8})
    for (const double v : {0.2, 0.55, 0.85})
      {
        Point unit;
        unit[number / 2]           = number % 2;
        unit[(number / 2 + 1) % 3] = u;
        unit[(number / 2 + 2) % 3] = v;
        result.push_back(unit);
      }
  return result;
}

/**
 * This class checks whether a solid is a body of revolution about an axis, or a sector between
 * planes through the axis. With the direction a of the axis, the lever r of a point and t = a x r /
 * |a x r|, the surface is one of revolution if its normal n satisfies n . t = 0. The faces between
 * which a sector lies have |n . t| = 1 and must be held as symmetry planes.
 */
class Revolution
{
public:
  Revolution(const AdviceInput<3> &input,
             const Conditions<3>  &conditions,
             const Point          &point,
             const Vector         &axis)
    : input(input), conditions(conditions), mesh(input.mesh()), point(point), axis(axis)
  {}

  /// Return whether geometry, materials, supports, loads, contact and the points of responses are
  /// the same at all angles. Collective.
  bool is_symmetric()
  {
    const auto &responses = input.scene.responses;
    return std::all_of(responses.begin(), responses.end(),
                       [&](const auto &response) {
                         return response.point.empty() ||
                                is_on_axis(contact::to_point<3>(response.point));
                       }) &&
           keeps_surface() && keeps_sector() && keeps_edges() && keeps_conditions();
  }

  /// Return the number of nodes of the section with cells of the same size. A cell of volume V at
  /// the distance r takes the part V^(1/3) / r of the angle of the sector. Collective.
  double n_section_nodes() const
  {
    double cells = 0.;
    for (const auto &at : conditions.in_cells())
      cells += std::min(1., std::cbrt(at.weight) / (sector_angle * lever(at.x).norm()));
    return std::pow(mesh.degree(), 2) * dealii::Utilities::MPI::sum(cells, mesh.communicator());
  }

private:
  Vector lever(const Vector &x) const
  {
    const Vector r = x - point;
    return r - (r * axis) * axis;
  }

  bool is_on_axis(const Vector &x) const { return lever(x).norm() < 1e-6 * conditions.size(); }

  /// Return t; zero on the axis.
  Vector along_circle(const Vector &x) const
  {
    const Vector t = dealii::cross_product_3d(axis, lever(x));
    return is_on_axis(x) ? Vector() : Vector(t / t.norm());
  }

  /// Return the area vector of a face of the true body at @p unit, from differences of the map of
  /// the cell towards its inside, relative to the face in the coordinates of the cell.
  Vector true_area(unsigned int cell, unsigned int number, const Point &unit) const
  {
    Vector tangents[2];
    for (const unsigned int i : {0, 1})
      {
        const unsigned int d     = (number / 2 + 1 + i) % 3;
        const double       step  = unit[d] < 0.5 ? 1e-6 : -1e-6;
        auto               moved = unit;
        moved[d] += step;
        tangents[i] = (mesh.true_position(cell, moved) - mesh.true_position(cell, unit)) / step;
      }
    return (number % 2 == 1 ? 1. : -1.) * dealii::cross_product_3d(tangents[0], tangents[1]);
  }

  /// Return the minimum and maximum of |n . t| over points of a true face. The normal at points on
  /// the axis is not used.
  std::pair<double, double> range(const unsigned int cell, const unsigned int number) const
  {
    std::pair<double, double> result = {1., 0.};
    for (const auto &unit : face_points(number))
      {
        const auto   area = true_area(cell, number, unit);
        const double value =
          std::abs(area * along_circle(mesh.true_position(cell, unit))) / area.norm();
        result = {std::min(result.first, value), std::max(result.second, value)};
      }
    return result;
  }

  bool on_all_ranks(const bool here) const
  {
    return dealii::Utilities::MPI::min(here ? 1 : 0, mesh.communicator()) == 1;
  }

  /// Return whether the true surface and changes of the material are surfaces of revolution.
  /// Compute the bounds of the outer normals of the faces that bound the sector. Collective.
  bool keeps_surface()
  {
    const double tolerance = 1e-4; // differences of the map have errors of 1e-6
    bool         kept      = true;
    sector.assign(6 * mesh.n_bodies(), none);
    for (unsigned int f = 0; f < mesh.boundary_faces().size() && kept; ++f)
      {
        const auto &face   = mesh.boundary_faces()[f];
        const auto  across = range(face.cell, face.number);
        if (across.first < 1. - tolerance)
          {
            kept = across.second < tolerance;
            continue;
          }
        const auto   unit   = face_points(face.number).front();
        const Vector area   = true_area(face.cell, face.number, unit);
        const Vector normal = area / area.norm();
        kept                = conditions.is_symmetry_support(
          {face.body, face.boundary, mesh.true_position(face.cell, unit), normal});
        for (unsigned int d = 0; d < 3; ++d)
          {
            double *bounds = &sector[6 * face.body];
            bounds[d]      = std::max(bounds[d], normal[d]);
            bounds[3 + d]  = std::max(bounds[3 + d], -normal[d]);
          }
      }
    for (unsigned int f = 0; f < mesh.interior_faces().size() && kept; ++f)
      {
        const auto &face = mesh.interior_faces()[f];
        const auto &body = input.model().bodies[mesh.known_cell(face.cell).body];
        if (face.cell < mesh.cells().size() && &body.material(mesh.known_cell(face.cell)) !=
                                                 &body.material(mesh.known_cell(face.neighbour)))
          kept = range(face.cell, face.face).second < tolerance;
      }
    return on_all_ranks(kept);
  }

  /// Return whether all bodies are full, or sectors between the same planes. The mean of the two
  /// outer normals is the mean of the bounds of their components. It has the norm sin(angle / 2)
  /// and points away from the sector. Collective.
  bool keeps_sector()
  {
    dealii::Utilities::MPI::max(sector, mesh.communicator(), sector);
    const auto mean = [&](const unsigned int body) {
      const double *bounds = &sector[6 * body];
      Vector        result;
      for (unsigned int d = 0; d < 3 && bounds[0] > none; ++d)
        result[d] = 0.5 * (bounds[d] - bounds[3 + d]);
      return result;
    };
    for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
      if ((mean(body) - mean(0)).norm() > 1e-3)
        return false;
    const double sine = mean(0).norm();
    is_sector         = sine > 1e-3;
    sector_angle      = is_sector ? 2. * std::asin(std::min(1., sine)) : 2. * dealii::numbers::PI;
    middle            = -1. * mean(0);
    for (unsigned int d = 0; d < 3 && !is_sector; ++d) // any direction across the axis
      if (const Vector e = dealii::cross_product_3d(axis, Vector(Point::unit_vector(d)));
          e.norm() > middle.norm())
        middle = e;
    middle /= middle.norm();
    return true;
  }

  /// Return whether the edges between boundaries are circles about the axis, or in the planes that
  /// bound a sector. Collective.
  bool keeps_edges() const
  {
    std::vector<contact::Boundary> boundaries;
    for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
      for (unsigned int b = 0; b < mesh.geometry(body).boundary_names().size(); ++b)
        boundaries.emplace_back(body, b);
    const mesh::Surface<3> surface(mesh, boundaries);
    const auto            &X         = surface.reference_positions();
    const unsigned int     p         = mesh.degree();
    const unsigned int     corners[] = {0, p, (p + 1) * (p + 1) - 1, p * (p + 1)};
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> boundary_at;
    for (const auto &face : surface.faces())
      {
        const auto   node = [&](const unsigned int i) { return face.nodes[corners[i % 4]]; };
        const Vector area =
          dealii::cross_product_3d(X[node(2)] - X[node(0)], X[node(3)] - X[node(1)]);
        const Vector centre = 0.25 * (X[node(0)] + X[node(1)] + X[node(2)] + X[node(3)]);
        if (std::abs(area * along_circle(centre)) > 0.999 * area.norm())
          continue; // bounds the sector
        for (unsigned int i = 0; i < 4; ++i)
          {
            const unsigned int a = node(i), b = node(i + 1);
            const auto         known = boundary_at.insert({std::minmax(a, b), face.boundary}).first;
            if (known->second != face.boundary &&
                std::hypot((X[b] - X[a]) * axis, lever(X[b]).norm() - lever(X[a]).norm()) >
                  1e-6 * conditions.size())
              return false;
          }
      }
    return true;
  }

  /// Return whether the conditions equal those of the same circle in the middle of the sector, and
  /// are symmetric about the plane through the axis and the point, which torsion is not.
  /// Collective.
  bool keeps_conditions() const
  {
    bool kept = true;
    for (const bool inside : {false, true})
      {
        Comparison<3> comparison(conditions.size());
        for (auto at : inside ? conditions.in_cells() : conditions.on_faces())
          if (const Vector t = along_circle(at.x); std::abs(at.normal * t) < 0.999)
            {
              // Facets have the true normal only in the middle.
              at.normal -= (at.normal * t) * t;
              at.normal /= inside ? 1. : at.normal.norm();
              // The rotation maps (t x a, t, a) to (middle, a x middle, a).
              auto turn = outer_product(middle, dealii::cross_product_3d(t, axis)) +
                          outer_product(dealii::cross_product_3d(axis, middle), t) +
                          outer_product(axis, axis);
              if (t.norm() == 0.) // on the axis
                turn = one;
              auto there      = at;
              there.x         = point + turn * (at.x - point);
              there.normal    = turn * at.normal;
              const auto data = conditions.data(at);
              comparison.add(at.weight, turn, data, at.x, conditions.data(there), at.x);
              comparison.add(at.weight, one - 2. * outer_product(t, t), data, at.x, data, at.x);
            }
        kept = comparison.is_equal(mesh.communicator()) && kept;
      }
    return kept;
  }

  const dealii::Tensor<2, 3> one = dealii::unit_symmetric_tensor<3>();
  const AdviceInput<3>      &input;
  const Conditions<3>       &conditions;
  const mesh::BodyMesh<3>   &mesh;
  const Point                point;
  const Vector               axis;
  static constexpr double    none = -2.; ///< bound without normals
  std::vector<double>        sector; ///< per body: maxima of the components of normals n, and of -n
  bool                       is_sector    = false;
  double                     sector_angle = 0.;
  Vector                     middle; ///< direction of the middle of the sector
};
} // namespace

/// The axes are along the coordinates, through the origin or the mean of the nodes.
std::vector<Advice> revolution(const AdviceInput<3> &input)
{
  if (input.shapes.n_variables() > 0)
    return {};
  const Conditions<3> conditions(input);
  for (unsigned int d = 0; d < 3; ++d)
    for (const auto &point : {Point(), conditions.centre()})
      {
        Revolution about(input, conditions, point, Point::unit_vector(d));
        if (!about.is_symmetric())
          continue;
        std::ostringstream text;
        text << "the model is the same at all angles about the axis through (" << point
             << ") along " << "xyz"[d]
             << ": model the section, 'Dimension' = 2 and 'Model' = axisymmetric";
        const double n_solid = 3. * input.mesh().n_global_free_nodes();
        return {{"body of revolution", text.str(), n_solid / (2. * about.n_section_nodes()), 0.}};
      }
  return {};
}
} // namespace snug::advice
