#include <snug/app/designed_face.h>
#include <snug/app/results.h>
#include <snug/cad/moved_solid.h>
#include <snug/faces/closest_point.h>
#include <snug/geometry/entry_values.h>
#include <snug/geometry/imported_mesh.h>
#include <snug/geometry/placement.h>

#include <sstream>

namespace snug::app {
namespace {
/// Points of the true surface within the edges of a face are closer to the mesh than this part of
/// the size of the face.
const double on_face = 1e-3;

/// This class finds the displacements of a design at points of the true surface of a face.
class Moves
{
public:
  using Vector = dealii::Tensor<1, 3>;

  explicit Moves(const DesignedFace<3> &face)
    : face(face), of_nodes(face.shaped_face().mesh().degree()), of_samples(mesh::surface_degree)
  {
    for (const auto &one : face.shaped_face().surface().faces())
      {
        patches.push_back({one.samples.empty() ? one.nodes : one.samples, !one.samples.empty()});
        auto &patch = patches.back();
        for (const unsigned int point : patch.points)
          patch.positions.push_back(face.shaped_face().positions()[point]);
        for (const auto &x : patch.positions)
          patch.radius = std::max(patch.radius, (x - patch.positions[0]).norm());
      }
  }

  /// Return the displacement at the point of the face that is closest to @p x, or nothing if that
  /// point is farther than @p limit.
  std::optional<Vector> at(const Vector &x, const double limit) const
  {
    double                nearest = limit * limit;
    std::optional<Vector> result;
    for (const auto &patch : patches)
      {
        const double clear = (patch.positions[0] - x).norm() - 1.5 * patch.radius;
        if (clear > 0. && clear * clear > nearest)
          continue;
        const auto &shape = patch.has_samples ? of_samples : of_nodes;
        const auto  found = faces::closest_point(shape, patch.positions, x);
        if (found.squared_distance >= nearest)
          continue;
        nearest           = found.squared_distance;
        result            = Vector();
        const auto values = shape.at(found.xi).value;
        for (unsigned int k = 0; k < values.size(); ++k)
          *result += values[k] * (face.positions()[patch.points[k]] - patch.positions[k]);
      }
    return result;
  }

private:
  struct Patch
  {
    const std::vector<unsigned int> &points;
    bool                             has_samples;
    std::vector<Vector>              positions = {};
    double                           radius    = 0.; ///< of a ball about the first point
  };

  const DesignedFace<3>    &face;
  const faces::FaceShape<3> of_nodes, of_samples;
  std::vector<Patch>        patches;
};

/// Return the surface of a design over the parameters of a face of a solid.
io::SplineSurface<3> fitted(const cad::MovedSolid         &solid,
                            const unsigned int             f,
                            const cad::MovedSolid::Domain &domain,
                            const DesignedFace<3>         &face,
                            const double                   asked,
                            const unsigned int             most_points)
{
  const Moves             moves(face);
  const double            limit = on_face * face.size();
  io::CoordinatePoints<3> points;
  points.range  = domain.upper - domain.lower;
  points.closed = domain.closed;
  points.point  = [&](const dealii::Tensor<1, 2> &at) -> std::optional<dealii::Tensor<1, 3>> {
    const dealii::Tensor<1, 3> x    = solid.point(f, domain.lower + at);
    const auto                 move = moves.at(x, limit);
    if (!move)
      return {};
    return x + *move;
  };
  return io::fit_splines(points, asked, most_points);
}
} // namespace

template <>
void Results<2>::export_solids(const std::vector<DesignedFace<2>> & /*designed*/)
{}

template <>
void Results<3>::export_solids(const std::vector<DesignedFace<3>> &designed)
{
  const auto              &scene = problem->scene;
  std::vector<std::string> failures;
  for (const auto &body : scene.bodies)
    {
      const auto       &imported = body.mesh.imported;
      const std::string file     = solid_file(scene, body);
      if (file.empty())
        continue;
      try
        {
          const cad::MovedSolid                   solid(imported->brep, body.mesh.scale,
                                                        geometry::rotation_of<3>(body.mesh),
                                                        geometry::per_axis<3, double>("Shift", body.mesh.shift, 0.,
                                                                                      false));
          std::map<unsigned int, cad::SplineFace> moved;
          std::vector<std::string>                names;
          double                                  deviation = 0., tolerance = 0.;
          for (unsigned int f = 0; f < imported->boundaries.size(); ++f)
            {
              names.push_back(body.name + '.' + imported->boundaries[f]);
              for (const auto &face : designed)
                if (face.name == names.back())
                  {
                    const double asked   = scene.output.profile_deviation * face.size();
                    const auto   domain  = solid.domain(f);
                    const auto   surface = fitted(solid, f, domain, face, asked, most_points);
                    moved[f]  = spline_face<3>(surface, domain.upper - domain.lower, domain.lower);
                    deviation = std::max(deviation, surface.deviation);
                    tolerance = std::max({tolerance, asked, surface.deviation});
                  }
            }
          if (moved.empty())
            continue;
          if (!body.mesh.warp.empty())
            throw InputError("it has a 'Warp'");
          const double volume = solid.write(file, scene.units.empty() ? "mm" : scene.units.front(),
                                            body.name, names, moved, tolerance);
          std::ostringstream line;
          line << body.name << ".step: solid of " << names.size() << " faces, " << moved.size()
               << " of them moved, volume " << volume << Units(scene.units).after_number("length^3")
               << ", maximum deviation from the design " << deviation
               << Units(scene.units).after_number("length");
          problem->context.out() << line.str() << std::endl;
        }
      catch (const InputError &error)
        {
          failures.push_back(body.name + ".step is not written: " + error.what());
        }
    }
  problem->context.warn("export", failures);
}
} // namespace snug::app
